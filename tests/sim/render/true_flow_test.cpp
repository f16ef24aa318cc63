#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/render/moving_world.h"
#include "tests/sim/render/tested_renderer.h"
#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::sim {
namespace {

constexpr double kFlowPx = 0.02;

/// Returns the next pixel of the point at a pixel, by ray casting and projection; none if it is not visible.
std::optional<Eigen::Vector2d> next_pixel(const MovingWorld& world, const CameraView& view, const Hit& hit) {
  if (hit.face < 0) return std::nullopt;
  const Eigen::Vector3d p_W = hit.p_W + world.moved_W(hit.body(), view.next.t_s - view.t_s);
  return view.camera.project(view.next.X_WC.inverse() * p_W);
}

/// Returns the maximum error over all pixels with a clear hit, px. @param edge_px  see clear_hit().
double max_error_px(const MovingWorld& world, const CameraView& view, const cv::Mat& flow, double edge_px,
                    int& compared, int& on_movers) {
  const RayCaster cast = world.at(view.t_s);
  double worst_px = 0.0;
  const int step = edge_px > 0.1 ? 2 : 1;
  for (int row = 0; row < flow.rows; row += step) {
    for (int col = 0; col < flow.cols; col += step) {
      const std::optional<Hit> hit = clear_hit(cast, view, col, row, edge_px);
      if (!hit || hit->distance_m < 0.5) continue;
      const auto next = next_pixel(world, view, *hit);
      if (!next) continue;
      const auto& seen = flow.at<cv::Vec2f>(row, col);
      const Eigen::Vector2d drawn = Eigen::Vector2d(seen[0], seen[1]) + Eigen::Vector2d(col, row);
      ++compared;
      on_movers += hit->body() > 20;
      // A point close to the lens may leave any image.
      if ((*next - Eigen::Vector2d(col, row)).norm() > 300.0) continue;
      worst_px = std::max(worst_px, (drawn - *next).norm());
    }
  }
  return worst_px;
}

TEST(TrueFlow, EqualsPointsProjectedAtBothTimes) {
  const MovingWorld world(401);
  Renderer renderer = make_renderer(world.scene());
  std::mt19937_64 random(402);
  cv::Mat flow;
  int compared = 0, on_movers = 0;
  double worst_px = 0.0;
  for (int trial = 0; trial < 24; ++trial) {
    CameraView view;
    view.camera = trial % 3 == 0   ? vision::camera::Camera(vision::camera::PinholeCamera::from_fov(160, 120, 1.5))
                  : trial % 3 == 1 ? vision::random_distorted_pinhole(random)
                                   : vision::random_fisheye(random);
    view.channel = ImageChannel::flow;
    view.X_WC = random_pose(random, 50.0, 30.0, 0.8);
    view.t_s = uniform(random, 0.0, 90.0);
    view.next.t_s = view.t_s + uniform(random, 0.0, 0.5);
    view.next.X_WC = view.X_WC * Eigen::Translation3d(uniform(random, -0.2, 0.2), uniform(random, -0.2, 0.2), 0.1) *
                     Eigen::AngleAxisd(uniform(random, 0.0, 0.05), Eigen::Vector3d(1, 2, 3).normalized());
    const auto near = [&](const auto& box) { return box.exteriorDistance(view.X_WC.translation()) < 1.0; };
    if (std::ranges::any_of(world.at(view.t_s).boxes_W, near)) continue;
    renderer.draw(view, flow);
    ASSERT_EQ(flow.type(), CV_32FC2);
    const double edge_px = view.camera.is_undistorted_pinhole() ? 0.02 : 1.5;
    const double error_px = max_error_px(world, view, flow, edge_px, compared, on_movers);
    EXPECT_LT(error_px, kFlowPx) << "trial " << trial;
    worst_px = std::max(worst_px, error_px);
  }
  RecordProperty("worst_px", std::to_string(worst_px));
  EXPECT_GT(compared, 100'000);
  EXPECT_GT(on_movers, 2'000);
}

TEST(TrueFlow, OfTheSkyComesFromRotationOnly) {
  SmallWorld empty;
  Renderer renderer = make_renderer(empty.scene);
  CameraView view{vision::camera::PinholeCamera{101, 81, 90.0, 90.0, 50.0, 40.0}, Eigen::Isometry3d::Identity(),
                  ImageChannel::flow};
  view.next.X_WC = Eigen::Translation3d(5.0, -3.0, 2.0) * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY());
  cv::Mat flow;
  renderer.draw(view, flow);
  // After a rotation of 0.1 rad to the right, the former image center is 0.1 rad to the left.
  EXPECT_NEAR(flow.at<cv::Vec2f>(40, 50)[0], -90.0 * std::tan(0.1), 1e-4);
  EXPECT_NEAR(flow.at<cv::Vec2f>(40, 50)[1], 0.0, 1e-4);
  view.next.X_WC = view.X_WC;
  renderer.draw(view, flow);
  EXPECT_NEAR(cv::norm(flow, cv::NORM_INF), 0.0, 1e-4);
}

TEST(TrueFlow, IsUnknownOutsideTheImageCircle) {
  SmallWorld empty;
  Renderer renderer = make_renderer(empty.scene);
  vision::camera::FisheyeLens lens{40, 40, 49.5, 49.5};
  lens.limit_rad = 1.0;
  CameraView view{vision::camera::Camera(100, 100, lens), Eigen::Isometry3d::Identity(), ImageChannel::flow};
  view.next.X_WC = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  cv::Mat flow;
  renderer.draw(view, flow);
  EXPECT_TRUE(std::isnan(flow.at<cv::Vec2f>(2, 2)[0]));    // outside the image circle
  EXPECT_TRUE(std::isnan(flow.at<cv::Vec2f>(50, 12)[0]));  // inside, but out of it next
  EXPECT_FALSE(std::isnan(flow.at<cv::Vec2f>(50, 60)[0]));
}

}  // namespace
}  // namespace hedgehop::sim
