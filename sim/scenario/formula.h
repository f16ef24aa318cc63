#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Formulas of signal temporal logic (STL) over a flight's signals, as `{check: formula}` has them.
namespace hedgehop::sim {

/// A signal that formulas may name.
struct FormulaSignal {
  std::string_view name, unit, meaning;
};
/// Returns the numeric signals. The only other signal is `status`, the status of the module's last decision.
const std::vector<FormulaSignal>& formula_signals();

/// Arithmetic on signals.
struct Expression {
  enum class Kind { number, signal, add, subtract, multiply, divide, negate, abs, min, max };
  Kind kind = Kind::number;
  double number = 0.0;
  std::string signal;
  std::vector<Expression> of;
};

/// Times after now; without `to_s`, until the end of the flight.
struct TimeInterval {
  double from_s = 0.0;
  std::optional<double> to_s;
};

/// A formula; its robustness is at least 0 if it holds.
struct Formula {
  enum class Kind {
    at_least_zero,  ///< `margin` >= 0
    has_status,     ///< the module's status is `status`
    negation,
    conjunction,
    disjunction,
    implication,
    always,
    eventually,
    until  ///< of[1] holds at some time of `interval`, and of[0] at all times before it
  };
  Kind kind = Kind::at_least_zero;
  Expression margin;
  std::string status;
  TimeInterval interval;
  std::vector<Formula> of;
};

/// Reads a formula:
///
///     f := g ['->' f]      g := h {'or' h}      h := u {'and' u}      u := n {'until' [I] n}
///     n := ('not' | 'always' [I] | 'eventually' [I]) n
///        | e ('<' | '<=' | '>' | '>=') e | 'status' ('==' | '!=') WORD | '(' f ')'
///     e := numbers, signals, + - * / abs(e) min(e, e) max(e, e) ( )
///     I := '[' SECONDS ',' (SECONDS | 'end') ']'
///
/// Throws std::invalid_argument "column 9: no signal 'clearence'; did you mean 'clearance'? ...".
/// Source: [DonzeMaler2010] sec. on signal temporal logic.
Formula parse_formula(std::string_view text);

/// Returns whether a formula names a numeric signal.
bool uses_signal(const Formula& formula, std::string_view signal);

/// Returns the minimum horizon of a formula, s: the sum along nested intervals; 'end' counts as its beginning.
double horizon_s(const Formula& formula);

}  // namespace hedgehop::sim
