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

/// How a vehicle follows a commanded velocity: after a delay, as a first-order lag whose acceleration is limited.
struct Response {
  double delay_s = 0.2;          ///< from an image to the first effect of its command, >= 0
  double lag_s = 0.5;            ///< > 0
  double acceleration_mps2 = 2;  ///< > 0
  double braking_mps2 = 1.5;     ///< > 0
};

/// What must be kept free.
struct Clearance {
  double hull_m = 0.5;     ///< radius of the vehicle, >= 0
  double margin_m = 0.25;  ///< beside it from obstacles, >= 0
  double margin_s = 0.1;   ///< and per speed, >= 0
};

/// Position and time of a planned stop.
struct PathState {
  double t_s;
  Eigen::Vector2d p_W, v_W;
};

/// By how much a moment of a path lacks distance from what is occupied and from what is unknown, m; 0 where it does
/// not.
struct ClearanceDeficit {
  double occupied_m = 0.0, unknown_m = 0.0;
  double beside_unknown_m = 0.0;  ///< of what it had better keep from the unknown, and need not
};

/// Chooses the velocity to command: the one whose stop lies nearest to the goal, among those after which the vehicle,
/// should it brake then, stays to its full stop in space seen to be free.
/// - Velocities are searched, and those that could not stop in time not admitted: [Fox1997] sec. on the dynamic window.
/// - A full stop within known free space is planned at every moment, the rule that [Tordesillas2019] sec. I and
///   [Lopez2017] sec. I start from.
/// Differs: the former admits arcs free of obstacles, unknown counted as free; the latter flies faster, into the
/// unknown as long as a safe trajectory branches off. Ours never plans beyond what it has seen.
class StopPlanner {
 public:
  struct Plan {
    Eigen::Vector2d v_cmd_W = Eigen::Vector2d::Zero();  ///< m/s
    bool safe = false;                                  ///< a stop within what is allowed exists
    double progress_m = 0.0;                            ///< how much nearer to the goal it stops than the vehicle is
    std::vector<PathState> path;                        ///< up to the stop
  };
  /// What is wrong at a moment of a path.
  using DeficitAt = std::function<ClearanceDeficit(const PathState&)>;
  /// By how much a path comes too near to what moves, at worst, m.
  using Threat = std::function<double(const std::vector<PathState>&)>;
  /// Distance to the goal along the route, m; nothing where there is none.
  using ToGoal = std::function<std::optional<double>(const Eigen::Vector2d&)>;

  /// Whether images show what lies in a direction. @param azimuth_rad  from north to east.
  using LooksAlong = std::function<bool(double)>;

  StopPlanner(
      const Response& response, double speed_mps, LooksAlong looks_along = [](double) { return true; })
      : response_(response), speed_mps_(speed_mps), looks_along_(std::move(looks_along)) {}

  /// @param now  position and velocity when the image was taken. @param last_cmd_W  what is being obeyed still.
  /// What moves is got away from as far as it can be: no stop is safe from it.
  Plan choose(const PathState& now, const Eigen::Vector2d& last_cmd_W, const DeficitAt& deficit, const Threat& threat_m,
              const ToGoal& to_goal_m) const;

  /// The path that a command leads to when it is held for `hold_s` and the vehicle then brakes.
  std::vector<PathState> predict(const PathState& now, const Eigen::Vector2d& last_cmd_W,
                                 const Eigen::Vector2d& v_cmd_W, double hold_s) const;

 private:
  Response response_;
  double speed_mps_;
  LooksAlong looks_along_;
};

/// By how much a path comes nearer to moving_obstacles than it should, m: the mean of the worst and of the mean over 4
/// s, so that of two that begin as near the one that leaves is better; 0 where it never does. A obstacle forbids what
/// leads into the disc where it will be, its velocity being known: velocity obstacles, [FioriniShiller1998] sec. 3.
/// Differs: paths bend and end in a stop instead of straight lines; discs grow with the error of their velocity, and
/// stay where they are, too, while that is hardly known;
/// motion is compared up to the path's end, and 4 s after its begin at least, the vehicle standing where it ends.
/// @param clearance  as of what stands still. @param t_s  when the moving_obstacles are where they say.
double threat_m(std::span<const PathState> path, std::span<const MovingObstacle> moving_obstacles,
                const Clearance& clearance, double t_s);

/// The obstacle that comes nearest in the next 4 s, should both keep their velocities; none where that is not near.
/// @param now  of the vehicle, when the moving_obstacles are where they say. @param hull_m  the vehicle's radius.
const MovingObstacle* nearest_approaching(const PathState& now, std::span<const MovingObstacle> moving_obstacles,
                                          double hull_m);

}  // namespace hedgehop::avoidance::local_map
