#include "avoidance/flow_balance/camera_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/avoidance/flow_balance/flow_rig.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr int kSizePx = 200;
constexpr double kImageS = 0.04;
constexpr double kNorthM = 4.0, kEastM = 2.5, kSouthM = 5.0, kWestM = 3.0;  // of the walls from the origin

// Drawn images of a room, its walls across the heading; the flight leads aslant, and straight at a wall.
TEST(CameraWalls, ARoomIsRangedFromTwoImagesOfFourCameras) {
  const std::vector<vision::TexturedPlane> room = {wall(kNorthM, 0.0, M_PI), wall(0.0, kEastM, -0.5 * M_PI),
                                                   wall(-kSouthM, 0.0, 0.0), wall(0.0, -kWestM, 0.5 * M_PI)};
  const vision::WaveTexture texture(7, 0.05, 0.8, 24);
  for (const Eigen::Vector2d& v_mps :
       {Eigen::Vector2d(0.9, 0.9), Eigen::Vector2d(-0.4, 1.2), Eigen::Vector2d(0.0, 1.4)}) {
    const auto setup = four_cameras(kSizePx, 1.0 / kImageS);
    CameraFlow::Options options;
    options.flow = {.rows = 1, .cols = 8, .patch_px = 32, .margin_px = 14, .levels = 2};
    options.derotate = true;
    options.missing = vision::flow::Missing::skip;
    std::vector<CameraFlow> cameras;
    for (const MountedCamera& camera : setup.cameras) cameras.emplace_back(camera, options);
    NavigationState navigation;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d at_m = k * kImageS * v_mps;
      navigation = level_flight({at_m.x(), at_m.y(), -1.0}, 0.0, v_mps);
      const auto frames = see(setup, navigation, k * 40'000'000, room, texture);
      for (size_t i = 0; i < cameras.size(); ++i) cameras[i].update(frames[i], Eigen::Vector3d::Zero());
    }
    const auto walls = walls_round(cameras, navigation, 40'000'000, {});
    const Eigen::Vector2d moved_m = kImageS * v_mps;
    for (const Eigen::Vector2d& to_wall_m :
         {Eigen::Vector2d(kNorthM - moved_m.x(), 0.0), Eigen::Vector2d(0.0, kEastM - moved_m.y()),
          Eigen::Vector2d(-kSouthM - moved_m.x(), 0.0), Eigen::Vector2d(0.0, -kWestM - moved_m.y())}) {
      const vision::flow::WallEstimate* nearest = nullptr;
      double least = INFINITY;
      for (const vision::flow::WallEstimate& found : walls) {
        const double error = (found.inverse_range_per_m * to_wall_m.norm() - to_wall_m.normalized()).norm();
        if (error >= least) continue;
        least = error;
        nearest = &found;
      }
      ASSERT_NE(nearest, nullptr);
      // What is near is told well; all of it as well as the fit says.
      if (to_wall_m.norm() < 3.5) {
        EXPECT_LT(least, 0.1) << v_mps.transpose() << " to " << to_wall_m.transpose();
      }
      EXPECT_LT(std::abs(nearest->inverse_range_per_m.norm() * to_wall_m.norm() - 1.0), 3.0 * nearest->relative_error)
          << v_mps.transpose() << " to " << to_wall_m.transpose();
    }
  }
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
