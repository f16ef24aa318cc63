#include "sim/scenario/formula_tokens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_number(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.'; }

/// Length of a decimal number that begins a text; the sign of an exponent belongs to it.
size_t number_length(std::string_view text) {
  size_t length = 0;
  while (length < text.size()) {
    const bool exponent_sign = length > 0 && (text[length] == '-' || text[length] == '+') &&
                               (text[length - 1] == 'e' || text[length - 1] == 'E');
    if (!is_word(text[length]) && text[length] != '.' && !exponent_sign) break;
    ++length;
  }
  return length;
}

}  // namespace

Token Tokens::take() {
  const Token taken = next_;
  advance();
  return taken;
}

bool Tokens::take(std::string_view text) {
  if (next_.kind == Token::Kind::end || next_.text != text) return false;
  advance();
  return true;
}

void Tokens::expect(std::string_view text) {
  if (!take(text)) refuse(fmt::format("expected '{}'", text));
}

void Tokens::refuse(const std::string& why) const {
  const bool is_end = next_.kind == Token::Kind::end;
  refuse_at(next_.column,
            fmt::format("{}, got {}", why, is_end ? "the end of the formula" : fmt::format("'{}'", next_.text)));
}

void Tokens::refuse_at(size_t column, const std::string& why) {
  throw std::invalid_argument(fmt::format("column {}: {}", column, why));
}

void Tokens::advance() {
  while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  const std::string_view rest = text_.substr(at_);
  next_ = {.column = at_ + 1};
  if (rest.empty()) return;
  size_t length = 1;
  if (is_number(rest[0])) {
    next_.kind = Token::Kind::number;
    length = number_length(rest);
  } else if (is_word(rest[0])) {
    next_.kind = Token::Kind::word;
    length = static_cast<size_t>(std::ranges::find_if_not(rest, is_word) - rest.begin());
  } else {
    next_.kind = Token::Kind::sign;
    for (const std::string_view sign : {"->", "<=", ">=", "==", "!="}) {
      if (rest.starts_with(sign)) length = 2;
    }
  }
  next_.text = rest.substr(0, length);
  at_ += length;
  if (next_.kind != Token::Kind::number) return;
  const ParsedNumber parsed = parse_number(next_.text, false);
  if (parsed.kind != ParsedNumber::Kind::number) refuse("expected a finite number");
  next_.number = parsed.member;
}

}  // namespace hedgehop::sim
