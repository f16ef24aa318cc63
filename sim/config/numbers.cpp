#include "sim/config/numbers.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/fields/bounds.h"

namespace hedgehop::sim {
namespace {

std::string_view without_plus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

template <class T>
std::optional<T> parse_whole(std::string_view text) {
  T value{};
  text = without_plus(text);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

ParsedNumber parse_number(std::string_view text, bool degrees) {
  using Kind = ParsedNumber::Kind;
  text = without_plus(text);
  for (std::string_view word : {"inf", "Inf", "INF", "nan", "NaN", "NAN"}) {
    const std::string_view bare = text.substr(text.starts_with('-') ? 1 : 0);
    if (bare == word || (bare.starts_with('.') && bare.substr(1) == word)) return {Kind::not_finite};
  }
  // from_chars also reads words such as "infinity"; a number has a digit or a point after its sign.
  const size_t first = text.starts_with('-') ? 1 : 0;
  if (first >= text.size() || (text[first] != '.' && (text[first] < '0' || text[first] > '9'))) return {};

  ParsedNumber parsed;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, parsed.member);
  if (error == std::errc::invalid_argument || end != last) return {};
  if (error == std::errc::result_out_of_range) return {Kind::not_finite};
  parsed.kind = Kind::number;
  if (degrees) {
    long double precise = 0.0L;
    std::from_chars(text.data(), last, precise);
    parsed.member = fields::to_radians(precise);
  }
  return parsed;
}

std::optional<int64_t> parse_signed(std::string_view text) { return parse_whole<int64_t>(text); }

std::optional<uint64_t> parse_unsigned(std::string_view text) { return parse_whole<uint64_t>(text); }

std::string number_text(double member, bool degrees) {
  if (!degrees) return fmt::format("{}", member);
  const long double exact = static_cast<long double>(member) * (180.0L / std::numbers::pi_v<long double>);
  constexpr int kMaxDigits = std::numeric_limits<long double>::max_digits10;
  // At least as many digits as before the point; otherwise 90 would be written 9e+01.
  const double magnitude = std::abs(static_cast<double>(exact));
  const int least = magnitude >= 1.0 && magnitude < 1e15 ? 1 + static_cast<int>(std::log10(magnitude)) : 1;
  std::string text;
  for (int digits = least; digits <= kMaxDigits; ++digits) {
    text = fmt::format("{:.{}g}", exact, digits);
    const ParsedNumber back = parse_number(text, true);
    if (back.kind == ParsedNumber::Kind::number && back.member == member &&
        std::signbit(back.member) == std::signbit(member)) {
      break;
    }
  }
  return text;
}

std::string yaml_1_1_number(double value) {
  std::string text = number_text(value, false);
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string yaml_1_1_list(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + yaml_1_1_number(value + 0.0);
  return text;
}

}  // namespace hedgehop::sim
