#include "scenes/map/tags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "sim/fields/shortened.h"

namespace hedgehop::scenes::map {
namespace {

constexpr double kFootM = 0.3048, kInchM = 0.0254;

/// Removes a number of at least 0 from the front of a text.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !(value >= 0.0)) return {};
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

/// Returns a text that fits into one line.
std::string printable(std::string_view text) {
  constexpr size_t kMaxSize = 60;
  std::string line = shortened(text, kMaxSize);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return line;
}

std::optional<double> length(std::string_view text) {
  const std::optional<double> value = take_number(text);
  if (!value) return {};
  if (text == "'" || text == " ft" || text == "ft") return *value * kFootM;
  if (text.starts_with('\'') && text.ends_with('"')) {
    text = text.substr(1, text.size() - 2);
    const std::optional<double> inches = take_number(text);
    if (!inches || !text.empty()) return {};
    return *value * kFootM + *inches * kInchM;
  }
  if (!text.empty() && text != "m" && text != " m") return {};
  return value;
}

}  // namespace

std::string_view TagReader::text(const std::string& key) const {
  const auto found = tags_.find(key);
  return found == tags_.end() ? std::string_view() : std::string_view(found->second);
}

std::optional<double> TagReader::length_m(const std::string& key, double at_least, double at_most) const {
  if (!tags_.contains(key)) return {};
  const std::optional<double> value = length(text(key));
  if (value && *value >= at_least && *value <= at_most) return value;
  char valid[96];
  std::snprintf(valid, sizeof valid, "valid: %g to %g m, such as 12.5, or in feet, such as 40 ft", at_least, at_most);
  report(key, valid);
  return {};
}

std::optional<double> TagReader::number(const std::string& key, double at_most) const {
  if (!tags_.contains(key)) return {};
  std::string_view rest = text(key);
  const std::optional<double> value = take_number(rest);
  if (value && rest.empty() && *value <= at_most) return value;
  char valid[48];
  std::snprintf(valid, sizeof valid, "valid: a number from 0 to %g", at_most);
  report(key, valid);
  return {};
}

std::optional<double> TagReader::direction_deg(const std::string& key) const {
  static constexpr std::array<std::string_view, 16> kCompass = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                                "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  const auto point = std::ranges::find(kCompass, text(key));
  if (point == kCompass.end()) return number(key, 360.0);
  return 360.0 / kCompass.size() * static_cast<double>(point - kCompass.begin());
}

void TagReader::report(const std::string& key, std::string_view valid) const {
  faults_.push_back(name_ + ": " + key + "='" + printable(text(key)) + "' cannot be read; " + std::string(valid));
}

}  // namespace hedgehop::scenes::map
