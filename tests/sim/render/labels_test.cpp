#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>
#include <set>
#include <vector>

#include "scenes/generators.h"
#include "tests/sim/render/osmesa.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

using scenes::SemanticClass;

/// A city, a forest whose distant trees share chunks, and a park; each with a moving tree.
std::vector<scenes::Scene> labeled_worlds() {
  constexpr int64_t kTexturePx = 64;
  scenes::SceneAdditions added;
  added.movers = {{.name = "oak", .shape = scenes::MoverConfig::Shape::tree, .radius_m = 2.0}};
  const std::vector<scenes::SceneConfig> configs = {
      scenes::worlds::UrbanConfig{.texture_size_px = kTexturePx, .added = added},
      scenes::worlds::ForestConfig{.trees = 1500, .texture_size_px = kTexturePx, .added = added},
      scenes::worlds::ParkConfig{.texture_size_px = kTexturePx, .added = added}};
  std::vector<scenes::Scene> worlds;
  for (const scenes::SceneConfig& config : configs) worlds.push_back(scenes::make_scene(config, 6));
  return worlds;
}

CameraView labeled_view(std::mt19937_64& random, int number) {
  CameraView view;
  view.camera = vision::camera::PinholeCamera::from_fov(320, 240, 1.3);
  if (number % 3 == 2) view.camera = vision::camera::Camera(200, 150, vision::camera::FisheyeLens{60, 60, 99.5, 74.5});
  view.X_WC = random_pose(random, 40.0, 20.0, 0.5);
  view.t_s = 0.1 * number;
  return view;
}

TEST(Labels, AreInstancesAndSemanticIsTheirClass) {
  std::set<int> seen;
  for (const scenes::Scene& world : labeled_worlds()) {
    const std::vector<scenes::Instance> instances = scenes::instances(world);
    Renderer renderer = make_renderer(world);
    std::mt19937_64 random(401);
    cv::Mat labels, classes;
    for (int i = 0; i < 6; ++i) {
      CameraView view = labeled_view(random, i);
      view.channel = ImageChannel::labels;
      renderer.draw(view, labels);
      view.channel = ImageChannel::semantic;
      renderer.draw(view, classes);
      for (int row = 0; row < labels.rows; ++row) {
        for (int col = 0; col < labels.cols; ++col) {
          const int label = labels.at<int>(row, col);
          ASSERT_GE(label, 0);
          ASSERT_LE(label, static_cast<int>(instances.size()));
          const int expected = label == 0 ? 0 : scenes::class_id(instances[static_cast<size_t>(label) - 1].kind);
          ASSERT_EQ(classes.at<int>(row, col), expected);
          seen.insert(expected);
        }
      }
    }
  }
  for (const SemanticClass kind : {SemanticClass::ground, SemanticClass::road, SemanticClass::building,
                                   SemanticClass::tree, SemanticClass::vehicle}) {
    EXPECT_TRUE(seen.contains(scenes::class_id(kind))) << scenes::kSemanticClassNames[static_cast<size_t>(kind)];
  }
}

/// Returns 255 for pixels whose neighbors all have the same label, otherwise 0.
cv::Mat away_from_edges(const cv::Mat& labels) {
  cv::Mat values, low, high;
  labels.convertTo(values, CV_32F);
  cv::erode(values, low, cv::Mat());
  cv::dilate(values, high, cv::Mat());
  return low == high;
}

TEST(TilesAndMesaLabels, AreEqualOutsideOfEdges) {
  HEDGEHOP_REQUIRE_OSMESA();
  for (const scenes::Scene& world : labeled_worlds()) {
    Renderer mesa(world, Culling::frustum_and_horizon, RendererKind::osmesa);
    Renderer tiles(world, Culling::frustum_and_horizon, RendererKind::tiles);
    std::mt19937_64 random(402);
    cv::Mat expected, drawn;
    int compared = 0, different = 0;
    for (int i = 0; i < 8; ++i) {
      CameraView view = labeled_view(random, i);
      view.channel = ImageChannel::labels;
      mesa.draw(view, expected);
      tiles.draw(view, drawn);
      const cv::Mat plain = away_from_edges(expected);
      compared += cv::countNonZero(plain);
      different += cv::countNonZero((expected != drawn) & plain);
    }
    EXPECT_GT(compared, 100'000) << world.name;
    EXPECT_EQ(different, 0) << world.name;
  }
}

}  // namespace
}  // namespace hedgehop::sim
