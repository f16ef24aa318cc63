#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/moving_obstacles.h"

namespace hedgehop::avoidance::local_map {

/// Response of a vehicle to a commanded velocity: a delay and a first-order lag with limited acceleration.
struct Response {
  double delay_s = 0.2;          ///< from an image to the first effect of its command, >= 0
  double lag_s = 0.5;            ///< > 0
  double acceleration_mps2 = 2;  ///< > 0
  double braking_mps2 = 1.5;     ///< > 0
};

/// Required clearance.
struct Clearance {
  double hull_m = 0.5;     ///< radius of the vehicle, >= 0
  double margin_m = 0.25;  ///< additional distance from obstacles, >= 0
  double margin_s = 0.1;   ///< additional distance per speed, >= 0
};

/// Time, position and velocity on a planned path.
struct PathState {
  double t_s;
  Eigen::Vector2d p_W, v_W;
};

/// Missing distance of a state of a path from occupied and from unknown space, m; 0 if none is missing.
struct ClearanceDeficit {
  double occupied_m = 0.0, unknown_m = 0.0;
  double beside_unknown_m = 0.0;  ///< missing distance from unknown space that is preferred but not required
};

/// Chooses the velocity to command. After every admissible velocity the vehicle can brake to a full stop within space
/// that was observed as free. Of these, the planner takes the one whose stop is nearest to the goal.
/// - Velocities are sampled, and those that do not allow a timely stop are rejected: [Fox1997] sec. on the dynamic
/// window.
/// - A full stop within known free space is planned at every step, the rule from which [Tordesillas2019] sec. I and
/// [Lopez2017] sec. I start.
/// Differs: the former admits arcs free of obstacles and treats unknown space as free; the latter flies faster, into
/// unknown space, if a safe trajectory branches off. This planner never plans beyond observed space.
class StopPlanner {
 public:
  struct Plan {
    Eigen::Vector2d v_cmd_W = Eigen::Vector2d::Zero();  ///< m/s
    bool safe = false;                                  ///< whether a stop within the required clearance exists
    double progress_m = 0.0;      ///< reduction of the distance to the goal from the current position to the stop
    std::vector<PathState> path;  ///< up to the stop
  };
  /// Returns the missing clearance of a state of a path.
  using DeficitAt = std::function<ClearanceDeficit(const PathState&)>;
  /// Returns the violation of the distance from moving obstacles by a path, m.
  using Threat = std::function<double(const std::vector<PathState>&)>;
  /// Returns the distance to the goal along the route, m; empty if there is no route.
  using ToGoal = std::function<std::optional<double>(const Eigen::Vector2d&)>;

  /// Returns whether images show a direction. @param azimuth_rad  from north to east.
  using LooksAlong = std::function<bool(double)>;

  StopPlanner(
      const Response& response, double speed_mps, LooksAlong looks_along = [](double) { return true; })
      : response_(response), speed_mps_(speed_mps), looks_along_(std::move(looks_along)) {}

  /// Returns the best plan. It maximizes separation from moving obstacles, because no stop is safe from them.
  /// @param now  position and velocity at the time of the image. @param last_cmd_W  command that is still in effect.
  Plan choose(const PathState& now, const Eigen::Vector2d& last_cmd_W, const DeficitAt& deficit, const Threat& threat_m,
              const ToGoal& to_goal_m) const;

  /// Returns the path of a command that is held for `hold_s` before the vehicle brakes.
  std::vector<PathState> predict(const PathState& now, const Eigen::Vector2d& last_cmd_W,
                                 const Eigen::Vector2d& v_cmd_W, double hold_s) const;

 private:
  Response response_;
  double speed_mps_;
  LooksAlong looks_along_;
};

/// Returns the violation of the distance from moving obstacles, m; 0 if there is none. It is the mean of the maximum
/// and of the average over 4 s, so of two paths that begin equally near, the one that leaves is better. An obstacle
/// blocks the velocities that lead into its predicted disc: velocity obstacles, [FioriniShiller1998] sec. 3.
/// Differs: paths are curved and end in a stop instead of straight lines. Discs grow with the error of their velocity.
/// If the velocity is hardly known, the current position of the obstacle also remains blocked. Motion is compared up to
/// the end of the path and for at least 4 s; the vehicle hovers at the end of the path.
/// @param clearance  as for static obstacles. @param t_s  time of the states of the moving obstacles.
double threat_m(std::span<const PathState> path, std::span<const MovingObstacle> moving_obstacles,
                const Clearance& clearance, double t_s);

/// Returns the obstacle with the minimum distance in the next 4 s at constant velocities; null if no obstacle comes
/// near.
/// @param now  state of the vehicle at the time of the obstacles. @param hull_m  radius of the vehicle.
const MovingObstacle* nearest_approaching(const PathState& now, std::span<const MovingObstacle> moving_obstacles,
                                          double hull_m);

}  // namespace hedgehop::avoidance::local_map
