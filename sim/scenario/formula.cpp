#include "sim/scenario/formula.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

#include "sim/config/config_tree.h"
#include "sim/scenario/formula_tokens.h"

namespace hedgehop::sim {
namespace {

constexpr int kMaxDepth = 100;       // nested parts, such as parentheses
constexpr int kMaxOperators = 1000;  // a chain of them is a tree of that depth

/// The content of parentheses; the parser knows which of both only at their end.
using Value = std::variant<Expression, Formula>;

/// Recursive descent, a function for each level of binding.
class Parser {
 public:
  explicit Parser(std::string_view text) : tokens_(text) {}

  Formula whole() {
    Formula formula = formula_of(implication());
    if (tokens_.next().kind != Token::Kind::end) tokens_.refuse("expected the formula's end");
    return formula;
  }

 private:
  Value implication() {
    const Depth depth(*this);
    Value left = disjunction();
    if (!tokens_.take("->")) return left;
    return joined(Formula::Kind::implication, std::move(left), implication());
  }

  Value disjunction() {
    Value left = conjunction();
    while (tokens_.take("or")) left = joined(Formula::Kind::disjunction, std::move(left), conjunction());
    return left;
  }

  Value conjunction() {
    Value left = until();
    while (tokens_.take("and")) left = joined(Formula::Kind::conjunction, std::move(left), until());
    return left;
  }

  Value until() {
    Value left = unary();
    while (tokens_.take("until")) {
      const TimeInterval interval = interval_here();
      Formula formula = joined(Formula::Kind::until, std::move(left), unary());
      formula.interval = interval;
      left = std::move(formula);
    }
    return left;
  }

  Value unary() {
    const Depth depth(*this);
    Formula formula;
    if (tokens_.take("not")) {
      formula.kind = Formula::Kind::negation;
    } else if (tokens_.take("always")) {
      formula.kind = Formula::Kind::always;
      formula.interval = interval_here();
    } else if (tokens_.take("eventually")) {
      formula.kind = Formula::Kind::eventually;
      formula.interval = interval_here();
    } else {
      return comparison();
    }
    formula.of.push_back(formula_of(unary()));
    return formula;
  }

  Value comparison() {
    if (tokens_.take("status")) return status();
    const size_t column = tokens_.next().column;
    Value left = sum();
    for (const char* sign : {">=", ">", "<=", "<"}) {
      if (!tokens_.take(sign)) continue;
      Expression low = expression_of(std::move(left), column), high = number(&Parser::sum);
      if (sign[0] == '>') std::swap(low, high);
      Formula formula;
      formula.margin = {.kind = Expression::Kind::subtract, .of = {std::move(high), std::move(low)}};
      return formula;
    }
    return left;
  }

  Formula status() {
    const bool equal = tokens_.take("==");
    if (!equal && !tokens_.take("!=")) tokens_.refuse("'status' takes == or !=");
    if (tokens_.next().kind != Token::Kind::word) tokens_.refuse("expected a word of the module's status");
    Formula has{.kind = Formula::Kind::has_status, .status = std::string(tokens_.take().text)};
    if (equal) return has;
    return {.kind = Formula::Kind::negation, .of = {std::move(has)}};
  }

  Value sum() {
    const size_t column = tokens_.next().column;
    Value left = product();
    while (true) {
      if (tokens_.take("+")) {
        left = computed(Expression::Kind::add, std::move(left), column, &Parser::product);
      } else if (tokens_.take("-")) {
        left = computed(Expression::Kind::subtract, std::move(left), column, &Parser::product);
      } else {
        return left;
      }
    }
  }

  Value product() {
    const size_t column = tokens_.next().column;
    Value left = factor();
    while (true) {
      if (tokens_.take("*")) {
        left = computed(Expression::Kind::multiply, std::move(left), column, &Parser::factor);
      } else if (tokens_.take("/")) {
        left = computed(Expression::Kind::divide, std::move(left), column, &Parser::factor);
      } else {
        return left;
      }
    }
  }

  Value factor() {
    const Depth depth(*this);
    if (tokens_.take("-")) return Expression{.kind = Expression::Kind::negate, .of = {number(&Parser::factor)}};
    if (tokens_.take("(")) {
      Value inner = implication();
      tokens_.expect(")");
      return inner;
    }
    for (const auto& [name, kind, count] : {std::tuple{"abs", Expression::Kind::abs, 1},
                                            {"min", Expression::Kind::min, 2},
                                            {"max", Expression::Kind::max, 2}}) {
      if (!tokens_.take(name)) continue;
      Expression call{.kind = kind};
      tokens_.expect("(");
      for (int i = 0; i < count; ++i) {
        if (i > 0) tokens_.expect(",");
        call.of.push_back(number(&Parser::sum));
      }
      tokens_.expect(")");
      return call;
    }
    return leaf();
  }

