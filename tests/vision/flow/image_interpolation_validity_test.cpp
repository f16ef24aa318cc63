#include <gtest/gtest.h>

#include <cmath>

#include "tests/vision/flow/flow_errors.h"
#include "vision/flow/image_interpolation_flow.h"

// Validity of flow vectors.
namespace hedgehop::vision::flow {
namespace {

TEST(ImageInterpolationFlow, NoVectorIsValidOnTheFirstImageOrAfterReset) {
  const WaveTexture texture(25, 8.0, 100.0);
  const auto image = shifted(texture, {0, 0});
  ImageInterpolationFlow flow({}, kSize, kSize);
  EXPECT_EQ(flow.update(image).valid_count(), 0);
  EXPECT_EQ(flow.update(image).valid_count(), 256);
  flow.reset();
  EXPECT_EQ(flow.field().valid_count(), 0);
  EXPECT_EQ(flow.update(image).valid_count(), 0);
}

TEST(ImageInterpolationFlow, ImagesWithoutTextureGiveNoVectors) {
  const auto flat = draw_image(kSize, kSize, [](double, double) { return 90.0; });
  const auto brighter = draw_image(kSize, kSize, [](double, double) { return 140.0; });
  const auto ramp = draw_image(kSize, kSize, [](double u, double v) { return 40.0 + 0.3 * u + 0.1 * v; });
  auto noise = flat.clone(), more_noise = flat.clone();
  add_noise(noise, 1.0, 1);
  add_noise(more_noise, 1.0, 2);
  ImageInterpolationFlow flow({}, kSize, kSize);
  flow.update(flat);
  for (const cv::Mat& image : {flat, brighter, flat, ramp, ramp, noise, more_noise}) {
    EXPECT_EQ(flow.update(image).valid_count(), 0);
    EXPECT_EQ(largest(flow.field()), 0.0);
  }
}

TEST(ImageInterpolationFlow, StripesGiveNoVectors) {
  // The aperture problem: only motion across the stripes is observable.
  const auto stripes = [](double shift) {
    return draw_image(kSize, kSize,
                      [=](double u, double v) { return 127 + 60 * std::sin(0.25 * (u + 0.5 * v - shift)); });
  };
  ImageInterpolationFlow flow({}, kSize, kSize);
  flow.update(stripes(0.0));
  EXPECT_EQ(flow.update(stripes(1.0)).valid_count(), 0);
}

TEST(ImageInterpolationFlow, SkyInHalfTheImageIsInvalidWithoutEffectOnTheOther) {
  const WaveTexture texture(26, 8.0, 100.0);
  const Eigen::Vector2d move(1.5, 0.0);
  const auto scene = [&](const Eigen::Vector2d& shift) {
    return draw_image(kSize, kSize,
                      [&](double u, double v) { return v < 200 ? 210.0 : texture.grey(u - shift.x(), v - shift.y()); });
  };
  ImageInterpolationFlow flow({}, kSize, kSize);
  flow.update(scene({0, 0}));
  const FlowField& field = flow.update(scene(move));
  for (const FlowVector& vector : field.vectors) {
    const double v = vector.center_px.y();
    if (v < 200 - 36) {
      EXPECT_FALSE(vector.valid) << v;
    }
    if (v > 200 + 36) {
      EXPECT_TRUE(vector.valid) << v;
      EXPECT_LT((vector.flow_px - move).norm(), 0.1) << v;
    }
  }
}

TEST(ImageInterpolationFlow, UnrelatedImagesGiveFewVectorsAllWithinTheLimit) {
  ImageInterpolationConfig config;
  config.max_flow_px = 10.0;
  ImageInterpolationFlow flow(config, kSize, kSize);
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    flow.update(shifted(WaveTexture(seed, 8.0, 60.0), {0, 0}));
    if (seed == 1) continue;
    EXPECT_LT(flow.field().valid_share(), 0.1);
    EXPECT_LE(largest(flow.field()), 10.0);
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
