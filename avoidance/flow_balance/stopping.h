#pragma once

namespace hedgehop::avoidance::flow_balance {

/// How a vehicle stops: it flies on for `reaction_s` (>= 0), then decelerates by `braking_mps2` (> 0).
struct Stopping {
  double reaction_s = 0.0;
  double braking_mps2 = 1.0;
};

/// Returns the distance that a vehicle still covers, m, towards an obstacle that it approaches at `closing_mps`, until
/// it approaches it no longer: v_n (t + v / (2 a)); 0 when it recedes.
/// @param reversing_mps  the part v of its velocity that is reversed. In a corner that is all of it, and the component
/// towards a wall falls as slowly as the whole.
double stopping_distance_m(double closing_mps, double reversing_mps, const Stopping& stopping);

/// Returns the inverse of the range less a distance, 1/m; 1000 where nothing is left.
/// @param inverse_range_per_m  of the obstacle, >= 0.  @param distance_m  >= 0.
double inverse_range_left_per_m(double inverse_range_per_m, double distance_m);

}  // namespace hedgehop::avoidance::flow_balance
