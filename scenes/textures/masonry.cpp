#include "scenes/textures/masonry.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hedgehop::scenes::textures {
namespace {

// Share of a pixel that lies in a joint around the multiples of `period_m`.
float joint_share(double at_m, double pixel_m, double period_m, double joint_m) {
  const double from_joint_m = std::abs(at_m - period_m * std::round(at_m / period_m));
  const double overlap_m = 0.5 * (joint_m + pixel_m) - from_joint_m;
  return static_cast<float>(std::clamp(overlap_m / pixel_m, 0.0, std::min(1.0, joint_m / pixel_m)));
}

}  // namespace

void paint_masonry(Canvas& canvas, const Masonry& masonry, const Color& block, const Color& joint, Random& random) {
  std::vector<Color> tones;
  for (int k = 0; k < masonry.rows * masonry.columns; ++k) tones.push_back(varied(block, masonry.spread, random));

  const double pixel_m = canvas.tile_m() / canvas.size_px();
  const double width_m = canvas.tile_m() / masonry.columns, height_m = canvas.tile_m() / masonry.rows;
  canvas.paint([&](double x, double y) {
    const int row = std::min(static_cast<int>(y / height_m), masonry.rows - 1);
    const double shifted = x + (row % 2 == 1 ? masonry.bond * width_m : 0.0);
    const int column = static_cast<int>(shifted / width_m) % masonry.columns;
    const Color& tone = tones[static_cast<size_t>(row * masonry.columns + column)];
    const float in_joint = std::max(joint_share(shifted, pixel_m, width_m, masonry.joint_m),
                                    joint_share(y, pixel_m, height_m, masonry.joint_m));
    return tone + (joint - tone) * in_joint;
  });
}

}  // namespace hedgehop::scenes::textures
