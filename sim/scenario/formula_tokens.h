#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// A word, number or sign of a formula's text.
struct Token {
  enum class Kind { word, number, sign, end };
  Kind kind = Kind::end;
  std::string_view text;
  double number = 0.0;
  size_t column = 1;
};

/// A formula's text, token by token.
class Tokens {
 public:
  /// @param text  outlives this. Throws std::invalid_argument as refuse() does.
  explicit Tokens(std::string_view text) : text_(text) { advance(); }

  const Token& next() const { return next_; }
  Token take();
  /// Takes the next token if it is this word or sign. @return whether it was taken.
  bool take(std::string_view text);
  /// As above; refuses any other.
  void expect(std::string_view text);
  /// Throws std::invalid_argument "column 7: <why>, got 'x'" of the next token.
  [[noreturn]] void refuse(const std::string& why) const;
  /// Throws std::invalid_argument "column 7: <why>".
  [[noreturn]] static void refuse_at(size_t column, const std::string& why);

 private:
  void advance();

  std::string_view text_;
  size_t at_ = 0;
  Token next_;
};

}  // namespace hedgehop::sim
