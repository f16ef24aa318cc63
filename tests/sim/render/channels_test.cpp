#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "tests/sim/render/osmesa.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

const vision::camera::PinholeCamera kCamera = vision::camera::PinholeCamera::from_fov(240, 180, 1.3);

bool same_pixels(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.0;
}

TEST(Channels, GreyIsTheMeanOfTheColors) {
  const SmallWorld city = small_city(6, 31);
  Renderer renderer = make_renderer(city.scene);
  std::mt19937_64 random(32);
  cv::Mat grey, color, mean;
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d X_WC = random_pose(random, 90.0, 50.0, 0.8);
    renderer.draw({kCamera, X_WC, ImageChannel::grey}, grey);
    renderer.draw({kCamera, X_WC, ImageChannel::color}, color);
    cv::transform(color, mean, cv::Matx13f(1 / 3.0f, 1 / 3.0f, 1 / 3.0f));
    worst = std::max(worst, cv::norm(grey, mean, cv::NORM_INF));
  }
  EXPECT_LE(worst, 1.0);
}

TEST(Channels, HaveTheDocumentedTypes) {
  SmallWorld world;
  Renderer renderer = make_renderer(world.scene);
  cv::Mat grey, color, depth;
  renderer.draw({kCamera, Eigen::Isometry3d::Identity(), ImageChannel::grey}, grey);
  renderer.draw({kCamera, Eigen::Isometry3d::Identity(), ImageChannel::color}, color);
  renderer.draw({kCamera, Eigen::Isometry3d::Identity(), ImageChannel::depth}, depth);
  EXPECT_EQ(grey.type(), CV_8UC1);
  EXPECT_EQ(color.type(), CV_8UC3);
  EXPECT_EQ(depth.type(), CV_32FC1);
  for (const cv::Mat& image : {grey, color, depth}) EXPECT_EQ(image.size(), cv::Size(240, 180));
}

TEST(Channels, BrightnessOfAFaceFollowsTheCosineToTheSun) {
  SmallWorld world(std::vector{plain_image(8, {200, 100, 50})});
  world.scene.lights = {.ambient = 0.4f, .sun = 0.5f, .to_sun_W = Eigen::Vector3f(-0.6f, 0.0f, -0.8f)};
  world.add_box({Eigen::Vector3f(-5, -5, -10), Eigen::Vector3f(5, 5, 0)});
  Renderer renderer = make_renderer(world.scene);
  cv::Mat color;
  const auto color_from = [&](const Eigen::Vector3d& p_WC) {
    renderer.draw({kCamera, look_at(p_WC, {0, 0, -5}), ImageChannel::color}, color);
    return color.at<cv::Vec3b>(90, 120);
  };
  EXPECT_EQ(color_from({-12, 0, -5}), cv::Vec3b(140, 70, 35));  // south, n . l = 0.6
  EXPECT_EQ(color_from({0, 0, -20}), cv::Vec3b(160, 80, 40));   // roof, n . l = 0.8
  EXPECT_EQ(color_from({12, 0, -5}), cv::Vec3b(80, 40, 20));    // north, faces away from the sun
  EXPECT_EQ(color_from({0, 12, -5}), cv::Vec3b(80, 40, 20));    // east, parallel to the light
}

TEST(Channels, SkyBlendsFromHorizonToZenith) {
  SmallWorld world;
  world.scene.sky = {.horizon = {0.8f, 0.6f, 0.4f}, .zenith = {0.2f, 0.4f, 1.0f}};
  Renderer renderer = make_renderer(world.scene);
  const vision::camera::PinholeCamera camera{101, 101, 40.0, 40.0, 50.0, 50.0};
  cv::Mat color;
  renderer.draw({camera, look_at({0, 0, -5}, {0, 0, -6}), ImageChannel::color}, color);
  EXPECT_EQ(color.at<cv::Vec3b>(50, 50), cv::Vec3b(51, 102, 255));
  renderer.draw({camera, look_at({0, 0, -5}, {1, 0, -5}), ImageChannel::color}, color);
  EXPECT_EQ(color.at<cv::Vec3b>(50, 50), cv::Vec3b(204, 153, 102));
  EXPECT_EQ(color.at<cv::Vec3b>(90, 50), cv::Vec3b(204, 153, 102));
  EXPECT_LT(color.at<cv::Vec3b>(0, 50)[0], color.at<cv::Vec3b>(40, 50)[0]);
}

