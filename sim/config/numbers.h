#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

/// Numbers in YAML. The conversion is exact in both directions: every finite member value has a text that reads back to
/// the same bits.
namespace hedgehop::sim {

/// The number of a text, or the reason why the text is not a number.
struct ParsedNumber {
  enum class Kind { number, not_a_number, not_finite } kind = Kind::not_a_number;
  double member = 0.0;  ///< in the unit of the member
};

/// Parses decimal numbers such as 3, -0.5, +1e3; ".inf", ".nan" and numbers beyond a double are not finite.
ParsedNumber parse_number(std::string_view text, bool degrees);
/// Parse decimal integers only; empty if the text is not an integer or does not fit.
std::optional<int64_t> parse_signed(std::string_view text);
std::optional<uint64_t> parse_unsigned(std::string_view text);

/// Returns the shortest decimal that parse_number() converts to exactly `member`, which must be finite.
std::string number_text(double member, bool degrees);

/// Returns a number as number_text(), for files of other programs: with a point before an exponent, "2.0e-05". Readers
/// of YAML 1.1 such as PyYAML take "2e-05" for a text.
std::string yaml_1_1_number(double value);
/// Returns such numbers as the items of a list, "1, 2.0e-05"; -0 is written 0.
std::string yaml_1_1_list(std::span<const double> values);

}  // namespace hedgehop::sim
