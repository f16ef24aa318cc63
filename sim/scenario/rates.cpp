#include "sim/scenario/rates.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

namespace hedgehop::sim {
namespace {

constexpr double kRoundOff = 1e-9;  // relative

struct Rate {
  std::string path;
  double hz;
};

/// Returns the rates that the physics rate must be a multiple of, each rate of cameras once. Cameras are last, as they
/// are the first to adapt.
std::vector<Rate> rates_of(const Scenario& scenario) {
  const dynamics::AvionicsConfig& avionics = scenario.avionics;
  std::vector<Rate> rates{{"control_rate", static_cast<double>(scenario.control_rate_hz)},
                          {"avionics.imu.rate", avionics.imu.rate_hz},
                          {"avionics.gps.rate", avionics.gps.rate_hz},
                          {"avionics.height_sensor.rate", avionics.height_sensor.ranger.rate_hz},
                          {"avionics.magnetometer.rate", avionics.magnetometer.rate_hz}};
  if (avionics.barometer.enabled) rates.push_back({"avionics.barometer.rate", avionics.barometer.rate_hz});
  if (avionics.range_finder.ranger.enabled) {
    rates.push_back({"avionics.range_finder.rate", avionics.range_finder.ranger.rate_hz});
  }
  std::set<double> of_cameras;
  for (size_t i = 0; i < scenario.rig.cameras.size(); ++i) {
    const double hz = scenario.rig.cameras[i].rate_hz;
    if (of_cameras.insert(hz).second) rates.push_back({fmt::format("rig.cameras.{}.rate", i), hz});
  }
  return rates;
}

bool is_whole(double number) { return std::abs(number - std::round(number)) <= kRoundOff * number; }

/// Whether `hz` divides the physics rate.
bool divides(double hz, int64_t physics_hz) {
  const double ticks = static_cast<double>(physics_hz) / hz;
  return ticks >= 1.0 - kRoundOff && is_whole(ticks);
}

/// Returns the smallest multiple of `multiple` that `hz` divides, if it is at most kMaxChosenPhysicsHz.
std::optional<int64_t> common_multiple(int64_t multiple, double hz) {
  for (int64_t common = multiple; common <= kMaxChosenPhysicsHz; common += multiple) {
    if (divides(hz, common)) return common;
  }
  return {};
}

/// Returns the two rates nearest to `hz`, below and above it, that divide a multiple of `multiple` in the range. They
/// have at most four decimals, so that they can be typed.
std::vector<double> nearest_rates(double hz, int64_t min_hz, int64_t max_hz, int64_t multiple) {
  std::optional<double> below, above;
  for (int64_t physics = multiple; physics <= max_hz; physics += multiple) {
    if (physics < min_hz) continue;
    const double rate = static_cast<double>(physics);
    const auto candidate = [&](int64_t ticks) -> std::optional<double> {
      if (ticks < 1) return {};
      const double decimal = std::round(1e4 * rate / static_cast<double>(ticks)) / 1e4;
      return decimal > 0.0 && divides(decimal, physics) ? std::optional(decimal) : std::nullopt;
    };
    const auto ticks = static_cast<int64_t>(std::min(rate / hz, 1e7));
    for (int64_t n = ticks; n >= 1; --n) {
      if (const auto found = candidate(n); found && *found > hz) {
        above = std::min(above.value_or(*found), *found);
        break;
      }
    }
    for (int64_t n = std::max<int64_t>(ticks, 1); n <= 10 * (ticks + physics); ++n) {
      if (const auto found = candidate(n); found && *found < hz) {
        below = std::max(below.value_or(*found), *found);
        break;
      }
    }
  }
  std::vector<double> nearest;
  if (below) nearest.push_back(*below);
  if (above) nearest.push_back(*above);
  return nearest;
}

std::string advice(const std::vector<double>& nearest) {
  if (nearest.empty()) return "";
  return fmt::format("; the nearest that {}: {} Hz", nearest.size() == 1 ? "does" : "do", fmt::join(nearest, " and "));
}

/// Chooses the physics rate. A rate that does not fit those before it is not considered. Returns the errors.
std::vector<FieldError> choose(Scenario& scenario) {
  int64_t multiple = 1;
  std::set<double> fitting;
  std::vector<Rate> others;
  for (const Rate& rate : rates_of(scenario)) {
    if (const std::optional<int64_t> common = common_multiple(multiple, rate.hz)) {
      multiple = *common;
      fitting.insert(rate.hz);
    } else {
      others.push_back(rate);
    }
  }
  const int64_t min_hz = scenario.link ? kMinLinkedPhysicsHz : kMinChosenPhysicsHz;
  scenario.physics_rate_hz = (min_hz + multiple - 1) / multiple * multiple;
  std::vector<FieldError> errors;
  for (const Rate& rate : others) {
    const std::vector<double> nearest = nearest_rates(rate.hz, min_hz, kMaxChosenPhysicsHz, multiple);
    errors.push_back(
        {rate.path, fmt::format("{} Hz and the other rates ({} Hz) do not divide one physics rate from {} to {} Hz{}",
                                rate.hz, fmt::join(fitting, ", "), min_hz, kMaxChosenPhysicsHz, advice(nearest))});
  }
  return errors;
}

}  // namespace

std::vector<FieldError> set_physics_rate(Scenario& scenario) {
  std::vector<FieldError> errors;
  const bool is_stated = scenario.physics_rate_hz.has_value();
  if (!is_stated) errors = choose(scenario);
  const int64_t physics_hz = *scenario.physics_rate_hz;
  std::vector<Rate> rates;
  if (errors.empty()) rates = rates_of(scenario);
  if (scenario.film.enabled) rates.push_back({"film.rate", scenario.film.rate_hz});
  for (const Rate& rate : rates) {
    if (divides(rate.hz, physics_hz)) continue;
    errors.push_back({rate.path, fmt::format("{} Hz does not divide the physics rate of {} Hz{}{}", rate.hz, physics_hz,
                                             advice(nearest_rates(rate.hz, physics_hz, physics_hz, physics_hz)),
                                             is_stated ? "; without 'physics_rate', a rate is chosen" : "")});
  }
  return errors;
}

}  // namespace hedgehop::sim
