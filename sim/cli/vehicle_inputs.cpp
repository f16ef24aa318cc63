#include "sim/cli/vehicle_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <variant>

#include "dynamics/control/hover_model.h"
#include "dynamics/steady_flight.h"
#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/fields/quantities.h"

namespace hedgehop::sim::cli {
namespace {

std::vector<VehicleInput> inputs_of(const dynamics::VehicleConfig& vehicle) {
  enum : Eigen::Index { u, v, w, p, q, r, phi, theta, psi };
  const double deg = 1.0 / kRadPerDeg;
  if (std::holds_alternative<dynamics::helicopter::HelicopterConfig>(vehicle)) {
    return {{"collective", dynamics::kHeave, "deg", deg, "theta_c", {w}},
            {"lateral", dynamics::kRoll, "deg", deg, "delta_lat", {p, phi}},
            {"longitudinal", dynamics::kPitch, "deg", deg, "delta_lon", {q, theta}},
            {"tail", dynamics::kYaw, "deg", deg, "theta_t", {r, psi}}};
  }
  return {{"thrust", dynamics::kHeave, "N", 1.0, "T", {w}},
          {"roll", dynamics::kRoll, "N m", 1.0, "L", {p, phi}},
          {"pitch", dynamics::kPitch, "N m", 1.0, "M", {q, theta}},
          {"yaw", dynamics::kYaw, "N m", 1.0, "N", {r, psi}}};
}

}  // namespace

VehicleInput vehicle_input(const dynamics::VehicleConfig& vehicle, const std::string& name) {
  std::vector<std::string> names;
  for (const VehicleInput& input : inputs_of(vehicle)) {
    if (input.name == name) return input;
    names.push_back(input.name);
  }
  throw InputError(fmt::format("--input {}: the controls of this vehicle are {}", name, fmt::join(names, ", ")));
}

double input_size(const VehicleInput& input, const std::string& option, const std::string& text) {
  struct Unit {
    std::string_view text, of;
    double factor;
  };
  static constexpr Unit kUnits[] = {
      {"deg", "deg", kRadPerDeg}, {"rad", "deg", 1.0}, {"N m", "N m", 1.0}, {"Nm", "N m", 1.0}, {"N", "N", 1.0}};
  for (const Unit& unit : kUnits) {
    if (unit.of != input.unit || !text.ends_with(unit.text)) continue;
    std::string number = text.substr(0, text.size() - unit.text.size());
    while (number.ends_with(' ')) number.pop_back();
    const ParsedNumber parsed = parse_number(number, /*degrees=*/false);
    if (parsed.kind == ParsedNumber::Kind::number && parsed.member != 0.0) return parsed.member * unit.factor;
  }
  const std::string valid = input.unit == "deg" ? "deg or rad, such as 1deg"
                            : input.unit == "N" ? "N, such as 0.5N"
                                                : "N m, such as 0.01Nm";
  throw InputError(fmt::format("{} {}: expected a number other than 0 in {}", option, text, valid));
}

void require_within_stops(const dynamics::VehicleConfig& vehicle, const VehicleInput& input, double size,
                          double speed_mps) {
  const auto flight = dynamics::steady_flight(vehicle, {speed_mps, 0.0, 0.0});
  if (!flight) throw InputError(fmt::format("--speed {}: no steady flight at this airspeed", speed_mps));
  if (const auto beyond = flight->beyond(); !beyond.empty()) {
    throw InputError(fmt::format("--speed {}: not flyable, beyond the limits: {}", speed_mps, fmt::join(beyond, "; ")));
  }
  const dynamics::control::HoverModel model = dynamics::control::make_hover_model(vehicle);
  const double lowest = model.lowest[input.axis] * input.scale, highest = model.highest[input.axis] * input.scale;
  for (const dynamics::Quantity& quantity : flight->quantities) {
    if (quantity.name != input.trim) continue;
    const double reach = std::abs(size) * input.scale;
    if (quantity.value + reach <= highest && quantity.value - reach >= lowest) return;
    throw InputError(
        fmt::format("{0}: trim {1:.4g} {5} and a size of {2:.4g} {5} are beyond the stops {3:.4g} and "
                    "{4:.4g} {5}",
                    input.name, quantity.value, reach, lowest, highest, input.unit));
  }
}

}  // namespace hedgehop::sim::cli
