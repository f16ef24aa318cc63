#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"
#include "sim/flight/flight_watcher.h"
#include "sim/loop/steering.h"
#include "sim/render/renderer.h"
#include "sim/scenario/flight_parts.h"

/// Connects the loop, which flies a scenario, with the verdict, which judges the flight.
namespace hedgehop::sim {

class OutsideAutopilot;

/// Makes the module of a flight: a new one for each.
using ModuleMaker = std::function<std::unique_ptr<avoidance::Module>()>;

/// True motion of the vehicle, for checks and metrics, never for modules. Frames W and B of CONTRIBUTING.md.
struct TrueMotion {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();  ///< of the air, m/s
};

/// A pose of the body at a time >= 0 that the caller chooses.
struct ChosenPose {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
  double t_s = 0.0;  ///< of the moving objects
};

/// A scenario in flight, flown to its end in one call or stepped by the caller. Equal scenarios and commands give
/// bit-identical flights, however they are stepped. A process may have several; each is used by the thread that made
/// it.
class Simulation {
 public:
  /// Starts the flight: at time 0 the cameras have exposed and the sensors have read, before the first decision.
  /// @param watcher  may be null. @param outside  flies a scenario with a link, else null; it outlives the simulation.
  /// Throws InputError for errors that only the assembled parts show (an invalid scene, a
  /// module without its camera, a vehicle that cannot hover), std::runtime_error if no context can be created.
  explicit Simulation(LoadedScenario loaded, FlightWatcher* watcher = nullptr, OutsideAutopilot* outside = nullptr);
  /// As above, for a scenario from a program. It is validated like a file (validate()); the messages are equal, without
  /// positions. @param module  replaces the scenario's module, which is not validated then.
  explicit Simulation(Scenario scenario, ModuleMaker module = {}, FlightWatcher* watcher = nullptr,
                      OutsideAutopilot* outside = nullptr);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Starts the same flight again, with the same scene and renderer. Throws std::logic_error for a linked flight, which
  /// remains as it is. Throws as the constructor; then there is no flight, and all other functions except scenario()
  /// throw std::logic_error until a reset succeeds.
  void reset();
  /// Starts the flight of another seed. A world of its own (Scenario::world_seed) is kept, which is as fast as reset().
  void reset(uint64_t seed);
  /// As above, in another world. @param world_seed  as Scenario::world_seed.
  void reset(uint64_t seed, std::optional<uint64_t> world_seed);

  /// Lets the module decide if a decision is due, then flies to the next decision or to the end.
  /// @return whether the flight continues. Throws std::logic_error if it is over.
  bool step();
  /// As step(), but the command replaces the module's decision. It takes effect after the scenario's latency. A speed
  /// above the vehicle's limit is scaled down to the limit. Body rates and motor speeds (DirectCommand) replace the
  /// autopilot too, until the next command. Throws std::invalid_argument if a value is not finite, or a direct command
  /// is out of its range.
  bool step(const CallerCommand& command);
  /// As step(), but for one physics step. A command is allowed on any step, even if no decision is due.
  bool tick();
  bool tick(const CallerCommand& command);
  /// Lets the module fly to a time, s from the start; has no effect if that time is past. Throws InputError if the
  /// flight ends before.
  void fly_to(double t_s);
  /// Lets the module fly to the end. @return result().
  Flight run();

  /// Whether the flight has ended; seen() and truth() then return its last instant.
  bool over() const;
  /// Whether a decision is due now.
  bool decides() const;
  double t_s() const;  ///< from the start
  const Scenario& scenario() const;
  const scenes::Scene& scene() const;

  /// Returns the module's input: the frames of its cameras if a decision is due, its navigation, its goal. The images
  /// are valid until the next step.
  avoidance::Observation seen() const;
  TrueMotion truth() const;
  /// Returns the true clearances, and whether the vehicle collides.
  const Proximity& proximity() const;
  /// Returns a camera of the rig as calibrated. Throws InputError with the rig's cameras for an unknown role.
  const avoidance::MountedCamera& camera(std::string_view role) const;

  /// Returns the image of a camera now, in any channel, with its imperfections. Does not change the flight.
  /// Throws InputError for a role that the rig lacks, std::invalid_argument for ImageChannel::flow.
  cv::Mat image(std::string_view role, ImageChannel channel);
  /// Flies for one period of the camera and returns the true optic flow from its previous image, CV_32FC2, px. Throws
  /// InputError if the flight ends before.
  cv::Mat flow_to_next_image(std::string_view role);

  /// Returns the image of a camera from a chosen pose, at rest, in any channel, with its imperfections. Does not change
  /// the flight. Throws InputError for a role that the rig lacks, std::invalid_argument for ImageChannel::flow, and for
  /// a pose that is not finite or a negative time.
  cv::Mat image_from(std::string_view role, ImageChannel channel, const ChosenPose& pose);
  /// Returns the true clearances of the hull at a chosen pose, and whether it collides. Throws as image_from().
  Proximity proximity_from(const ChosenPose& pose);
  /// Returns the true optic flow of a camera from one chosen pose to another, CV_32FC2, px. Throws as image_from().
  cv::Mat flow_between(std::string_view role, const ChosenPose& from, const ChosenPose& to);

  /// Returns the results of the scenario's checks as if the flight ended now.
  std::vector<CheckResult> checks_so_far() const;
  /// Returns the flight with its verdict. Throws std::logic_error before its end.
  Flight result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the maker of a module that hovers and receives these cameras, for callers that give all commands.
/// Throws InputError for a role that the rig lacks.
ModuleMaker hovering(const RigConfig& rig, const std::vector<std::string>& roles);

}  // namespace hedgehop::sim
