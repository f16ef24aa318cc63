#pragma once

#include <Eigen/Core>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "avoidance/module.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "vision/sections/section_search.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::avoidance::section_grid {

/// Share of threats above which a section is no way out. [Perez2018] sec. V-C.
inline constexpr double kMaxThreatShare = 0.15;
/// Distance at which a temporary position counts as reached, m: about the position estimate's error and the overshoot.
inline constexpr double kArrivedM = 1.0;
/// Turn rate while no section is free, rad/s: 30 deg/s, slow enough for several images of every view.
inline constexpr double kYawRateRadps = 0.5235987755982988;

/// The camera whose image is divided into sections.
struct SectionCamera {
  vision::stereo::StereoGeometry geometry;
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  cv::Size image;
};

/// What one decision is based on.
struct SectionView {
  const vision::sections::SectionSearch& search;  ///< sections and threats of the newest image
  const vision::sections::SectionChoice& choice;  ///< among them
  const stereo::PassedObstacles& passed;          ///< what has left the image; the published law knows nothing of it
  double reach_m = 0.0;                           ///< how far ahead a temporary position lies, > 0
  const NavigationState& navigation;
};

/// What the vehicle is doing.
enum class State { cruise, avoid, resume, hover_and_yaw };
/// Its name in decisions and images.
const char* name_of(State state);

/// Direction of a section's center in C, of length 1.
Eigen::Vector3d section_ray_C(const SectionCamera& camera, const vision::sections::SectionSearch& search, int section);

/// Turns to face a position, waiting where it is, and then moves there. [Perez2018] sec. V-D.
class TurnThenMove {
 public:
  bool is_turning() const { return wait_W_.has_value(); }
  void stop() { wait_W_.reset(); }
  /// The command towards a position, m. It climbs evenly on the path.
  Command go_to(const Eigen::Vector3d& p_W, const NavigationState& navigation);

 private:
  std::optional<Eigen::Vector3d> wait_W_;  ///< where it waits while it turns
};

/// The law as printed: the center section carries on along the current path, any other sets a temporary position in its
/// direction, none hovers and yaws. Source: [Perez2018] sec. V-D.
class SectionLaw {
 public:
  /// @param lowest_m  altitude below which no temporary position lies.
  explicit SectionLaw(double lowest_m) : lowest_m_(lowest_m) {}

  /// Starts a flight.
  void reset(const SectionCamera& camera);
  /// Returns what to fly after an image.
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
