#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "avoidance/flow_balance/zig_zag_law.h"
#include "sim/libm/random.h"

namespace hedgehop::avoidance::flow_balance {

/// The zig-zag of zig_zag_law.h with the additions of the modified law:
/// - A component is reversed only if two successive images agree.
/// - If several obstacles are too near, only the nearest one reverses a component, and the others are evaluated again
/// on the new path. Otherwise a wall that two cameras see, as at a heading across the room, would send the vehicle back
/// instead of along the wall.
/// - Each reversal may rotate the path by a random angle. At a heading across the room, fixed diagonals soon repeat one
/// closed path.
/// - Each reversal chooses among several such paths: the one with the maximum of unvisited floor among those that keep
/// the clearance. If none keeps it, as between two walls of a corner, both components are reversed at once.
/// - If no unvisited floor is left ahead, the path turns before the next wall.
class ConfirmedZigZag {
 public:
  /// Properties of a path that a reversal can choose.
  struct Path {
    double clearance_m = 0.0;  ///< minimum distance from all walls during the turn and on the path, up to a maximum
    double unvisited = 0.0;    ///< unvisited floor along it
  };
  /// Returns the properties of a path. @param v_H  its velocity in H, m/s.
  using Foresee = std::function<Path(const Eigen::Vector2d& v_H)>;

  /// @param stray_rad  maximum angle between the path and its diagonal, >= 0; drawn at every reversal.
  /// @param seed       seed of these random angles.
  ConfirmedZigZag(const Diagonal& diagonal, double stray_rad, uint64_t seed)
      : diagonal_(diagonal), max_stray_rad_(stray_rad), random_(seed) {
    draw_angles();
  }

  /// Velocity to fly in H, m/s; both components positive at first.
  Eigen::Vector2d velocity_H() const { return velocity_H(course_); }
  /// Returns whether the next reversal is of both components: obstacles ahead are too near on sides of both, or the
  /// best path after a reversal in front of the nearest obstacle is back.
  bool reverses_both(std::span<const SideRange> sides, const Foresee& foresee) const;
  /// Adds the measurements of the cameras, always of the same cameras in the same order.
  /// @param foresee  empty: all paths are equal. @return whether a component was reversed.
  bool update(std::span<const SideRange> sides, const Foresee& foresee = {});
  int reversals() const { return reversals_; }

 private:
  /// A diagonal and its rotation.
  struct Course {
    Eigen::Vector2d signs_H = {1.0, 1.0};
    double stray_rad = 0.0;
  };
  struct Choice {
    Course course;
    Path path;
  };
  Eigen::Vector2d velocity_H(const Course& course) const;
  void add_choices(const Eigen::Vector2d& signs_H, const Foresee& foresee, std::vector<Choice>& choices) const;
  Course best_course(int reversed, const Foresee& foresee) const;
  bool seek_unvisited(const Foresee& foresee);
  void draw_angles();

  Diagonal diagonal_;
  double max_stray_rad_;
  Random random_;
  Course course_;
  std::vector<double> angles_rad_;  ///< of the paths that the next reversal compares
  std::vector<int> confirmed_;      ///< per side, successive images with an obstacle that is too near
  int reversals_ = 0;
  int updates_ahead_ = 0;  ///< since the last turn, or since the floor ahead was examined
};

}  // namespace hedgehop::avoidance::flow_balance
