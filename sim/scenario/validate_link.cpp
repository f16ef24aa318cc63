#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <variant>

#include "sim/fields/quantities.h"
#include "sim/scenario/motor_frames.h"
#include "sim/scenario/validate.h"

namespace hedgehop::sim {
namespace {

using Swashplate = HelicopterLinkConfig::Swashplate;

class LinkValidator {
 public:
  LinkValidator(const Scenario& scenario, const ArduPilotLinkConfig& link) : scenario_(scenario), link_(link) {}

  std::vector<FieldError> errors() {
    if (const auto* const vehicle = std::get_if<dynamics::multicopter::MulticopterConfig>(&scenario_.vehicle)) {
      motors(*vehicle);
    } else if (!link_.helicopter) {
      add("link.helicopter", "is missing; the vehicle is a helicopter");
    } else {
      swashplate(*link_.helicopter);
    }
    ranges();
    in_addr ignored{};
    if (::inet_pton(AF_INET, link_.host.c_str(), &ignored) != 1) {
      add("link.host", fmt::format("must be a numeric IPv4 address such as 127.0.0.1, got '{}'", link_.host));
    }
    if (scenario_.physics_rate_hz && *scenario_.physics_rate_hz < link_.loop_rate_hz) {
      add("physics_rate",
          fmt::format("{} Hz is below the loop rate of {} Hz", *scenario_.physics_rate_hz, link_.loop_rate_hz));
    }
    return errors_;
  }

 private:
  void motors(const dynamics::multicopter::MulticopterConfig& vehicle) {
    const MulticopterLinkConfig& c = link_.multicopter;
    require_less("link.multicopter.pwm_max", c.pwm_max_us, "pwm_min", c.pwm_min_us, "us");
    std::ranges::move(match_motors(vehicle, c.frame_class, c.frame_type).errors, std::back_inserter(errors_));
  }

  void swashplate(const HelicopterLinkConfig& c) {
    const bool has_four = c.swashplate == Swashplate::h4_90 || c.swashplate == Swashplate::h4_45;
    const size_t servos = has_four ? 4 : 3;
    if (!c.trim_us.empty() && c.trim_us.size() != servos) {
      add("link.helicopter.trim", fmt::format("{} pulses; the swashplate has {} servos", c.trim_us.size(), servos));
    }
    require_less("link.helicopter.collective_max", c.collective_max_us, "collective_min", c.collective_min_us, "us");
    require_less("link.helicopter.collective_high", kDegPerRad * c.collective_high_rad, "collective_low",
                 kDegPerRad * c.collective_low_rad, "deg");
    if (!(c.tail.min_us < c.tail.trim_us && c.tail.trim_us < c.tail.max_us)) {
      add("link.helicopter.tail", fmt::format("min, trim and max must rise, got {}, {} and {} us", c.tail.min_us,
                                              c.tail.trim_us, c.tail.max_us));
    }
    require_less("link.helicopter.throttle_max", c.throttle_max_us, "throttle_min", c.throttle_min_us, "us");
  }

  /// Adds an error to `path` unless the value of another key is less than its value.
  void require_less(std::string path, double value, std::string_view other, double other_value, std::string_view unit) {
    if (other_value < value) return;
    add(std::move(path),
        fmt::format("must be greater than {} ({:.6g} {}), got {:.6g}", other, other_value, unit, value));
  }

  void ranges() {
    constexpr size_t kMaxRangeFinders = 6;  // keys rng_1 to rng_6
    if (link_.range_finders.size() > kMaxRangeFinders) {
      add("link.range_finders",
          fmt::format("{} range finders; valid: up to {}", link_.range_finders.size(), kMaxRangeFinders));
    }
    for (size_t i = 0; i < link_.range_finders.size(); ++i) {
      if (link_.range_finders[i].direction_B.norm() > 0.0) continue;
      add(fmt::format("link.range_finders.{}.direction", i), "must not be zero");
    }
  }

  void add(std::string path, std::string message) { errors_.push_back({std::move(path), std::move(message)}); }

  const Scenario& scenario_;
  const ArduPilotLinkConfig& link_;
  std::vector<FieldError> errors_;
};

std::vector<FieldError> errors_of(const Scenario& scenario, const ArduPilotLinkConfig& link) {
  return LinkValidator(scenario, link).errors();
}

std::vector<FieldError> errors_of(const Scenario& scenario, const Px4LinkConfig& link) {
  const auto* const vehicle = std::get_if<dynamics::multicopter::MulticopterConfig>(&scenario.vehicle);
  if (!vehicle) return {{"link.type", "px4 flies multicopters; the vehicle is a helicopter"}};
  std::vector<FieldError> errors = match_motors(*vehicle, link.frame_class, link.frame_type, "link").errors;
  constexpr int64_t kImuRateHz = 250;  // of PX4's lockstep
  if (scenario.physics_rate_hz && *scenario.physics_rate_hz % kImuRateHz != 0) {
    errors.push_back({"physics_rate", fmt::format("{} Hz is no multiple of PX4's IMU rate, {} Hz",
                                                  *scenario.physics_rate_hz, kImuRateHz)});
  }
  return errors;
}

}  // namespace

std::vector<FieldError> link_errors(const Scenario& scenario) {
  if (!scenario.link) return {};
  return std::visit([&](const auto& link) { return errors_of(scenario, link); }, *scenario.link);
}

}  // namespace hedgehop::sim
