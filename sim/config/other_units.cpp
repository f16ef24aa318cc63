#include "sim/config/other_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

struct OtherUnit {
  std::string_view map, key, field;
};
// Each is in rpm, and the field in rad/s.
constexpr OtherUnit kOtherUnits[] = {{"main_rotor", "rpm", "speed"}, {"rotor", "highest_rpm", "highest_speed"}};

const OtherUnit* other_unit(std::string_view map, std::string_view key) {
  for (const OtherUnit& row : kOtherUnits) {
    if (row.map == map && row.key == key) return &row;
  }
  return nullptr;
}

}  // namespace

void convert_units(Entry& entry, std::string_view map, ErrorList& errors) {
  convert_units(entry.value, entry.key, errors);
  const OtherUnit* const row = other_unit(map, entry.key);
  if (!row) return;
  Node& value = entry.value;
  const bool is_plain = value.kind == Node::Kind::scalar && !value.quoted;
  const ParsedNumber number = is_plain ? parse_number(value.text, /*degrees=*/false) : ParsedNumber{};
  if (number.kind == ParsedNumber::Kind::number) {
    value.text = number_text(number.member * (2.0 * std::numbers::pi / 60.0), /*degrees=*/false);
  }
  entry.key = row->field;  // the reader reports a value that is no number
}

void convert_units(Node& node, std::string_view key, ErrorList& errors) {
  if (key == kParametersKey) return;
  for (Node& item : node.items) convert_units(item, "", errors);
  for (Entry& entry : node.entries) {
    const OtherUnit* const row = other_unit(key, entry.key);
    if (row && node.find(row->field)) {
      errors.add(entry.position, fmt::format("'{}' and '{}' give the same value; remove one", row->field, row->key));
    }
    convert_units(entry, key, errors);
  }
}

std::string_view other_unit_key(std::string_view key, std::string_view unit) {
  for (const OtherUnit& row : kOtherUnits) {
    if (unit == "rad/s" && row.field == key) return row.key;
  }
  return "";
}

std::string_view rpm_key(std::string_view map, std::span<const std::string_view> fields) {
  for (const OtherUnit& row : kOtherUnits) {
    if (row.map == map && std::ranges::find(fields, row.field) != fields.end()) return row.key;
  }
  return "";
}

}  // namespace hedgehop::sim
