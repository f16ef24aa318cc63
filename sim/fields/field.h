#pragma once

#include <concepts>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hedgehop::fields {

/// The properties of one field in `describe(visitor, config)`. Bounds are in the unit of YAML: "deg" and "deg/s" are
/// read as degrees into a member in radians; every other unit is SI and read unchanged.
struct Field {
  std::string_view unit = "";                  ///< "m", "s", "deg", "deg/s", "Hz", "px", "m/s", "kg", ...; "" for none
  std::optional<double> above = {};            ///< value > above
  std::optional<double> at_least = {};         ///< value >= at_least
  std::optional<double> below = {};            ///< value < below
  std::optional<double> at_most = {};          ///< value <= at_most
  std::vector<std::string_view> choices = {};  ///< for an enum: choices[i] names the enumerator of value i
  bool required = false;                       ///< a missing key is an error
  std::string_view selector = "type";  ///< for a std::variant of structs with kName: the key that names the choice
  std::string_view meaning = "";
};

/// `Config` or `const Config`: `describe(Visitor& v, fields::ConfigOf<FlowConfig> auto& c)` lists the fields of a
/// config to visitors that write them and to visitors that only read them.
template <class T, class Config>
concept ConfigOf = std::same_as<std::remove_const_t<T>, Config>;

/// Returns the part of a config that it inherits from `Base`, const if the config is.
template <class Base, class Config>
constexpr auto& base(Config& config) {
  return static_cast<std::conditional_t<std::is_const_v<Config>, const Base, Base>&>(config);
}

/// Returns the maximum magnitude of a field in this unit without a bound of its own; empty for other units. The limits
/// keep all results of a config finite.
constexpr std::optional<double> unit_limit(std::string_view unit) {
  if (unit == "m") return 100e3;  // beyond it, the single precision of images is visible (8 mm)
  if (unit == "m/s") return 1e3;  // beyond any rotorcraft, obstacle or wind
  if (unit == "s") return 1e9;    // longer than any flight, so a time constant may mean "never"
  if (unit == "px") return 1e6;   // beyond any image
  return {};
}

/// Minimum rate of periodic events, Hz: once in 100 s.
inline constexpr double kMinRateHz = 0.01;

/// Returns the field with a bound on both sides if its unit has a limit.
inline Field bounded(Field field) {
  if (const std::optional<double> limit = unit_limit(field.unit)) {
    if (!field.above && !field.at_least) field.at_least = -*limit;
    if (!field.below && !field.at_most) field.at_most = *limit;
  }
  return field;
}

}  // namespace hedgehop::fields
