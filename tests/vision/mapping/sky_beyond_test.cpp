#include <gtest/gtest.h>

#include "tests/vision/mapping/sky_view.h"
#include "vision/mapping/ground_plane.h"

namespace hedgehop::vision::mapping {
namespace {

// A plain wall across the route, lower than the camera, hides the ground up to the lower border of the image.
TEST(FindSky, FindsSkyOverGroundBeyondALowPlainWall) {
  constexpr double kHeightM = 5.0;
  for (const double ahead_m : {6.0, 7.0}) {
    const Eigen::AlignedBox3d low(Eigen::Vector3d(ahead_m, -90.0, -3.0), Eigen::Vector3d(ahead_m + 0.5, 90.0, 0.0));
    const Eigen::AlignedBox3d tall(Eigen::Vector3d(ahead_m, -90.0, -9.0), Eigen::Vector3d(ahead_m + 0.5, -2.0, 0.0));
    const SkyView view = look({}, kHeightM, {low, tall});
    const Eigen::Vector3d down_C = view.X_WC.linear().row(2).transpose();
    const GroundPlane ground{view.world.geometry.disparity16(kHeightM) * down_C};
    DepthBlocks blocks;
    blocks.build(view.disparity16, view.grey, 0);
    EXPECT_EQ(find_sky(view.world.geometry, down_C, blocks), 0);
    find_sky(view.world.geometry, down_C, blocks, &ground);
    int sky = 0, found = 0, wrong = 0;
    for (int row = 0; row < blocks.rows() / 2 - 1; ++row) {
      for (int col = 0; col < blocks.cols(); ++col) {
        int of_sky = 0;
        for (int i = 0; i < 64; ++i) {
          of_sky += view.is_sky[static_cast<size_t>((8 * row + i / 8) * view.world.width_px + 8 * col + i % 8)];
        }
        const bool said = blocks.at(row, col).kind == DepthBlock::Kind::sky;
        sky += of_sky == 64;
        found += said && of_sky == 64;
        wrong += said && of_sky == 0;
      }
    }
    EXPECT_GT(sky, 100) << ahead_m;
    EXPECT_GT(found, 0.8 * sky) << ahead_m;
    EXPECT_EQ(wrong, 0) << ahead_m;
  }
}

}  // namespace
}  // namespace hedgehop::vision::mapping
