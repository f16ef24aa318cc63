#include "sim/config/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/config/other_units.h"
#include "sim/fields/bounds.h"

namespace hedgehop::sim {
namespace {

/// Returns "a number" or "a number in m".
std::string number_words(std::string_view noun, const fields::Field& field) {
  return field.unit.empty() ? std::string(noun) : fmt::format("{} in {}", noun, field.unit);
}

/// Returns "; 230 mm is 0.23 m" for a length far above a bound of a few meters; else "".
std::string millimeter_advice(double length_m, std::string_view text, const fields::Field& field) {
  constexpr double kFewM = 20.0, kFarAbove = 2.0, kMetersPerMm = 0.001;
  const double bound_m = field.at_most.value_or(INFINITY), meters = kMetersPerMm * length_m;
  if (field.unit != "m" || bound_m > kFewM || length_m < kFarAbove * bound_m) return "";
  return fields::broken_bound(meters, field) ? "" : fmt::format("; {} mm is {:g} m", text, meters);
}

template <class T>
bool within_bounds(T member, const Node& node, const std::string& path, const fields::Field& field, ErrorList& errors) {
  const std::optional<std::string> bound = fields::broken_bound(static_cast<double>(member), field);
  if (!bound) return true;
  const std::string advice = millimeter_advice(static_cast<double>(member), node.text, field);
  errors.add(node.position, FieldError{path, fmt::format("must be {}, got {}{}", *bound, node.text, advice)}.text());
  return false;
}

void expected(std::string_view what, const Node& node, const std::string& path, ErrorList& errors) {
  errors.add(node.position, fmt::format("{} expects {}, got {}", errors.path_text(path), what, node.description()));
}

bool is_plain_scalar(const Node& node) { return node.kind == Node::Kind::scalar && !node.quoted; }

/// Refuses a whole number out of its type's range, or a text that is not a whole number.
template <class T>
void refuse_integer(T lowest, T highest, const Node& node, const std::string& path, const fields::Field& field,
                    ErrorList& errors) {
  const size_t sign = node.text.starts_with('-') || node.text.starts_with('+') ? 1 : 0;
  const bool digits_only =
      node.text.size() > sign && node.text.find_first_not_of("0123456789", sign) == std::string::npos;
  if (is_plain_scalar(node) && digits_only) {
    constexpr double kHuge = std::numeric_limits<double>::max();
    const auto bound = fields::broken_bound(node.text.starts_with('-') ? -kHuge : kHuge, field);
    const std::string valid = bound.value_or(fmt::format("between {} and {}", lowest, highest));
    errors.add(node.position, fmt::format("'{}': must be {}, got {}", path, valid, node.text));
  } else {
    expected(number_words("a whole number", field), node, path, errors);
  }
}

}  // namespace

std::optional<double> read_number(const Node& node, const std::string& path, const fields::Field& field,
                                  ErrorList& errors) {
  using Kind = ParsedNumber::Kind;
  const ParsedNumber parsed =
      is_plain_scalar(node) ? parse_number(node.text, fields::is_degrees(field.unit)) : ParsedNumber{};
  if (parsed.kind == Kind::not_finite) {
    errors.add(node.position, fmt::format("'{}': must be finite, got {}", path, node.text));
  } else if (parsed.kind == Kind::not_a_number) {
    expected(number_words("a number", field), node, path, errors);
  } else if (within_bounds(parsed.member, node, path, field, errors)) {
    return parsed.member;
  }
  return {};
}

std::optional<int64_t> read_signed(const Node& node, const std::string& path, const fields::Field& field,
                                   int64_t lowest, int64_t highest, ErrorList& errors) {
  const std::optional<int64_t> value = is_plain_scalar(node) ? parse_signed(node.text) : std::nullopt;
  if (!value || *value < lowest || *value > highest) {
    refuse_integer(lowest, highest, node, path, field, errors);
    return {};
  }
  return within_bounds(*value, node, path, field, errors) ? value : std::nullopt;
}

std::optional<uint64_t> read_unsigned(const Node& node, const std::string& path, const fields::Field& field,
                                      uint64_t highest, ErrorList& errors) {
  const std::optional<uint64_t> value = is_plain_scalar(node) ? parse_unsigned(node.text) : std::nullopt;
  if (!value || *value > highest) {
    refuse_integer(uint64_t{0}, highest, node, path, field, errors);
    return {};
  }
  return within_bounds(*value, node, path, field, errors) ? value : std::nullopt;
}

std::optional<bool> read_bool(const Node& node, const std::string& path, ErrorList& errors) {
  if (is_plain_scalar(node)) {
    if (node.text == "true") return true;
    if (node.text == "false") return false;
  }
  expected("true or false", node, path, errors);
  return {};
}

std::optional<std::string> read_text(const Node& node, const std::string& path, ErrorList& errors) {
  if (node.kind == Node::Kind::scalar) return node.text;
  expected("a text", node, path, errors);
  return {};
}

std::optional<std::filesystem::path> read_path(const Node& node, const std::string& path, ErrorList& errors) {
  if (node.kind != Node::Kind::scalar) {
    expected("the path of a file", node, path, errors);
    return {};
  }
  if (node.text.empty()) return std::filesystem::path();
  const bool in_file = node.position.line > 0;
  const auto folder = in_file ? std::filesystem::path(node.position.file).parent_path() : std::filesystem::path();
  return std::filesystem::absolute(folder / node.text).lexically_normal();
}

std::optional<size_t> read_choice(const Node& node, const std::string& path,
                                  const std::vector<std::string_view>& choices, ErrorList& errors) {
  if (node.kind != Node::Kind::scalar) {
    expected("one of: " + fmt::format("{}", fmt::join(choices, ", ")), node, path, errors);
    return {};
  }
  const auto found = std::find(choices.begin(), choices.end(), node.text);
  if (found != choices.end()) return static_cast<size_t>(found - choices.begin());
  const size_t dot = path.rfind('.');
  const std::string_view whole = path, parent = dot == std::string::npos ? "" : whole.substr(0, dot);
  const std::string_view key = dot == std::string::npos ? whole : whole.substr(dot + 1);
  errors.add(node.position, fmt::format("unknown choice '{}' for '{}'{}", node.text, path,
                                        errors.advice(parent, key, node.text, choices)));
  return {};
}

void refuse_key_as_choice(const Node& name, std::string_view selector, ErrorList& errors) {
  errors.add(name.position, fmt::format("'{0}' is not a choice of '{1}'; write '{0}: FILE' instead of '{1}'; its keys: "
                                        "hedgehop list {1}s",
                                        name.text, selector));
}

bool expect_list(const Node& node, const std::string& path, size_t size, ErrorList& errors) {
  if (node.kind != Node::Kind::list) {
    expected(size == 0 ? std::string("a list") : fmt::format("a list of {} numbers", size), node, path, errors);
    return false;
  }
  if (size != 0 && node.items.size() != size) {
    errors.add(node.position, fmt::format("'{}' expects a list of {} numbers, got {}", path, size, node.items.size()));
    return false;
  }
  return true;
}

bool expect_map(const Node& node, const std::string& path, ErrorList& errors) {
  if (node.kind == Node::Kind::map) return true;
  expected("a map of keys", node, path, errors);
  return false;
}

void StructReader::missing(std::string_view key, const fields::Field& field) const {
  if (map_.incomplete) return;  // the unreadable file may have it
  const std::string renamed = fmt::format("; its name is now '{}'", key);
  const auto is_former = [&](const Entry& entry) { return errors_.advice(path_, entry.key, "", keys_) == renamed; };
  if (std::ranges::any_of(map_.entries, is_former)) return;  // finish() reports the former key
  const std::string unit = field.unit.empty() ? "" : fmt::format(" ({})", field.unit);
  const std::string meaning = field.meaning.empty() ? "" : fmt::format(": {}{}", field.meaning, unit);
  errors_.add(map_.position, fmt::format("missing key '{}' in {}{}", key, errors_.path_text(path_), meaning));
}

void StructReader::finish() const {
  const std::string_view rpm = rpm_key(std::string_view(path_).substr(path_.rfind('.') + 1), keys_);
  std::vector<std::string_view> allowed = keys_;
  if (!rpm.empty()) allowed.push_back(rpm);
  for (const Entry& entry : map_.entries) {
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) continue;
    const bool is_rpm = !rpm.empty() && entry.key.ends_with("rpm");
    errors_.add(entry.position, fmt::format("unknown key '{}' in {}{}", entry.key, errors_.path_text(path_),
                                            errors_.advice(path_, is_rpm ? rpm : entry.key, "", allowed)));
  }
}

}  // namespace hedgehop::sim
