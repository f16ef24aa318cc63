// How many moments a blurred image needs: few of them against very many.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scenes/generators.h"
#include "sim/loop/cameras.h"

namespace hedgehop::sim {
namespace {

struct Blur {
  std::string name;
  scenes::Scene scene;
  Eigen::Vector3d p_WB, v_WB_W;
  double clearance_m = 0.0;
};

/// The image of one camera that looks ahead, grey, without noise.
cv::Mat exposed(const Blur& blur, const Eigen::Vector3d& w_WB_B, int most_moments, double clearance_m, int samples) {
  RigConfig rig;
  rig.cameras = {{.role = "front", .width_px = 200, .height_px = 200, .samples = samples}};
  rig.cameras[0].imperfections = ImperfectionsConfig{.shutter_s = 0.004, .shutter_samples = most_moments};
  Renderer renderer(blur.scene, Culling::frustum, RendererKind::tiles);
  Cameras cameras(rig, Ticks(500), blur.scene, renderer, 1);
  BodyMotion body{.v_WB_W = blur.v_WB_W, .w_WB_B = w_WB_B, .clearance_m = clearance_m};
  body.X_WB.translation() = blur.p_WB;
  return cameras.expose(0, 1'000'000'000, body)->image.clone();
}

// In daylight a mid-grey pixel has 2.3 grey levels of noise. Images with one sample per pixel are aliased, each moment
// differently; with four samples, the remaining error is that of the blur.
TEST(MotionBlur, DiffersFromThatOf64MomentsByLessThanNoiseHides) {
  const std::vector<Blur> flights = {
      {"tree", scenes::make_scene(scenes::worlds::TreeConfig{}, 1), {-12.0, 0.0, -5.0}, {3.0, 0.5, 0.0}, 5.0},
      {"city",
       scenes::make_scene(scenes::worlds::UrbanConfig{.extent_m = 200.0}, 1),
       {0.0, -30.0, -8.0},
       {2.0, 0, 0},
       4.0},
      {"corridor", scenes::make_scene(scenes::worlds::CorridorConfig{}, 1), {2.0, 0.0, -1.5}, {0.6, 0, 0}, 0.8}};
  for (const auto& [samples, hidden] : {std::pair(1, 1.0), std::pair(4, 0.6)}) {
    for (const Blur& blur : flights) {
      for (const double w_radps : {0.0, 0.15, 0.5, 1.5}) {
        const Eigen::Vector3d w_WB_B(0.0, 0.4 * w_radps, w_radps);
        const cv::Mat few = exposed(blur, w_WB_B, 8, blur.clearance_m, samples);
        const cv::Mat many = exposed(blur, w_WB_B, 64, 0.0, samples);  // unknown distances: as many as allowed
        const double rms = cv::norm(few, many, cv::NORM_L2) / std::sqrt(static_cast<double>(few.total()));
        RecordProperty(blur.name + "_" + std::to_string(w_radps) + "_" + std::to_string(samples), std::to_string(rms));
        EXPECT_LT(rms, hidden) << blur.name << ", " << w_radps << " rad/s, samples: " << samples;
      }
    }
  }
}

/// A scene named as a map, and an object that moves sideways behind the camera of `exposed`.
Blur passed_by(double distance_m) {
  Blur blur{"map", scenes::make_scene(scenes::worlds::TreeConfig{}, 1), {-12.0, 0.0, -5.0}, {3.0, 0.5, 0.0}, 5.0};
  blur.scene.name = "map";
  scenes::Mover& mover =
      blur.scene.movers.emplace_back(scenes::Mover{.name = "car", .mesh = {}, .solids = {}, .motion = {}});
  mover.mesh.material = "opaque";
  mover.mesh.instances.resize(1);
  mover.motion = scenes::WaypointMotion{.points = {{-12.0 - distance_m, -20.0, 5.0}, {-12.0 - distance_m, 20.0, 5.0}},
                                        .speed_mps = 20.0};
  return blur;
}

TEST(MotionBlur, MoversOfAMapCountAtTheirOwnDistance) {
  const auto image = [](const Blur& blur) { return exposed(blur, Eigen::Vector3d::Zero(), 8, blur.clearance_m, 1); };
  Blur still = passed_by(1000.0);
  still.scene.movers.clear();
  EXPECT_EQ(cv::norm(image(still), image(passed_by(1000.0)), cv::NORM_INF), 0.0);  // as many moments
  EXPECT_GT(cv::norm(image(still), image(passed_by(5.0)), cv::NORM_INF), 0.0);
  Blur elsewhere = passed_by(1000.0);
  elsewhere.scene.name = "tree";
  EXPECT_GT(cv::norm(image(still), image(elsewhere), cv::NORM_INF), 0.0);  // as in 0.2
}

}  // namespace
}  // namespace hedgehop::sim
