#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "avoidance/module.h"
#include "dynamics/rigid_body.h"
#include "dynamics/vehicle.h"
#include "scenes/scene.h"
#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"
#include "sim/libm/random.h"
#include "sim/loop/aircraft.h"
#include "sim/loop/steering.h"

namespace hedgehop::sim {

/// 64-bit FNV-1a over the bytes of the true states: equal hashes mean equal flights, bit for bit.
class TrajectoryHash {
 public:
  void add(const dynamics::RigidBodyState& body);
  /// 16 hexadecimal digits.
  std::string hex() const;

 private:
  Fnv1a hash_;
};

/// Status of a decision that the caller of a simulation replaced.
inline constexpr std::string_view kCommanded = "commanded";

/// Collects a flight's tables and figures during the flight.
class FlightLog {
 public:
  FlightLog(const scenes::Scene& scene, const dynamics::Vehicle& vehicle) : scene_(scene) {
    const auto& names = vehicle.control_names();
    std::copy(names.begin(), names.end(), flight_.control_names.begin());
  }

  void set_signals(const std::vector<avoidance::Signal>& signals);
  /// Call on every physics tick; keeps the closest approaches.
  void add(double t_s, const Eigen::Vector3d& p_WB_true, const Proximity& proximity);
  /// Call on every control tick.
  void add(double t_s, const Aircraft& aircraft, const Steering& steering, const Proximity& proximity);
  /// Call on every decision.
  void add(double t_s, const avoidance::Decision& decision);
  /// Call for every direct command, whose values the table does not contain.
  void add_direct_command(double t_s);

  /// Returns the tables so far, without the figures.
  const Flight& tables() const { return flight_; }
  /// Returns the status of the last decision; empty before the first.
  std::string_view status() const {
    return flight_.decisions.empty() ? std::string_view() : std::string_view(flight_.decisions.back().status);
  }

  /// Returns the flight so far with its figures; the caller adds outcome, timing, metrics and checks.
  Flight flight(double flight_time_s) const;

 private:
  const scenes::Scene& scene_;
  Flight flight_;
  TrajectoryHash hash_;
  std::optional<size_t> last_solid_;  ///< nearest obstacle on the last tick; scenes::solid_at()
};

}  // namespace hedgehop::sim
