#pragma once

#include <Eigen/Core>
#include <optional>

#include "avoidance/stereo_corridor/corridor_search.h"

/// The path of the aircraft in [Andert2007] sec. 5, which "is set to a flight path" and keeps "the original heading if
/// possible".
namespace hedgehop::avoidance::stereo_corridor {

/// The straight line through the start and the goal. On a route, each leg begins at the last waypoint.
class FlightPath {
 public:
  /// Returns the point of the path that is CorridorSearch::kLookAheadM, horizontally, ahead of the point nearest to the
  /// vehicle, in W, m. Beyond the goal the path continues at the goal's altitude. The first call of a flight defines
  /// the start. @param p_WB  position of the vehicle, m. @param p_WG  the goal, m.
  Eigen::Vector3d ahead_W(const Eigen::Vector3d& p_WB, const Eigen::Vector3d& p_WG);

 private:
  struct Leg {
    Eigen::Vector3d from_W, to_W;
  };
  std::optional<Leg> leg_;
};

/// The law of CorridorSearch::join() with the direction of the path instead of the direction of flight. If the path is
/// not in view, step 4 finds the corridor nearest to it.
/// @param path_C  a point ahead on the path. @param followed  current pixel of the last target, if known.
/// Source: [Andert2007] sec. 4.3.4 and sec. 5. Differs: in the paper, the flight control computer flies the path.
std::optional<Target> keep_path(CorridorSearch& search, const Eigen::Vector3d& path_C,
                                const std::optional<cv::Point>& followed);

}  // namespace hedgehop::avoidance::stereo_corridor
