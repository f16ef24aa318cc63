#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/section_grid/section_grid.h"
#include "avoidance/section_grid/section_law.h"

namespace hedgehop::avoidance::section_grid {

/// Direction in B, of length 1, of the position that an answer goes to.
/// @param ray_B  direction of the chosen section, of length 1. @param side  -1 to give way to the left, 1 to the right.
/// @param recedes  whether a sidestep also goes back, as before something that follows.
/// Ours, after the trade study that [Perez2018] sec. VII proposes.
Eigen::Vector3d direction_B(Answer answer, const Eigen::Vector3d& ray_B, double side, bool recedes);

/// Whether the vehicle faces the positions that an answer goes to.
bool faces_path(Answer answer);

/// The law of SectionLaw with our additions:
/// - a path is given up only where its section fills up, else every pixel's change would shift the position;
/// - the route is resumed as soon as the section that holds the goal is free;
/// - no path is chosen or kept that meets what has left the image, while another one does not;
/// - other answers than a position in the section's direction;
/// - before something wide it searches to one side, then to the other, each time twice as far;
/// - a vehicle that hovers at its goal stays where it gave way to, as in [Perez2018] fig. 20.
class SectionPilot {
 public:
  explicit SectionPilot(const SectionGridConfig& config);

  /// Starts a flight.
  void reset(const SectionCamera& camera);

  /// Returns what to fly after an image.
  Command update(const SectionView& view, const Goal& goal);

  /// The temporary position for a section, in W, m. @param reach_m  its distance, > 0.
  Eigen::Vector3d position_W(const NavigationState& navigation, const vision::sections::SectionSearch& search,
                             int section, double reach_m) const;

  State state() const { return state_; }

 private:
  /// A search for a path past something wide.
  struct Sweep {
    Eigen::Vector2d from_W, right_W;  ///< where it began, and the direction to the right of the goal's
    double goal_distance_m = 0.0;     ///< when it began
    double reach_m = 0.0;             ///< how far it goes to the side it is on
  };
  bool is_approached(const SectionView& view);
  std::optional<cv::Point2d> pixel_of(const Eigen::Vector3d& p_W, const NavigationState& navigation) const;
  bool is_free(const Eigen::Vector3d& p_W, const SectionView& view) const;
  bool is_blocked(const Eigen::Vector3d& end_W, const SectionView& view) const;
  Command hover_and_yaw(const SectionView& view, const Goal& goal);
  void choose_side(double side, const NavigationState& navigation, const Goal& goal);

  Answer answer_;
  double keep_share_, lowest_m_;
  SectionCamera camera_;
  State state_ = State::cruise;
  TurnThenMove mover_;
  double turn_ = 1.0;                       ///< to the right
  std::optional<Eigen::Vector3d> aside_W_;  ///< temporary position
  std::optional<Eigen::Vector3d> post_W_;   ///< where it hovers, when the flight begins at its goal
  double away_ = 1.0;                       ///< to the right of what approaches the post
  std::optional<double> watched_rad_;       ///< heading to what approached last
  std::optional<Sweep> sweep_;
  bool flown_ = false;
};

}  // namespace hedgehop::avoidance::section_grid
