#pragma once

#include <Eigen/Geometry>

#include "sim/render/tiles/frame.h"

namespace hedgehop::sim::tiles {

/// True when no point of a box can be seen past what was drawn so far. Conservative.
/// @param box  in the frame of the eye's facets, m. @param near_m  z in C of the near plane.
bool hides(const Frame& frame, const Eye& eye, const Eigen::AlignedBox3f& box, double near_m);

}  // namespace hedgehop::sim::tiles
