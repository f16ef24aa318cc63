#pragma once

#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/fields/field.h"
#include "sim/fields/field_types.h"
#include "sim/fields/invalid_field.h"

/// Checks values against the bounds of their fields, for the YAML reader and every library that takes a config.
namespace hedgehop::fields {

/// Whether the field's unit is degrees or degrees per second; its member is in radians.
inline bool is_degrees(std::string_view unit) { return unit == "deg" || unit == "deg/s"; }

/// Returns an angle in radians. The conversion has more digits than a double, because doubles in radians can be closer
/// together than doubles in degrees, and each of them must have a decimal in degrees.
inline double to_radians(long double degrees) {
  return static_cast<double>(degrees * (std::numbers::pi_v<long double> / 180.0L));
}

/// Returns the shortest decimal of `value`, without an exponent if that is readable.
inline std::string decimal(double value) {
  const double magnitude = std::abs(value);
  const bool readable = magnitude == 0.0 || (magnitude >= 1e-4 && magnitude < 1e15);
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value,
                                 readable ? std::chars_format::fixed : std::chars_format::scientific);
  return {text, end.ptr};
}

/// Returns the bound that a value violates: "finite", "> 0 m", "<= 90 deg"; empty if it is within its bounds.
/// @param member  in the unit of the member: rad and rad/s for fields in deg and deg/s.
/// @param listed  as describe() lists it; a side without a bound has the limit of the unit.
inline std::optional<std::string> broken_bound(double member, const Field& listed) {
  if (!std::isfinite(member)) return "finite";
  const Field field = bounded(listed);
  // Both sides are rounded to radians alike, so a value written equal to its bound stays equal to it.
  const auto in_member_unit = [&](double bound) { return is_degrees(field.unit) ? to_radians(bound) : bound; };
  const auto words = [&](std::string_view relation, double bound) {
    std::string text = std::string(relation) + " " + decimal(bound);
    return field.unit.empty() ? text : text + " " + std::string(field.unit);
  };
  if (field.above && !(member > in_member_unit(*field.above))) return words(">", *field.above);
  if (field.at_least && !(member >= in_member_unit(*field.at_least))) return words(">=", *field.at_least);
  if (field.below && !(member < in_member_unit(*field.below))) return words("<", *field.below);
  if (field.at_most && !(member <= in_member_unit(*field.at_most))) return words("<=", *field.at_most);
  return {};
}

/// The visitor that checks the fields of one struct, and the fields of its members, against their bounds.
class BoundsVisitor {
 public:
  /// @param errors  gains every field out of its bounds.
  BoundsVisitor(std::string_view prefix, std::vector<InvalidField>& errors) : prefix_(prefix), errors_(errors) {}

  template <class T>
  void operator()(std::string_view key, const T& value, const Field& field) const {
    check(prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key), value, field);
  }

 private:
  template <class T>
  void check(const std::string& path, const T& value, const Field& field) const {
    if constexpr (NumberField<T>) {
      if (const auto bound = broken_bound(value, field)) {
        const double degrees = static_cast<double>(value * (180.0L / std::numbers::pi_v<long double>));
        refuse(path, *bound, decimal(is_degrees(field.unit) ? degrees : value));
      }
    } else if constexpr (IntegerField<T>) {
      if (const auto bound = broken_bound(static_cast<double>(value), field)) {
        refuse(path, *bound, std::to_string(value));
      }
    } else if constexpr (ChoiceField<T>) {
      if (static_cast<size_t>(value) >= field.choices.size()) {
        refuse(path, "one of its choices", std::to_string(static_cast<long>(value)));
      }
    } else if constexpr (OptionalField<T>) {
      if (value) check(path, *value, field);
    } else if constexpr (EigenField<T> || VectorField<T>) {
      for (size_t i = 0; i < static_cast<size_t>(value.size()); ++i) {
        check(path + "." + std::to_string(i), item(value, i), field);
      }
    } else if constexpr (VariantField<T>) {
      std::visit([&](const auto& chosen) { check_struct(path, chosen); }, value);
    } else if constexpr (SealedField<T>) {
      value.check_bounds(path, errors_);
    } else if constexpr (StructField<T>) {
      check_struct(path, value);
    }
  }

  template <StructField T>
  void check_struct(const std::string& path, const T& value) const {
    BoundsVisitor visitor(path, errors_);
    describe(visitor, value);
  }

  template <class T>
  static decltype(auto) item(const T& list, size_t index) {
    return list[static_cast<decltype(list.size())>(index)];
  }

  void refuse(const std::string& path, const std::string& bound, const std::string& value) const {
    errors_.emplace_back(path, "must be " + bound + ", got " + value);
  }

  std::string prefix_;
  std::vector<InvalidField>& errors_;
};

/// Returns every field of a config that is not finite or out of its bounds.
/// @param config  a struct with describe(), including its structs, lists, optionals and variants.
/// @param prefix  dotted key of the config; "" if the keys begin with its own.
template <class Config>
std::vector<InvalidField> invalid_fields(const Config& config, std::string_view prefix = "") {
  std::vector<InvalidField> errors;
  BoundsVisitor visitor(prefix, errors);
  describe(visitor, config);
  return errors;
}

/// Returns the config. Throws the first of its invalid_fields(), as in "lens.fov: must be < 180 deg, got 190".
template <class Config>
const Config& require_bounds(const Config& config, std::string_view prefix = "") {
  const std::vector<InvalidField> errors = invalid_fields(config, prefix);
  if (!errors.empty()) throw InvalidField(errors.front());
  return config;
}

}  // namespace hedgehop::fields