TEST(Renderer, DrawsEqualPixelsRepeatedlyAndWithASecondRenderer) {
  const SmallWorld city = small_city(5, 41);
  Renderer first = make_renderer(city.scene);
  Renderer second = make_renderer(city.scene);
  std::mt19937_64 random(42);
  cv::Mat once, twice, elsewhere, other_size;
  for (int trial = 0; trial < 9; ++trial) {
    const auto channel = static_cast<ImageChannel>(trial % 3);
    const CameraView view{kCamera, random_pose(random, 80.0, 50.0, 0.8), channel};
    first.draw(view, once);
    second.draw(view, elsewhere);
    second.draw({vision::camera::PinholeCamera::from_fov(64, 32, 2.0), view.X_WC, channel}, other_size);
    first.draw(view, twice);
    EXPECT_TRUE(same_pixels(once, twice));
    EXPECT_TRUE(same_pixels(once, elsewhere));
  }
}

TEST(Renderer, WritesIntoTheGivenImage) {
  const SmallWorld city = small_city(3, 51);
  Renderer renderer = make_renderer(city.scene);
  const CameraView view{kCamera, look_at({-60, 3, -8}, {0, 0, -8}), ImageChannel::color};
  cv::Mat image;
  renderer.draw(view, image);
  const uint8_t* const data = image.data;
  cv::Mat wide(180, 500, CV_8UC3, cv::Scalar::all(7));
  cv::Mat half = wide(cv::Rect(250, 0, 240, 180));
  renderer.draw(view, half);
  EXPECT_TRUE(same_pixels(half, image));
  EXPECT_EQ(wide.at<cv::Vec3b>(90, 249), cv::Vec3b::all(7));
  EXPECT_EQ(wide.at<cv::Vec3b>(90, 490), cv::Vec3b::all(7));
  renderer.draw(view, image);
  EXPECT_EQ(image.data, data);
}

TEST(Renderer, InfoNamesItselfAndOpenGl) {
  HEDGEHOP_REQUIRE_OSMESA();
  EXPECT_THAT(Renderer(SmallWorld().scene).info(),
              testing::AllOf(testing::StartsWith("osmesa: "), testing::HasSubstr("OpenGL")));
}

TEST(Renderer, RejectsInvalidScenesAndViews) {
  SmallWorld bad_index;
  bad_index.add_box({Eigen::Vector3f(-1, -1, -1), Eigen::Vector3f(1, 1, 1)});
  bad_index.scene.meshes.front().indices.back() = 1000;
  EXPECT_THROW(make_renderer(bad_index.scene), std::invalid_argument);

  scenes::Scene two_sizes;
  two_sizes.textures.add(2, [] { return std::vector<cv::Mat>{plain_image(512, {}), plain_image(16, {})}; });
  two_sizes.meshes = SmallWorld().scene.meshes;
  Renderer of_two_sizes = make_renderer(two_sizes);
  cv::Mat unseen;
  EXPECT_THROW(of_two_sizes.draw({kCamera, Eigen::Isometry3d::Identity(), ImageChannel::grey}, unseen),
               std::invalid_argument);

  SmallWorld no_such_texture;
  no_such_texture.add_quad({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 3);
  EXPECT_THROW(make_renderer(no_such_texture.scene), std::invalid_argument);

  Renderer renderer = make_renderer(SmallWorld().scene);
  cv::Mat image;
  EXPECT_THROW(renderer.draw({}, image), std::invalid_argument);
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(renderer.draw({kCamera, X_WC, ImageChannel::grey}, image), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::sim
