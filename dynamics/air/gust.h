#pragma once

#include "sim/fields/field.h"

namespace hedgehop::dynamics::air {

/// One horizontal gust of 1-cosine shape that an aircraft flies through: it rises over a length, holds, and falls as it
/// rose.
struct GustConfig {
  double speed_mps = 0.0;  ///< at its strongest; 0 for no gust
  double from_rad = 0.0;   ///< heading it comes from, from north to east
  double start_s = 0.0;    ///< when the aircraft meets it
  double length_m = 20.0;  ///< distance through the air from zero to full strength
  double hold_m = 0.0;     ///< distance at full strength
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<GustConfig> auto& c) {
  v("speed", c.speed_mps, {.unit = "m/s", .at_least = 0.0, .at_most = 30.0, .meaning = "at its strongest; 0 for none"});
  v("from", c.from_rad,
    {.unit = "deg",
     .at_least = -360.0,
     .at_most = 360.0,
     .meaning = "heading the gust comes from, from north to east"});
  v("start", c.start_s, {.unit = "s", .at_least = 0.0, .meaning = "flight time at which it is met"});
  v("length", c.length_m,
    {.unit = "m", .above = 0.0, .meaning = "distance through the air over which it rises, and falls"});
  v("hold", c.hold_m, {.unit = "m", .at_least = 0.0, .meaning = "distance through the air at full strength"});
}

/// Returns the gust's speed at a distance behind its front, m/s. @param path_m  distance through the air; the speed is
/// 0 before the front and beyond the gust. Source: [MIL8785C] sec. 3.7.1.3. Differs: the fall mirrors the rise, where
/// the standard's gust stays.
double gust_speed_mps(const GustConfig& config, double path_m);

}  // namespace hedgehop::dynamics::air
