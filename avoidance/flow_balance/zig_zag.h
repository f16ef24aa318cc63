#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace hedgehop::avoidance::flow_balance {

/// How a vehicle stops: it goes on as it was for `reaction_s` (>= 0), then slows down by `braking_mps2` (> 0).
struct Stopping {
  double reaction_s = 0.0;
  double braking_mps2 = 1.0;
};
/// Returns how much nearer a vehicle comes, m, to what it closes in on at `closing_mps`, until it no longer does; 0
/// when it recedes: v_n (t + v / (2 a)). @param turning_mps  the part v of its velocity that turns round, all of it in
/// a corner: the component towards a wall then falls as slowly as the whole.
double stopping_distance_m(double closing_mps, double turning_mps, const Stopping& stopping);
/// Returns the inverse of the range that is left, 1/m, of inverse range `near_per_m` (>= 0) less a distance (>= 0);
/// 1000 where nothing is left.
double near_once_stopped_per_m(double near_per_m, double stopping_distance_m);

/// The simple scheme of [Garratt2009] sec. 4: the vehicle flies on a diagonal of frame H (x along the heading, y to the
/// right), and the component of its velocity that leads towards a near wall turns round.
/// Differs: of several walls that are too near only the nearest turns a component round, and the others are judged anew
/// on the new way. A wall that two cameras see, as at a heading across the room, would send the vehicle back the way it
/// came instead of along the wall. And each turn may bend the way by a random angle: at a heading across the room,
/// fixed diagonals soon repeat one closed path.
class ZigZag {
 public:
  /// What one camera tells of the walls on its side.
  struct Side {
    Eigen::Vector2d axis_H = Eigen::Vector2d::UnitX();  ///< where the camera looks
    double near_per_m = 0.0;                            ///< inverse range of the nearest wall there
    bool fresh = false;                                 ///< is there a new image since the last update?
  };

  struct Config {
    Eigen::Vector2d speed_mps = {1.0, 1.0};  ///< along x and y of H, both > 0
    double range_threshold_m = 2.0;          ///< a wall within it is too near, > 0
    int confirmations = 2;   ///< images in a row that must say so before a component turns round, at least 1
    double stray_rad = 0.0;  ///< the way's largest angle off the diagonal, drawn at every turn
    uint64_t seed = 0;       ///< of those draws
  };
  explicit ZigZag(const Config& config) : config_(config), random_(config.seed) {}

  /// Velocity to fly in H, m/s; both components positive at first.
  Eigen::Vector2d way_H() const;
  int reversals() const { return reversals_; }

  /// Whether walls that the way leads towards are too near on sides of both components.
  bool cornered(std::span<const Side> sides) const;
  /// Takes in what the cameras tell, the same ones in the same order every time. @return whether a component turned.
  bool update(std::span<const Side> sides);

 private:
  bool too_near(const Side& side) const { return side.near_per_m * config_.range_threshold_m > 1.0; }
  bool leads_towards(const Side& side) const;

  Config config_;
  std::mt19937_64 random_;
  Eigen::Vector2d signs_H_ = {1.0, 1.0};
  double stray_rad_ = 0.0;
  std::vector<int> confirmed_;
  int reversals_ = 0;
};

}  // namespace hedgehop::avoidance::flow_balance
