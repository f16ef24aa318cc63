#include "scenes/map/tags.h"

#include <charconv>

namespace hedgehop::scenes::map {
namespace {

constexpr double kFootM = 0.3048, kInchM = 0.0254, kMaxLengthM = 10e3, kMaxNumber = 1e3;

/// Removes a number of at least 0 from the front of a text.
std::optional<double> take_number(std::string_view& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc() || !(value >= 0.0)) return {};
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
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

std::optional<double> TagReader::length_m(const std::string& key) const {
  if (!tags_.contains(key)) return {};
  const std::optional<double> value = length(text(key));
  if (value && *value <= kMaxLengthM) return value;
  report(key, "valid: a length in m, such as 12.5, or in feet, such as 40 ft");
  return {};
}

std::optional<double> TagReader::number(const std::string& key) const {
  if (!tags_.contains(key)) return {};
  std::string_view rest = text(key);
  const std::optional<double> value = take_number(rest);
  if (value && rest.empty() && *value <= kMaxNumber) return value;
  report(key, "valid: a number of at least 0");
  return {};
}

void TagReader::report(const std::string& key, std::string_view valid) const {
  faults_.push_back(name_ + ": " + key + "='" + std::string(text(key)) + "' cannot be read; " + std::string(valid));
}

}  // namespace hedgehop::scenes::map
