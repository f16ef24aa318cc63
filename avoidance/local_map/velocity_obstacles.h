#pragma once

#include <span>

#include "avoidance/local_map/movers.h"
#include "avoidance/local_map/stop_planner.h"

namespace hedgehop::avoidance::local_map {

/// By how much a path comes nearer to movers than it should, m: the mean of the worst and of the mean over 4 s, so
/// that of two that begin as near the one that leaves is better; 0 where it never does. A mover forbids what
/// leads into the disc where it will be, its velocity being known: velocity obstacles, [FioriniShiller1998] sec. 3.
/// Differs: paths bend and end in a stop instead of straight lines; discs grow with the error of their velocity, and
/// stay where they are, too, while that is hardly known;
/// motion is compared up to the path's end, and 4 s after its begin at least, the vehicle standing where it ends.
/// @param clearance  as of what stands still. @param t_s  when the movers are where they say.
double threat_m(std::span<const Moment> path, std::span<const Mover> movers, const Clearance& clearance, double t_s);

/// The mover that comes nearest in the next 4 s, should both keep their velocities; none where that is not near.
/// @param now  of the vehicle, when the movers are where they say. @param hull_m  the vehicle's radius.
const Mover* nearest_to_come(const Moment& now, std::span<const Mover> movers, double hull_m);

}  // namespace hedgehop::avoidance::local_map
