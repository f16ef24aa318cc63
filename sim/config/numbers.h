#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Numbers as YAML holds them. Text to value and back is exact: every finite member value has a text that reads back to
/// the same bits.
namespace hedgehop::sim {

/// A text's number, or why it is none.
struct ParsedNumber {
  enum class Kind { number, not_a_number, not_finite } kind = Kind::not_a_number;
  double member = 0.0;  ///< in the unit of the member
};

/// Decimal numbers such as 3, -0.5, +1e3; ".inf", ".nan" and what no double can hold are not finite.
ParsedNumber parse_number(std::string_view text, bool degrees);
/// Decimal integers only. Nothing when it is none or does not fit.
std::optional<int64_t> parse_signed(std::string_view text);
std::optional<uint64_t> parse_unsigned(std::string_view text);

/// The shortest decimal that parse_number() turns into exactly `member`, which is finite.
std::string number_text(double member, bool degrees);

}  // namespace hedgehop::sim
