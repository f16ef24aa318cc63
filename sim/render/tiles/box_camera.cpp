#include "sim/render/tiles/box_camera.h"

#include <cmath>

namespace hedgehop::sim::tiles {

BoxCamera box_camera(const PinholeImage& lens, const ViewPose& pose, double near_m) {
  BoxCamera camera{};
  const auto set_side = [&](int side, int row, double focal_px, double edge_px) {
    constexpr double kEdgePx = 1.5;  // half a pixel to the edge of the image, and a margin of one pixel
    double length = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double n = focal_px * pose.R_CW[3 * row + i] + (edge_px + kEdgePx) * pose.R_CW[6 + i];
      camera.sides[side][i] = static_cast<float>(n);
      length += std::abs(n);
    }
    camera.side_errors[side] = kFloatError * static_cast<float>(length);
  };
  set_side(0, 0, lens.focal_x_px, lens.center_u_px);
  set_side(1, 0, -lens.focal_x_px, lens.width_px - 1 - lens.center_u_px);
  set_side(2, 1, lens.focal_y_px, lens.center_v_px);
  set_side(3, 1, -lens.focal_y_px, lens.height_px - 1 - lens.center_v_px);
  for (int i = 0; i < 3; ++i) {
    camera.eye_m[i] = static_cast<float>(pose.p_m[i]);
    camera.eye_rest_m[i] = static_cast<float>(pose.p_m[i] - static_cast<double>(camera.eye_m[i]));
    for (int k = 0; k < 3; ++k) camera.R_CW[i][k] = static_cast<float>(pose.R_CW[3 * i + k]);
  }
  camera.focal_px[0] = static_cast<float>(lens.focal_x_px);
  camera.focal_px[1] = static_cast<float>(lens.focal_y_px);
  camera.center_px[0] = static_cast<float>(lens.center_u_px);
  camera.center_px[1] = static_cast<float>(lens.center_v_px);
  camera.near_m = static_cast<float>(near_m);
  return camera;
}

}  // namespace hedgehop::sim::tiles
