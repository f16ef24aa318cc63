#pragma once

#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "sim/fields/field.h"
#include "sim/fields/field_types.h"

/// Judges values against the bounds of their fields: for the YAML reader and for every library that takes a config.
namespace hedgehop::fields {

/// Whether the field's unit is degrees or degrees a second, whose member is in radians.
inline bool is_degrees(std::string_view unit) { return unit == "deg" || unit == "deg/s"; }

/// Returns an angle in radians. The conversion has more digits than a double: the doubles in radians are here and there
/// closer together than those in degrees, and each of them must have a decimal in degrees.
inline double to_radians(long double degrees) {
  return static_cast<double>(degrees * (std::numbers::pi_v<long double> / 180.0L));
}

/// Returns the shortest decimal of `value`, without an exponent where that is readable.
inline std::string decimal(double value) {
  const double magnitude = std::abs(value);
  const bool readable = magnitude == 0.0 || (magnitude >= 1e-4 && magnitude < 1e15);
  char text[32];
  const auto end = std::to_chars(std::begin(text), std::end(text), value,
                                 readable ? std::chars_format::fixed : std::chars_format::scientific);
  return {text, end.ptr};
}

/// Returns what a value must be and is not: "finite", "> 0 m", "<= 90 deg"; nothing when it is within its bounds.
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

/// The visitor that judges the fields of one struct, and those of what they hold.
class BoundsVisitor {
 public:
  explicit BoundsVisitor(std::string_view prefix) : prefix_(prefix) {}

  template <class T>
  void operator()(std::string_view key, const T& value, const Field& field) const {
    judge(prefix_.empty() ? std::string(key) : prefix_ + "." + std::string(key), value, field);
  }

 private:
  template <class T>
  static void judge(const std::string& path, const T& value, const Field& field) {
    if constexpr (NumberField<T>) {
      if (const auto bound = broken_bound(value, field)) {
        const double degrees = static_cast<double>(value * (180.0L / std::numbers::pi_v<long double>));
        refuse(path, decimal(is_degrees(field.unit) ? degrees : value), *bound);
      }
    } else if constexpr (IntegerField<T>) {
      if (const auto bound = broken_bound(static_cast<double>(value), field)) {
        refuse(path, std::to_string(value), *bound);
      }
    } else if constexpr (ChoiceField<T>) {
      if (static_cast<size_t>(value) >= field.choices.size()) {
        refuse(path, std::to_string(static_cast<long>(value)), "one of its choices");
      }
    } else if constexpr (OptionalField<T>) {
      if (value) judge(path, *value, field);
    } else if constexpr (EigenField<T> || VectorField<T>) {
      for (size_t i = 0; i < static_cast<size_t>(value.size()); ++i) {
        judge(path + "." + std::to_string(i), item(value, i), field);
      }
    } else if constexpr (VariantField<T>) {
      std::visit([&](const auto& chosen) { judge_struct(path, chosen); }, value);
    } else if constexpr (SealedField<T>) {
      value.require_bounds(path);
    } else if constexpr (StructField<T>) {
      judge_struct(path, value);
    }
  }

  template <StructField T>
  static void judge_struct(const std::string& path, const T& value) {
    BoundsVisitor visitor(path);
    T copy = value;  // describe() takes what a reader may write to
    describe(visitor, copy);
  }

  template <class T>
  static decltype(auto) item(const T& list, size_t index) {
    return list[static_cast<decltype(list.size())>(index)];
  }

  [[noreturn]] static void refuse(const std::string& path, const std::string& value, const std::string& bound) {
    throw std::invalid_argument(path + ": " + value + "; must be " + bound);
  }

  std::string prefix_;
};

/// Returns the config after requiring that every number in `config` is finite and that every value keeps the bounds of
/// its field.
/// @param config  a struct with describe(); structs, lists, optionals and variants inside it are judged too.
/// @param prefix  dotted key of the config, or "" when the keys are to begin with its own.
/// Throws std::invalid_argument "<dotted.key>: <value>; must be <bound> <unit>", as in "lens.fov: 190; must be < 180
/// deg".
template <class Config>
const Config& require_bounds(const Config& config, std::string_view prefix = "") {
  BoundsVisitor visitor(prefix);
  Config copy = config;  // describe() takes what a reader may write to
  describe(visitor, copy);
  return config;
}

}  // namespace hedgehop::fields
