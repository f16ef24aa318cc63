#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace hedgehop::fields {

/// What `describe(visitor, config)` says of one field. Bounds are in the unit that YAML uses ("deg" and "deg/s" are
/// read as degrees into a member in radians; every other unit is SI and read as it stands).
struct Field {
  std::string_view unit = "";                  ///< "m", "s", "deg", "deg/s", "Hz", "px", "m/s", "kg", ...; "" for none
  std::optional<double> above = {};            ///< value > above
  std::optional<double> at_least = {};         ///< value >= at_least
  std::optional<double> below = {};            ///< value < below
  std::optional<double> at_most = {};          ///< value <= at_most
  std::vector<std::string_view> choices = {};  ///< for an enum: choices[i] names the enumerator of value i
  bool required = false;                       ///< a missing key is a fault
  std::string_view selector = "type";  ///< for a std::variant of structs with kName: the key that names the choice
  std::string_view meaning = "";
};

}  // namespace hedgehop::fields
