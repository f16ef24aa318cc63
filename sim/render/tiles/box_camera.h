#pragma once

#include "sim/render/tiles/kernels.h"

namespace hedgehop::sim::tiles {

/// @param pose  of the camera in W. @param near_m  z in C of the near plane.
BoxCamera box_camera(const PinholeImage& lens, const ViewPose& pose, double near_m);

}  // namespace hedgehop::sim::tiles
