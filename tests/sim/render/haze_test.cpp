#include "sim/render/haze.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

TEST(Haze, ReducesTheContrastTo5PercentAtTheVisibility) {
  EXPECT_DOUBLE_EQ(transmittance(0.0, 30.0), 1.0);
  EXPECT_NEAR(transmittance(30.0, 30.0), 0.05, 1e-12);
  EXPECT_NEAR(transmittance(60.0, 30.0), 0.0025, 1e-12);
  EXPECT_NEAR(transmittance(10.0, 30.0), std::cbrt(0.05), 1e-12);
}

/// Compares each level with that of the clear image, blended with the color of the air by Koschmieder's law.
void expect_haze(const vision::camera::Camera& camera, ImageChannel channel) {
  SmallWorld city = small_city(6, 31);
  const Eigen::Isometry3d X_WC = look_at({-60, 5, -20}, {0, 0, -8});
  cv::Mat clear, depth, hazy;
  {
    Renderer renderer = make_renderer(city.scene);
    renderer.draw({camera, X_WC, channel}, clear);
    renderer.draw({camera, X_WC, ImageChannel::depth}, depth);
  }
  city.scene.sky.visibility_m = 120.0;
  Renderer renderer = make_renderer(city.scene);
  renderer.draw({camera, X_WC, channel}, hazy);
  ASSERT_EQ(hazy.type(), clear.type());
  const int channels = clear.channels();
  int changed = 0;
  for (int v = 0; v < clear.rows; ++v) {
    for (int u = 0; u < clear.cols; ++u) {
      const auto z_m = static_cast<double>(depth.at<float>(v, u));
      double seen = 1.0;
      if (std::isfinite(z_m)) {
        const bool depth_is_z = std::holds_alternative<vision::camera::PinholeLens>(camera.lens);
        const double along = depth_is_z ? 1.0 / camera.unit_ray({u + 0.0, v + 0.0})->z() : 1.0;
        seen = std::pow(0.05, z_m * along / 120.0);
      }
      for (int k = 0; k < channels; ++k) {
        const double air = 255.0 * (channels == 1 ? city.scene.sky.horizon.mean() : city.scene.sky.horizon[k]);
        const int before = clear.ptr(v)[channels * u + k], after = hazy.ptr(v)[channels * u + k];
        ASSERT_NEAR(after, air + seen * (before - air), 0.51) << "pixel " << u << ", " << v;
        changed += after != before ? 1 : 0;
      }
    }
  }
  EXPECT_GT(changed, clear.rows * clear.cols / 4);
}

const auto kPinhole = vision::camera::PinholeCamera::from_fov(160, 120, 1.3);

TEST(Haze, FollowsKoschmiedersLawInGrey) { expect_haze(kPinhole, ImageChannel::grey); }

TEST(Haze, FollowsKoschmiedersLawInColor) { expect_haze(kPinhole, ImageChannel::color); }

TEST(Haze, FollowsKoschmiedersLawThroughADistortedPinhole) {
  const vision::camera::PinholeLens lens{
      .focal_x_px = 55.0, .focal_y_px = 55.0, .center_u_px = 79.5, .center_v_px = 79.5, .k1 = -0.05};
  expect_haze({160, 160, lens}, ImageChannel::grey);
}

TEST(Haze, FollowsKoschmiedersLawThroughAFisheye) {
  const vision::camera::FisheyeLens lens{
      .focal_x_px = 55.0, .focal_y_px = 55.0, .center_u_px = 79.5, .center_v_px = 79.5, .limit_rad = 1.6};
  expect_haze({160, 160, lens}, ImageChannel::grey);
}

TEST(Haze, DoesNotChangeDepthAndLabels) {
  SmallWorld city = small_city(6, 31);
  const Eigen::Isometry3d X_WC = look_at({-60, 5, -20}, {0, 0, -8});
  Renderer clear = make_renderer(city.scene);
  city.scene.sky.visibility_m = 30.0;
  Renderer hazy = make_renderer(city.scene);
  for (const ImageChannel channel : {ImageChannel::depth, ImageChannel::labels}) {
    cv::Mat a, b;
    clear.draw({kPinhole, X_WC, channel}, a);
    hazy.draw({kPinhole, X_WC, channel}, b);
    EXPECT_TRUE(std::equal(a.datastart, a.dataend, b.datastart, b.dataend));
  }
}

}  // namespace
}  // namespace hedgehop::sim
