#include <gtest/gtest.h>

#include <cstring>

#include "tests/sim/render/moving_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

constexpr double kMovingRelative = 1e-4, kMovingEdgePx = 0.02;

TEST(Moving, DepthAndLabelsShowMovingObstaclesAtTheirPositions) {
  const MovingWorld world(301);
  Renderer renderer = make_renderer(world.scene());
  std::mt19937_64 random(302);
  cv::Mat depth, labels;
  int compared = 0, movers = 0;
  for (int trial = 0; trial < 30; ++trial) {
    CameraView view{vision::camera::PinholeCamera::from_fov(160, 120, 1.5), random_pose(random, 50.0, 30.0, 0.8),
                    ImageChannel::depth};
    view.t_s = uniform(random, 0.0, 99.0);
    const RayCaster cast = world.at(view.t_s);
    const auto inside = [&](const auto& box) { return box.exteriorDistance(view.X_WC.translation()) < 0.2; };
    if (std::ranges::any_of(cast.boxes_W, inside)) continue;
    renderer.draw(view, depth);
    view.channel = ImageChannel::labels;
    renderer.draw(view, labels);
    for (int row = 0; row < depth.rows; ++row) {
      for (int col = 0; col < depth.cols; ++col) {
        const std::optional<Hit> hit = clear_hit(cast, view, col, row, kMovingEdgePx);
        if (!hit) continue;
        ++compared;
        ASSERT_TRUE(world.is_label(*hit, labels.at<int>(row, col)))
            << "trial " << trial << ": " << col << ", " << row << ", body " << hit->body();
        if (hit->face < 0) continue;
        movers += hit->body() > 20;
        ASSERT_NEAR(static_cast<double>(depth.at<float>(row, col)) / hit->z_m, 1.0, kMovingRelative)
            << "trial " << trial << ": " << col << ", " << row;
      }
    }
  }
  EXPECT_GT(compared, 300'000);
  EXPECT_GT(movers, 10'000);
}

TEST(Moving, CullingChangesNoPixel) {
  const MovingWorld world(303);
  Renderer everything = make_renderer(world.scene(), Culling::none);
  Renderer culled = make_renderer(world.scene());
  std::mt19937_64 random(304);
  cv::Mat all, some;
  for (int trial = 0; trial < 60; ++trial) {
    CameraView view{vision::camera::PinholeCamera::from_fov(160, 120, 1.2), random_pose(random, 70.0, 30.0, 0.8),
                    trial % 2 == 0 ? ImageChannel::depth : ImageChannel::labels};
    view.t_s = uniform(random, 0.0, 99.0);
    everything.draw(view, all);
    culled.draw(view, some);
    ASSERT_EQ(std::memcmp(all.data, some.data, all.total() * all.elemSize()), 0) << "trial " << trial;
  }
}

}  // namespace
}  // namespace hedgehop::sim
