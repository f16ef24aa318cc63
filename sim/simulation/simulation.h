#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "avoidance/module.h"
#include "sim/collision/proximity.h"
#include "sim/flight/flight.h"
#include "sim/flight/flight_watcher.h"
#include "sim/render/renderer.h"
#include "sim/scenario/flight_parts.h"

/// Where a scenario becomes a flight: the loop simulates it, the verdict judges it.
namespace hedgehop::sim {

/// Makes the module of a flight: a new one for each.
using ModuleMaker = std::function<std::unique_ptr<avoidance::Module>()>;

/// How the vehicle truly moves: for who judges, never for who decides. Frames W and B of CONTRIBUTING.md.
struct TrueMotion {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();
  Eigen::Vector3d v_WB_W = Eigen::Vector3d::Zero();  ///< m/s
  Eigen::Vector3d w_WB_B = Eigen::Vector3d::Zero();  ///< rad/s
  Eigen::Vector3d wind_W = Eigen::Vector3d::Zero();  ///< of the air, m/s
};

/// A scenario in flight: flown to its end in one call, or stepped by who holds the clock. Equal scenarios and commands
/// give equal flights, bit for bit, however they are stepped. Several may live in one process; each is used by the
/// thread that made it.
class Simulation {
 public:
  /// Begins: cameras have exposed and sensors have read at time 0, nobody has decided.
  /// @param watcher  may be null. Throws InputError for what only the assembled parts show (a scene that cannot be, a
  /// module without its camera, a vehicle that cannot hover), std::runtime_error when there is no context to draw in.
  explicit Simulation(LoadedScenario loaded, FlightWatcher* watcher = nullptr);
  /// As above, for a scenario that no file was read for: checks its bounds. @param module  in place of the scenario's.
  explicit Simulation(Scenario scenario, ModuleMaker module = {}, FlightWatcher* watcher = nullptr);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  /// Begins again: the same flight. The scene and what draws it stay.
  void reset();
  /// Begins another flight, with the world of its seed.
  void reset(uint64_t seed);

  /// Lets the module decide now, if a decision is due, and flies on to the next one or to the end.
  /// @return whether the flight goes on. Throws std::logic_error when it is over.
  bool step();
  /// Gives the command in place of the module's: it takes effect after the scenario's latency, as the module's would. A
  /// speed above the vehicle's limit is scaled down to it. Throws std::invalid_argument when it is not finite.
  bool step(const avoidance::Command& command);
  /// As step(), but one physics step. A command may be given on any, whether a decision is due or not.
  bool tick();
  bool tick(const avoidance::Command& command);
  /// Lets the module fly on up to an instant, s from the start; where that is past, nothing happens. Throws InputError
  /// when the flight ends before.
  void fly_to(double t_s);
  /// Lets the module fly to the end. @return result().
  Flight run();

  /// Whether the flight has ended: then what is seen and true is that of its last moment.
  bool over() const;
  /// Whether a decision is due now.
  bool decides() const;
  double t_s() const;  ///< from the start
  const Scenario& scenario() const;

  /// What the module gets now: frames of its cameras where a decision is due, its own navigation, where to fly. The
  /// images are good until the simulation moves on.
  avoidance::Observation seen() const;
  TrueMotion truth() const;
  /// True clearances, and whether the vehicle touches.
  const Proximity& proximity() const;
  /// A camera of the rig, as those on board know it. Throws InputError, naming the rig's cameras, for another role.
  const avoidance::MountedCamera& camera(std::string_view role) const;

  /// What a camera of the rig would deliver now, in any channel, with its imperfections. Does not disturb the flight.
  /// Throws InputError for a role that the rig lacks, std::invalid_argument for ImageChannel::flow.
  cv::Mat image(std::string_view role, ImageChannel channel);
  /// Flies on by one period of the camera and returns the true flow of its image of before, CV_32FC2, px. Throws
  /// InputError when the flight ends on the way.
  cv::Mat flow_to_next_image(std::string_view role);

  /// What the scenario's checks would say, did the flight end now.
  std::vector<CheckResult> checks_so_far() const;
  /// The judged flight. Throws std::logic_error while it goes on.
  Flight result() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Makes a module that hovers, and sees these cameras in the channels of the rig: for who gives all commands.
/// Throws InputError for a role that the rig lacks.
ModuleMaker hovering(const RigConfig& rig, const std::vector<std::string>& roles);

/// The packages that flights depend on, but for what draws, and what compiled them: "OpenCV 4.6.0, SLEEF 3.5.1, Eigen
/// 3.4.0, Bullet 3.24, GNU 12.2.0".
std::string package_versions();

}  // namespace hedgehop::sim
