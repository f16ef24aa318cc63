#include "sim/flightlog/named_parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <variant>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/fields/bounds.h"
#include "sim/fields/field_types.h"

namespace hedgehop::sim {
namespace {

/// A number of a config and its field in describe().
struct FoundNumber {
  double* member;
  fields::Field field;
};

/// The visitor that finds the number with a dotted name.
class NumberFinder {
 public:
  NumberFinder(std::string prefix, std::string_view name, std::optional<FoundNumber>& found,
               std::vector<std::string>& names)
      : prefix_(std::move(prefix)), name_(name), found_(found), names_(names) {}

  template <class T>
  void operator()(std::string_view key, T& value, const fields::Field& field) {
    visit(join_path(prefix_, key), value, field);
  }

 private:
  template <class T>
  void visit(const std::string& path, T& value, const fields::Field& field) {
    if constexpr (fields::NumberField<T>) {
      names_.push_back(path);
      if (path == name_) found_ = FoundNumber{&value, field};
    } else if constexpr (fields::EigenField<T> || fields::VectorField<T>) {
      for (size_t i = 0; i < static_cast<size_t>(value.size()); ++i) {
        visit(join_path(path, std::to_string(i)), value[static_cast<decltype(value.size())>(i)], field);
      }
    } else if constexpr (fields::VariantField<T>) {
      std::visit([&](auto& chosen) { inside(path, chosen); }, value);
    } else if constexpr (fields::StructField<T>) {
      inside(path, value);
    }
  }
  template <class T>
  void inside(const std::string& path, T& value) {
    NumberFinder finder(path, name_, found_, names_);
    describe(finder, value);
  }

  std::string prefix_;
  std::string_view name_;
  std::optional<FoundNumber>& found_;
  std::vector<std::string>& names_;
};

constexpr std::string_view kColumns = "columns";

FoundNumber find_number(FittedModel& model, const std::string& name) {
  std::optional<FoundNumber> found;
  std::vector<std::string> names;
  NumberFinder in_vehicle("", name, found, names);
  std::visit([&](auto& vehicle) { describe(in_vehicle, vehicle); }, model.vehicle);
  NumberFinder in_columns(std::string(kColumns), name, found, names);
  in_columns("pwm", model.columns.pwm, {});
  in_columns("rate_feedback", model.columns.rate_feedback, {.at_least = 0.0, .at_most = 100.0});
  for (LogColumnConfig& column : model.columns.columns) {
    NumberFinder in_column(join_path(kColumns, column.name), name, found, names);
    describe(in_column, column);
  }
  if (found) return *found;
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw InputError(
      fmt::format("--fit {}: the vehicle and its columns have no such number{}", name, suggestion(name, known)));
}

double in_yaml_unit(double member, const fields::Field& field) {
  return fields::is_degrees(field.unit) ? member * (180.0 / std::numbers::pi) : member;
}
double in_member_unit(double value, const fields::Field& field) {
  return fields::is_degrees(field.unit) ? fields::to_radians(value) : value;
}

}  // namespace

FitParameter fit_parameter(const FittedModel& model, const std::string& text) {
  const size_t equals = text.find('='), colon = text.find(':', equals == std::string::npos ? 0 : equals);
  const auto number = [&](size_t begin, size_t end) {
    return parse_number(std::string_view(text).substr(begin, end - begin), /*degrees=*/false);
  };
  const bool shaped = equals != std::string::npos && colon != std::string::npos;
  const ParsedNumber low = shaped ? number(equals + 1, colon) : ParsedNumber{},
                     high = shaped ? number(colon + 1, text.size()) : ParsedNumber{};
  if (low.kind != ParsedNumber::Kind::number || high.kind != ParsedNumber::Kind::number ||
      !(low.member < high.member)) {
    throw InputError(
        fmt::format("--fit {}: expected NAME=LOW:HIGH with LOW below HIGH, such as rotor.drag=0:1e-3", text));
  }
  FittedModel scratch = model;
  FitParameter parameter{text.substr(0, equals), low.member, high.member, {}};
  const FoundNumber found = find_number(scratch, parameter.name);
  parameter.unit = found.field.unit;
  for (const double bound : {parameter.low, parameter.high}) {
    if (const auto broken = fields::broken_bound(in_member_unit(bound, found.field), found.field)) {
      throw InputError(fmt::format("--fit {}: the bound {} must be {}", text, bound, *broken));
    }
  }
  return parameter;
}

double parameter_value(const FittedModel& model, const FitParameter& parameter) {
  FittedModel scratch = model;
  const FoundNumber found = find_number(scratch, parameter.name);
  return in_yaml_unit(*found.member, found.field);
}

void set_parameter(FittedModel& model, const FitParameter& parameter, double value) {
  const FoundNumber found = find_number(model, parameter.name);
  *found.member = in_member_unit(value, found.field);
}

}  // namespace hedgehop::sim
