#pragma once

#include <Eigen/Core>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "avoidance/section_grid/seen_space.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "vision/sections/section_search.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::avoidance::section_grid {

/// Maximum share of threats in a section that may be chosen. [Perez2018] sec. V-C.
inline constexpr double kMaxThreatShare = 0.15;
/// Distance at which a temporary position counts as reached, m: about the error of the position estimate plus the
/// overshoot.
inline constexpr double kArrivedM = 1.0;
/// Turn rate while no section is free, rad/s: 30 deg/s, slow enough for several images of every direction.
inline constexpr double kYawRateRadps = 0.5235987755982988;

/// The camera whose image is divided into sections.
struct SectionCamera {
  vision::stereo::StereoGeometry geometry;
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  cv::Size image;
};

/// Input of one decision.
struct SectionView {
  const vision::sections::SectionSearch& search;  ///< sections and threats of the newest image
  const vision::sections::SectionChoice& choice;  ///< the chosen section
  const stereo::PassedObstacles& passed;          ///< obstacles that have left the image; not used by the published law
  const SeenSpace& seen;                          ///< space that images have shown free; likewise
  double reach_m = 0.0;                           ///< distance of a temporary position, > 0
  const NavigationState& navigation;
};

/// State of the vehicle.
enum class State { cruise, avoid, resume, hover_and_yaw };
/// Returns the name of a state for decisions and images.
const char* name_of(State state);

/// Returns the direction of the center of a section in C, of length 1.
Eigen::Vector3d section_ray_C(const SectionCamera& camera, const vision::sections::SectionSearch& search, int section);

/// Turns on the spot until the vehicle faces a position, then moves to it. [Perez2018] sec. V-D.
class TurnThenMove {
 public:
  bool is_turning() const { return wait_W_.has_value(); }
  void stop() { wait_W_.reset(); }
  /// Returns the command towards a position, m. The vehicle climbs uniformly along the path.
  Command go_to(const Eigen::Vector3d& p_W, const NavigationState& navigation);

 private:
  std::optional<Eigen::Vector3d> wait_W_;  ///< position that is held during the turn
};

/// The published law: the center section continues the current path, any other section sets a temporary position in its
/// direction, and without a free section the vehicle hovers and yaws. Source: [Perez2018] sec. V-D.
class SectionLaw {
 public:
  /// @param lowest_m  minimum altitude of temporary positions.
  explicit SectionLaw(double lowest_m) : lowest_m_(lowest_m) {}

  /// Starts a flight.
  void reset(const SectionCamera& camera);
  /// Returns the command after an image.
  Command update(const SectionView& view, const Goal& goal);
  State state() const { return state_; }

 private:
  double lowest_m_;
  SectionCamera camera_;
  State state_ = State::cruise;
  TurnThenMove mover_;
  std::optional<Eigen::Vector3d> aside_W_;  ///< temporary position
};

}  // namespace hedgehop::avoidance::section_grid
