#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/section_grid/section_grid.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::avoidance::section_grid {

/// The camera whose image is cut into sections.
struct SectionCamera {
  vision::stereo::StereoGeometry geometry;
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  cv::Size image;
};

/// What the pilot goes by at one decision.
struct SectionView {
  const vision::sections::SectionSearch& seen;    ///< sections and threats of the newest image
  const vision::sections::SectionChoice& choice;  ///< among them
  const stereo::PassedObstacles& passed;          ///< what has left the image
  double reach_m = 0.0;                           ///< how far ahead a position aside lies, > 0
  const NavigationState& navigation;
};

/// Carries on to the goal while the section ahead is the emptiest, else goes to a position in the emptiest one's
/// direction: turns to it first, then moves. Hovers and yaws where no section is free. Differs: a way is given up only
/// where the section that holds it fills up, since else every pixel's change would put the position off again; and
/// the route is resumed as soon as the section that holds the goal is free, where the paper says only that the vehicle
/// continues on its path; and no way is chosen or kept that meets what has left the image, while another does not. A
/// vehicle that hovers at its goal stays where it gave way to, as in fig. 20.
class SectionPilot {
 public:
  enum class State { cruise, avoid, resume, hover_and_yaw };

  /// Throws std::invalid_argument on a config out of range.
  explicit SectionPilot(const SectionPilotConfig& config);

  /// Starts a flight.
  void reset(const SectionCamera& camera);

  /// Returns what to fly for what is seen now.
  Command update(const SectionView& view, const Goal& goal);

  /// Where to go for a section, in W, m: as a rule ahead in its direction. @param reach_m  how far, > 0.
  Eigen::Vector3d place(const NavigationState& navigation, const vision::sections::SectionSearch& seen, int section,
                        double reach_m) const;

  State state() const { return state_; }

 private:
  /// A search for a way past something wide.
  struct Sweep {
    Eigen::Vector2d from_W, right_W;  ///< where it began, and the direction to the right of the goal's
    double goal_distance_m = 0.0;     ///< when it began
    double reach_m = 0.0;             ///< how far it goes to the side it is on
  };
  bool turns() const;
  bool is_approached(const SectionView& view);
  std::optional<cv::Point2d> pixel_of(const Eigen::Vector3d& p_W, const NavigationState& navigation) const;
  bool is_free(const Eigen::Vector3d& p_W, const SectionView& view) const;
  bool is_spoilt(const Eigen::Vector3d& end_W, const SectionView& view) const;
  Command hover_and_yaw(const SectionView& view, const Goal& goal);
  void search(double side, const NavigationState& navigation, const Goal& goal);
  Command go_to(const Eigen::Vector3d& p_W, const NavigationState& navigation);

  SectionPilotConfig config_;
  SectionCamera camera_;
  State state_ = State::cruise;
  double turn_ = 1.0;                       ///< to the right
  std::optional<Eigen::Vector3d> aside_W_;  ///< temporary position
  std::optional<Eigen::Vector3d> held_W_;   ///< where it waits while it turns
  std::optional<Eigen::Vector3d> post_W_;   ///< where it hovers, of a flight that has no way to go
  double away_ = 1.0;                       ///< to the right of what comes at the post
  std::optional<double> watched_rad_;       ///< heading to what came at it last
  std::optional<Sweep> sweep_;
  bool flown_ = false;
};

}  // namespace hedgehop::avoidance::section_grid
