#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/section_grid/section_grid.h"
#include "avoidance/section_grid/section_law.h"

namespace hedgehop::avoidance::section_grid {

/// Returns the direction in B, of length 1, of the position of an answer.
/// @param ray_B  direction of the chosen section, of length 1. @param side  -1 to give way to the left, 1 to the right.
/// @param recedes  whether a sidestep also goes back, for example to evade a following obstacle.
/// Not in the paper; after the trade study that [Perez2018] sec. VII proposes.
Eigen::Vector3d direction_B(Answer answer, const Eigen::Vector3d& ray_B, double side, bool recedes);

/// Returns whether the vehicle faces the positions of an answer.
bool faces_path(Answer answer);

/// The modified law, that is SectionLaw with these additions:
/// - A path is given up only if its section fills up. Otherwise every change of a pixel would move the position.
/// - The route is resumed as soon as the section that contains the goal and the section straight ahead are free.
/// - No path is chosen or kept that meets obstacles that have left the image, if another path avoids them.
/// - On the way to the goal it descends only into space that its images have shown free.
/// - There are other answers than a position in the direction of the section.
/// - In front of a wide obstacle the vehicle searches to one side, then to the other, each time twice as far.
/// - A vehicle that hovers at its goal stays at the position to which it gave way, as in [Perez2018] fig. 20.
class SectionPilot {
 public:
  explicit SectionPilot(const SectionGridConfig& config);

  /// Starts a flight. @param radius_m  of the vehicle, >= 0.
  void reset(const SectionCamera& camera, double radius_m);

  /// Returns the command after an image.
  Command update(const SectionView& view, const Goal& goal);

  /// Returns the temporary position for a section, in W, m. @param reach_m  its distance, > 0.
  Eigen::Vector3d position_W(const NavigationState& navigation, const vision::sections::SectionSearch& search,
                             int section, double reach_m) const;

  State state() const { return state_; }

 private:
  /// Search for a path past a wide obstacle.
  struct Sweep {
    Eigen::Vector2d from_W,
        right_W;                   ///< start of the search, and the direction to the right of the direction to the goal
    double goal_distance_m = 0.0;  ///< at the start of the search
    double reach_m = 0.0;          ///< length of the search to the current side
  };
  bool is_approached(const SectionView& view);
  std::optional<cv::Point2d> pixel_of(const Eigen::Vector3d& p_W, const NavigationState& navigation) const;
  bool is_free(const Eigen::Vector3d& p_W, const SectionView& view) const;
  bool is_blocked(const Eigen::Vector3d& end_W, const SectionView& view) const;
  Eigen::Vector3d descent_W(const Eigen::Vector3d& end_W, const SectionView& view);
  bool is_seen_free(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, const SectionView& view) const;
  Command hover_and_yaw(const SectionView& view, const Goal& goal);
  void choose_side(double side, const NavigationState& navigation, const Goal& goal);

  Answer answer_;
  double keep_share_, lowest_m_;
  SectionCamera camera_;
  double radius_m_ = 0.0;
  State state_ = State::cruise;
  TurnThenMove mover_;
  double turn_ = 1.0;                       ///< to the right
  std::optional<Eigen::Vector3d> aside_W_;  ///< temporary position
  std::optional<Eigen::Vector3d> post_W_;   ///< hover position, if the flight begins at its goal
  double away_ = 1.0;                       ///< evasion to the right of an obstacle that approaches the hover position
  std::optional<double> watched_rad_;       ///< heading to the last approaching obstacle
  std::optional<Sweep> sweep_;
  std::optional<double> level_z_W_;  ///< altitude that is held while no descent is free
  bool flown_ = false;
};

}  // namespace hedgehop::avoidance::section_grid
