#pragma once

#include <numbers>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// Returns an equidistant fisheye whose field of view fills the width of the image.
inline vision::camera::Camera fisheye(int width_px, int height_px, double fov_deg) {
  const double focal_px = vision::camera::fisheye_focal_px({}, width_px, fov_deg * std::numbers::pi / 180.0);
  return {width_px, height_px,
          vision::camera::FisheyeLens{focal_px, focal_px, 0.5 * (width_px - 1), 0.5 * (height_px - 1)}};
}

}  // namespace hedgehop::sim
