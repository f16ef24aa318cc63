#include "sim/flight/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "sim/config/utf8.h"

namespace hedgehop::sim {
namespace {

constexpr int kMaxDigits = 17;  // these distinguish all doubles that are not tiny

/// @param print  returns a number with some digits.
template <class Print>
std::string distinct_words(double value, double other, int min_digits, const Print& print) {
  for (int digits = min_digits; digits < kMaxDigits; ++digits) {
    std::string words = print(value, digits);
    if (value == other || words != print(other, digits)) return words;
  }
  return print(value, kMaxDigits);
}

}  // namespace

std::string counted(size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string decimals(double value, int count) {
  std::string words = fmt::format("{:.{}f}", value, count);
  const bool is_zero = words.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && words.starts_with('-')) words.erase(0, 1);
  return words;
}

std::string distinct_figures(double value, double other) {
  return distinct_words(value, other, 4,
                        [](double number, int digits) { return fmt::format("{:.{}g}", number, digits); });
}

std::string distinct_decimals(double value, double other) { return distinct_words(value, other, 3, decimals); }

std::string figure_words(double value, const std::string& unit, double other) {
  if (!std::isfinite(value)) return "unknown";
  return fmt::format("{}{}{}", distinct_figures(value, other), unit.empty() ? "" : " ", unit);
}

std::string check_words(const CheckResult& check) {
  std::string words = figure_words(check.value, check.unit, check.limit);
  if (check.t_s) words += fmt::format(" at {:.2f} s", *check.t_s);
  if (!std::isnan(check.limit))
    words += fmt::format(", must be {} {}", check.must, figure_words(check.limit, check.unit, check.value));
  if (!check.passed && !check.cause.empty()) words += ": " + check.cause;
  return words;
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
  const bool copies = utf8_text(word) == word && std::ranges::none_of(word, is_control);
  const bool escapes = !copies && !word.ends_with('\n');  // $(...) removes line breaks at the end
  std::string quoted;
  for (std::string_view rest = word; !rest.empty();) {
    const size_t length = first_character(rest).first;
    const char c = rest[0];
    if (c == '\'') {
      quoted += "'\\''";
    } else if (escapes && (length == 0 || is_control(c))) {
      quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    } else if (escapes && (c == '\\' || c == '%')) {
      quoted += std::string(2, c);
    } else {
      quoted += rest.substr(0, std::max<size_t>(1, length));
    }
    rest.remove_prefix(std::max<size_t>(1, length));
  }
  return escapes ? fmt::format("\"$(printf '{}')\"", quoted) : "'" + quoted + "'";
}

std::string last_line(std::string_view text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.remove_suffix(1);
  const size_t begin = text.find_last_of("\r\n");
  return std::string(begin == std::string_view::npos ? text : text.substr(begin + 1));
}

std::string markdown_cell(std::string_view text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return cell;
}

std::string library_words(const Libraries& libraries) {
  const bool both = !libraries.images.empty() && !libraries.functions.empty();
  return libraries.images + (both ? ", " : "") + libraries.functions;
}

std::string renderer_words(const Libraries& libraries) {
  static const std::regex kWidth("(; (AVX-512|AVX2|plain)|, [0-9]+ bits)");
  return std::regex_replace(libraries.renderer, kWidth, "");
}

}  // namespace hedgehop::sim