  Expression leaf() {
    const Token& token = tokens_.next();
    if (token.kind == Token::Kind::number) return {.number = tokens_.take().number};
    if (token.kind != Token::Kind::word) tokens_.refuse("expected a number or a signal");
    if (token.text == "status") {
      Tokens::refuse_at(token.column, "'status' is no number; valid: status == WORD, status != WORD");
    }
    std::vector<std::string_view> names{"status"};
    for (const FormulaSignal& signal : formula_signals()) names.push_back(signal.name);
    if (std::ranges::find(names, token.text) == names.end()) {
      Tokens::refuse_at(token.column, fmt::format("no signal '{}'{}", token.text, suggestion(token.text, names)));
    }
    return {.kind = Expression::Kind::signal, .signal = std::string(tokens_.take().text)};
  }

  TimeInterval interval_here() {
    TimeInterval interval;
    if (!tokens_.take("[")) return interval;
    interval.from_s = seconds();
    tokens_.expect(",");
    if (!tokens_.take("end")) {
      const size_t column = tokens_.next().column;
      interval.to_s = seconds();
      if (*interval.to_s < interval.from_s) {
        Tokens::refuse_at(column, fmt::format("the interval ends at {} s, before its start at {} s", *interval.to_s,
                                              interval.from_s));
      }
    }
    tokens_.expect("]");
    return interval;
  }

  double seconds() {
    if (tokens_.next().kind != Token::Kind::number) tokens_.refuse("expected a time of at least 0 s");
    return tokens_.take().number;
  }

  Formula joined(Formula::Kind kind, Value left, Value right) {
    count_operator();
    Formula formula{.kind = kind};
    formula.of.push_back(formula_of(std::move(left)));
    formula.of.push_back(formula_of(std::move(right)));
    return formula;
  }

  /// @param column  of `left`.
  Expression computed(Expression::Kind kind, Value left, size_t column, Value (Parser::*right)()) {
    count_operator();
    Expression expression{.kind = kind};
    expression.of.push_back(expression_of(std::move(left), column));
    expression.of.push_back(number(right));
    return expression;
  }

  void count_operator() {
    if (++operators_ > kMaxOperators) {
      Tokens::refuse_at(tokens_.next().column,
                        fmt::format("more than {} operators; write several checks", kMaxOperators));
    }
  }

  Formula formula_of(Value value) {
    if (auto* formula = std::get_if<Formula>(&value)) return std::move(*formula);
    tokens_.refuse("expected a comparison, such as clearance >= 0.5");
  }
  static Expression expression_of(Value value, size_t column) {
    if (auto* expression = std::get_if<Expression>(&value)) return std::move(*expression);
    Tokens::refuse_at(column, "a comparison cannot be used as a number");
  }
  /// Parses a part that must be a number.
  Expression number(Value (Parser::*part)()) {
    const size_t column = tokens_.next().column;
    return expression_of((this->*part)(), column);
  }

  /// Counts the levels, for a text may not exhaust the stack.
  struct Depth {
    explicit Depth(Parser& parser) : of(parser) {
      if (++of.depth_ > kMaxDepth) Tokens::refuse_at(of.tokens_.next().column, "nested too deep");
    }
    ~Depth() { --of.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    Parser& of;
  };

  Tokens tokens_;
  int depth_ = 0, operators_ = 0;
};

}  // namespace

const std::vector<FormulaSignal>& formula_signals() {
  static const std::vector<FormulaSignal> signals{
      {"clearance", "m", "of the hull to obstacles and ground; at most 50"},
      {"obstacle_clearance", "m", "to obstacles; at most 50"},
      {"ground_clearance", "m", "to the ground; at most 50"},
      {"north", "m", "position"},
      {"east", "m", "position"},
      {"altitude", "m", "above the scene's origin"},
      {"speed", "m/s", "over ground, in space"},
      {"climb", "m/s", "upwards"},
      {"roll", "deg", "right side down"},
      {"pitch", "deg", "nose up"},
      {"heading", "deg", "-180 to 180, from north to east"},
      {"tilt", "deg", "of the body's down axis to the vertical"},
      {"goal_distance", "m", "horizontal; the scenario must have a goal"},
      {"wind", "m/s", "speed of the air"},
      {"tracking_error", "m/s", "difference of horizontal and commanded velocity; unknown without a command"},
      {"estimation_error", "m", "distance of the estimated and the true position"},
  };
  return signals;
}

Formula parse_formula(std::string_view text) { return Parser(text).whole(); }

namespace {

bool uses_signal(const Expression& expression, std::string_view signal) {
  return expression.signal == signal ||
         std::ranges::any_of(expression.of, [&](const Expression& part) { return uses_signal(part, signal); });
}

}  // namespace

bool uses_signal(const Formula& formula, std::string_view signal) {
  return uses_signal(formula.margin, signal) ||
         std::ranges::any_of(formula.of, [&](const Formula& part) { return uses_signal(part, signal); });
}

double horizon_s(const Formula& formula) {
  double horizon = 0.0;
  for (const Formula& part : formula.of) horizon = std::max(horizon, horizon_s(part));
  return horizon + formula.interval.to_s.value_or(formula.interval.from_s);
}

}  // namespace hedgehop::sim
