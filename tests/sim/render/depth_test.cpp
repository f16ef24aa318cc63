#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "tests/sim/render/ray_caster.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

constexpr double kDepthRelative = 1e-4;
constexpr double kDepthEdgePx = 0.02;

TEST(Depth, EqualsRayCastingOfBoxesAndGround) {
  std::mt19937_64 random(21);
  SmallWorld world;
  RayCaster cast;
  cast.ground_half_m = 400.0;
  world.add_ground(400.0f, 4);
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d center(uniform(random, -150, 150), uniform(random, -150, 150), uniform(random, -40, -5));
    const Eigen::Vector3d half(uniform(random, 0.2, 10), uniform(random, 0.2, 10), uniform(random, 0.2, 5));
    const Eigen::AlignedBox3f box_W((center - half).cast<float>(), (center + half).cast<float>());
    world.add_box(box_W);
    cast.boxes_W.push_back(box_W.cast<double>());
  }
  Renderer renderer = make_renderer(world.scene);
  const vision::camera::PinholeCamera camera{200, 150, 130.0, 170.0, 90.0, 80.0};
  cv::Mat depth;
  size_t compared = 0, surfaces = 0;
  for (int trial = 0; trial < 30; ++trial) {
    CameraView view{camera, random_pose(random, 150.0, 40.0, 1.0), ImageChannel::depth};
    const auto inside = [&](const auto& box) { return box.exteriorDistance(view.X_WC.translation()) < 0.2; };
    if (std::ranges::any_of(cast.boxes_W, inside)) continue;
    renderer.draw(view, depth);
    for (int row = 0; row < depth.rows; ++row) {
      for (int col = 0; col < depth.cols; ++col) {
        const std::optional<Hit> hit = clear_hit(cast, view, col, row, kDepthEdgePx);
        if (!hit) continue;
        const auto z_m = static_cast<double>(depth.at<float>(row, col));
        ++compared;
        if (hit->face < 0) {
          ASSERT_EQ(z_m, std::numeric_limits<double>::infinity())
              << "trial " << trial << ", pixel " << col << ", " << row;
        } else {
          ++surfaces;
          ASSERT_NEAR(z_m / hit->z_m, 1.0, kDepthRelative) << "trial " << trial << ", pixel " << col << ", " << row;
        }
      }
    }
  }
  EXPECT_GT(compared, 700'000u);
  EXPECT_GT(surfaces, 300'000u);
}

// Two kilometers from the origin, floats have a resolution of 0.1 mm. The error must not be larger.
TEST(Depth, IsAccurateFarFromTheOriginAndAtShortRange) {
  for (const double range_m : {0.06, 0.3, 5.0, 900.0}) {
    const Eigen::Vector3d eye_W(2000.0123, -1500.0456, -30.0789);
    SmallWorld world;
    const float wall_m = 2500.0f;
    world.add_quad({wall_m, -4000, -2000}, {0, 5000, 0}, {0, 0, 4000});
    Renderer renderer = make_renderer(world.scene);
    const Eigen::Vector3d at(static_cast<double>(wall_m) - range_m, eye_W.y(), eye_W.z());
    cv::Mat depth;
    renderer.draw({vision::camera::PinholeCamera::from_fov(60, 40, 1.5), look_at(at, at + Eigen::Vector3d::UnitX()),
                   ImageChannel::depth},
                  depth);
    double nearest = 0, farthest = 0;
    cv::minMaxLoc(depth, &nearest, &farthest);
    EXPECT_NEAR(nearest / range_m, 1.0, kDepthRelative);
    EXPECT_NEAR(farthest / range_m, 1.0, kDepthRelative);
  }
}

}  // namespace
}  // namespace hedgehop::sim
