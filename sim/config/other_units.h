#pragma once

#include <span>
#include <string_view>

#include "sim/config/config_tree.h"
#include "sim/config/input_error.h"

/// Keys that give a value in another unit than the field's: `rpm` in `main_rotor` is its `speed`, which is in rad/s.
namespace hedgehop::sim {

/// Key of the parameters of a foreign module, whose names and units are the module's own.
inline constexpr std::string_view kParametersKey = "parameters";

/// Renames these keys in an input, before it overrides another, and converts their values. Does not change a
/// foreign module's parameters.
/// @param key  of the node. @param errors  gains each map with both keys.
void convert_units(Node& node, std::string_view key, ErrorList& errors);
/// As above, for an entry and the values in it. @param map  key of the map that has the entry.
void convert_units(Entry& entry, std::string_view map, ErrorList& errors);

/// Returns the key that gives a field in another unit; empty if there is none.
std::string_view other_unit_key(std::string_view key, std::string_view unit);
/// Returns the key that gives one of the fields of a map in rpm; empty if there is none. @param map  key of the map.
std::string_view rpm_key(std::string_view map, std::span<const std::string_view> fields);

}  // namespace hedgehop::sim
