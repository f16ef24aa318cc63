#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "avoidance/module.h"
#include "dynamics/rigid_body.h"
#include "dynamics/sensors/ranger.h"
#include "dynamics/vehicle.h"
#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Data for an autopilot outside this process after a physics step: the true state, from which it simulates its
/// own sensors, and the module's output.
struct OutsideInput {
  int64_t step = 0;             ///< physics steps since the autopilot's first packet
  std::optional<int64_t> t_ns;  ///< of the flight; nullopt before its start
  bool on_stand = false;        ///< whether the stand holds the vehicle
  dynamics::RigidBodyState body;
  Eigen::Vector3d specific_force_B = Eigen::Vector3d::Zero();  ///< ideal accelerometers at the mass center, m/s^2
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();            ///< velocity of the air, m/s
  dynamics::sensors::BeamDistance beam_distance = {};          ///< true distances of range finders
  /// The module's input on this tick, null if no decision is due; valid during the call.
  const avoidance::Observation* observation = nullptr;
  /// The estimate of the module's navigation; null before the flight.
  const avoidance::NavigationState* navigation = nullptr;
  /// The module's decision on this tick, null without one; valid during the call.
  const avoidance::Decision* decision = nullptr;
  /// The module's command that is in effect, after the scenario's latency; null before the first.
  const avoidance::Command* command = nullptr;
};

/// Commands of an autopilot for the next physics step.
struct OutsideCommand {
  dynamics::ActuatorCommand actuators;
  bool engine_on = true;  ///< whether the engine of a helicopter runs
};

/// The end of a flight by its link.
struct LinkEnd {
  Outcome outcome = Outcome::link_lost;
  std::string cause;
};
/// Returns the end of a lost link. @param words  why, with the tick.
inline LinkEnd link_lost(const std::string& words) { return {Outcome::link_lost, "link: " + words}; }

/// An autopilot outside this process that flies the vehicle instead of dynamics::Avionics, in lockstep: one exchange
/// per physics step. The flight is a function of the scenario and the commands.
class OutsideAutopilot {
 public:
  virtual ~OutsideAutopilot() = default;

  /// Takes the module's cameras and commands before the first exchange. Throws InputError if the link cannot serve
  /// them.
  virtual void prepare(const avoidance::Needs& /*needs*/, const avoidance::Setup& /*setup*/) {}

  /// Passes the state after the last step and returns the commands for the next one. On the first call, the state is
  /// that of the stand, and the autopilot does not receive it.
  virtual std::variant<OutsideCommand, LinkEnd> exchange(const OutsideInput& input) = 0;
  /// Marks the start of the flight's clock. @param step  as OutsideInput::step.
  virtual void on_start(int64_t step) = 0;
  /// Returns the condition for the start of the flight that is not yet met, for a message; may be empty.
  virtual std::string awaited() const { return ""; }
  /// Returns the counts so far.
  virtual LinkFigures figures() const = 0;
};

}  // namespace hedgehop::sim
