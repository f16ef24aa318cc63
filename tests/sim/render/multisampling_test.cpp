#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <set>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

constexpr int kWidthPx = 200, kHeightPx = 160;
constexpr double kFocalPx = 150.0;
const vision::camera::PinholeCamera kSampledCamera{kWidthPx, kHeightPx, kFocalPx, kFocalPx, 99.5, 79.5};

CameraView view_of(const vision::camera::Camera& camera, ImageChannel channel, int samples) {
  CameraView view{camera, look_at({0, 0, -5}, {1, 0, -5}), channel};  // u runs east, v down
  view.samples = samples;
  return view;
}

/// A white plane 10 m ahead, right of a line that shifts to the right by `slope` pixels per row.
SmallWorld half_plane(double slope) {
  SmallWorld world;
  world.scene.lights = {.ambient = 1.0f, .sun = 0.0f};
  world.scene.sky = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  const auto lean = static_cast<float>(slope * 40.0);
  world.add_quad({10, -0.5f * lean, -25}, {0, 60, 0}, {0, lean, 40});
  return world;
}

/// Returns the first white column of each row, px, from the sum of its levels.
std::vector<double> edge_px(const cv::Mat& grey) {
  std::vector<double> edge;
  for (int v = 0; v < grey.rows; ++v) edge.push_back(kWidthPx - 0.5 - cv::sum(grey.row(v))[0] / 255.0);
  return edge;
}

TEST(Multisampling, HalvesTheErrorOfASlantedEdge) {
  std::mt19937_64 random(61);
  for (int trial = 0; trial < 10; ++trial) {
    const double slope = uniform(random, -0.7, 0.7);
    const SmallWorld world = half_plane(slope);
    Renderer renderer = make_renderer(world.scene);
    cv::Mat one, four;
    renderer.draw(view_of(kSampledCamera, ImageChannel::grey, 1), one);
    renderer.draw(view_of(kSampledCamera, ImageChannel::grey, 4), four);
    const std::vector<double> rough_px = edge_px(one), fine_px = edge_px(four);
    double mean_px = 0.0, rough_square = 0.0, fine_square = 0.0;
    for (int v = 0; v < kHeightPx; ++v) {
      const double truth_px = kSampledCamera.center_u_px + slope * (v - kSampledCamera.center_v_px);
      mean_px += (fine_px[static_cast<size_t>(v)] - truth_px) / kHeightPx;
      fine_square += std::pow(fine_px[static_cast<size_t>(v)] - truth_px, 2);
      rough_square += std::pow(rough_px[static_cast<size_t>(v)] - truth_px, 2);
    }
    EXPECT_NEAR(mean_px, 0.0, 0.1) << slope;
    // 1/16 along a row or a column; more if a slanted edge meets several of the four samples at once.
    EXPECT_LT(fine_square, 0.5 * rough_square) << slope;
    const std::set<uint8_t> levels(four.begin<uint8_t>(), four.end<uint8_t>());
    EXPECT_THAT(levels, testing::ElementsAre(0, 64, 128, 191, 255)) << slope;
    EXPECT_THAT(std::set<uint8_t>(one.begin<uint8_t>(), one.end<uint8_t>()), testing::ElementsAre(0, 255));
  }
}

TEST(Multisampling, ReducesTheErrorOfEveryLens) {
  const SmallWorld city = small_city(4, 62);
  Renderer renderer = make_renderer(city.scene);
  const auto fisheye = [](int times) {
    const double k = times;
    return vision::camera::Camera(60 * times, 60 * times,
                                  vision::camera::FisheyeLens{19 * k, 19 * k, 30 * k - 0.5, 30 * k - 0.5});
  };
  const auto bent = [](int times) {
    const double k = times;
    vision::camera::PinholeLens lens{40 * k, 40 * k, 30 * k - 0.5, 30 * k - 0.5};
    lens.k1 = -0.1;
    return vision::camera::Camera(60 * times, 60 * times, lens);
  };
  const auto error = [&](const auto& camera, ImageChannel channel, int samples) {
    cv::Mat drawn, many, truth;
    renderer.draw(view_of(camera(1), channel, samples), drawn);
    renderer.draw(view_of(camera(8), channel, 1), many);
    cv::resize(many, truth, drawn.size(), 0, 0, cv::INTER_AREA);
    return cv::norm(drawn, truth, cv::NORM_L2);
  };
  for (const ImageChannel channel : {ImageChannel::grey, ImageChannel::color}) {
    EXPECT_LT(error(fisheye, channel, 4), 0.9 * error(fisheye, channel, 1));
    EXPECT_LT(error(bent, channel, 4), 0.9 * error(bent, channel, 1));
  }
}

TEST(Multisampling, DoesNotChangeDepthLabelsAndFlow) {
  const SmallWorld city = small_city(4, 63);
  Renderer renderer = make_renderer(city.scene);
  for (const ImageChannel channel : {ImageChannel::depth, ImageChannel::labels, ImageChannel::flow}) {
    cv::Mat one, four;
    renderer.draw(view_of(kSampledCamera, channel, 1), one);
    renderer.draw(view_of(kSampledCamera, channel, 4), four);
    ASSERT_EQ(one.type(), four.type());
    EXPECT_EQ(std::memcmp(one.data, four.data, one.total() * one.elemSize()), 0);
  }
}

TEST(Multisampling, IsRejectedIfTheRendererLacksTheNumberOfSamples) {
  const SmallWorld world;
  Renderer renderer = make_renderer(world.scene);
  const auto fault = [&](int samples) -> std::string {
    try {
      renderer.require_samples(samples);
      return "";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_EQ(fault(1), "");
  EXPECT_EQ(fault(4), "");
  EXPECT_THAT(fault(8), testing::HasSubstr("maximum of this OpenGL: 4"));  // Mesa's rasterizer supports 1 and 4 only
  EXPECT_THAT(fault(2), testing::HasSubstr("this OpenGL uses 4"));
  EXPECT_THAT(fault(3), testing::HasSubstr("3 samples per pixel; valid: 1, 2, 4, 8"));
  cv::Mat image;
  EXPECT_THROW(renderer.draw(view_of(kSampledCamera, ImageChannel::grey, 8), image), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim
