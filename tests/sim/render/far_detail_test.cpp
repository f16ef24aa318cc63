#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "scenes/generators.h"
#include "scenes/mesh/mesh_builder.h"
#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace hedgehop::sim {
namespace {

Eigen::Isometry3d level(const Eigen::Vector3d& p_WC, double heading_rad) {
  return look_at(p_WC, p_WC + Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0.0));
}

/// A box north of the origin with a thin post on it. The far detail omits the post.
scenes::Scene post_on_box(double post_m) {
  scenes::mesh::MeshBuilder mesh("opaque");
  mesh.begin_chunk(false);
  const auto add = [&](const Eigen::Vector3d& low_W, const Eigen::Vector3d& high_W) {
    for (const scenes::mesh::TexturedPanel& panel : scenes::mesh::side_panels({low_W, high_W})) mesh.add(panel, {}, 0);
  };
  add({0.0, -0.5 * post_m, -3.0}, {post_m, 0.5 * post_m, -2.0});
  const size_t box_from = mesh.index_count();
  add({0.0, -1.0, -2.0}, {1.0, 1.0, 0.0});
  mesh.keep_from_afar(box_from, post_m);
  scenes::Scene scene;
  scene.textures = std::vector<cv::Mat>{cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(128))};
  scene.meshes.push_back(mesh.finish());
  return scene;
}

TEST(FarDetail, OmitsPartsNarrowerThanAPixel) {
  const double post_m = 0.2, focal_px = 100.0, pixel_wide_at_m = focal_px * post_m;
  Renderer renderer = make_renderer(post_on_box(post_m));
  const vision::camera::PinholeCamera camera{101, 101, focal_px, focal_px, 50.0, 50.0};
  cv::Mat depth;
  for (const double beyond_m : {-19.0, -5.0, -0.1, 0.1, 5.0, 100.0}) {
    renderer.draw({camera, level({-pixel_wide_at_m - beyond_m, 0.0, -2.5}, 0.0), ImageChannel::depth}, depth);
    EXPECT_EQ(renderer.drawn().triangles, beyond_m < 0.0 ? 16u : 8u) << beyond_m;
    EXPECT_EQ(std::isfinite(depth.at<float>(50, 50)), beyond_m < 0.0) << beyond_m;
  }
}

struct Forest {
  scenes::Scene scene = scenes::make_scene(
      scenes::worlds::ForestConfig{.trees = 4000, .keep_clear = {{0.0, 0.0, 3.0}}, .texture_size_px = 128}, 5);
  scenes::Scene whole = without_far_detail(scene);

  static scenes::Scene without_far_detail(scenes::Scene scene) {
    for (scenes::Chunk& chunk : scene.meshes.at(0).chunks) chunk.far = {};
    return scene;
  }
};

const vision::camera::PinholeCamera kFarCamera = vision::camera::PinholeCamera::from_fov(400, 400, 1.57);
/// Distance at which the thinnest trunk, which has three sides, is one pixel wide.
const double kFarM = 0.125 * std::sqrt(3.0) * kFarCamera.focal_x_px;

CameraView random_view(std::mt19937_64& random, double height_m) {
  const double heading_rad = uniform(random, -3.0, 3.0);
  return {kFarCamera, level({uniform(random, -40.0, 40.0), uniform(random, -40.0, 40.0), -height_m}, heading_rad)};
}

/// Share of pixels that change, and root mean square of the change, grey levels.
struct Change {
  double share = 0.0, rms = 0.0;
};

Change mean_change(const Forest& forest, double height_m, std::mt19937_64& random) {
  Renderer by_size = make_renderer(forest.scene);
  Renderer full = make_renderer(forest.whole);
  cv::Mat grey, full_grey, difference;
  constexpr int kViews = 12;
  Change mean;
  for (int k = 0; k < kViews; ++k) {
    const CameraView view = random_view(random, height_m);
    by_size.draw(view, grey);
    full.draw(view, full_grey);
    EXPECT_LT(by_size.drawn().triangles, full.drawn().triangles);
    cv::absdiff(grey, full_grey, difference);
    const auto pixels = static_cast<double>(difference.total());
    mean.share += cv::countNonZero(difference) / pixels / kViews;
    mean.rms += cv::norm(difference) / std::sqrt(pixels) / kViews;
  }
  return mean;
}

TEST(FarDetail, ChangesFewPixelsOfAForest) {
  const Forest forest;
  std::mt19937_64 random(301);
  const Change above = mean_change(forest, 25.0, random), between = mean_change(forest, 1.8, random);
  RecordProperty("above_share", std::to_string(above.share));
  RecordProperty("above_rms", std::to_string(above.rms));
  RecordProperty("between_share", std::to_string(between.share));
  RecordProperty("between_rms", std::to_string(between.rms));
  EXPECT_LT(above.share, 0.002);
  EXPECT_LT(between.share, 0.005);
}

TEST(FarDetail, OmitsOnlyDistantThinTrunks) {
  const Forest forest;
  Renderer by_size = make_renderer(forest.scene);
  Renderer full = make_renderer(forest.whole);
  std::mt19937_64 random(302);
  cv::Mat depth, full_depth;
  int changed = 0;
  // Maximum depth difference within one trunk: no trunk is thicker, and no two trunks are closer.
  constexpr float kThickM = 0.5f;
  for (int k = 0; k < 12; ++k) {
    CameraView view = random_view(random, k % 2 == 0 ? 1.8 : 12.0);
    view.channel = ImageChannel::depth;
    by_size.draw(view, depth);
    full.draw(view, full_depth);
    for (int row = 0; row < depth.rows; ++row) {
      int wide_px = 0;
      for (int col = 0; col < depth.cols; ++col) {
        const float z_m = depth.at<float>(row, col), full_m = full_depth.at<float>(row, col);
        const bool is_changed = z_m != full_m;
        const bool goes_on =
            is_changed && wide_px > 0 && std::abs(full_m - full_depth.at<float>(row, col - 1)) < kThickM;
        wide_px = goes_on ? wide_px + 1 : static_cast<int>(is_changed);
        if (!is_changed) continue;
        ++changed;
        ASSERT_LE(wide_px, 2);  // one pixel wide at the image center, 1.5 times that at the side
        // The omitted surface was far away, and the pixel shows a surface behind it.
        ASSERT_GT(static_cast<double>(full_m), kFarM);
        ASSERT_GT(z_m, full_m);
      }
    }
  }
  EXPECT_GT(changed, 0);
}

/// Returns the number of pixels of the left camera at whose point the right camera shows a farther surface, also in the
/// neighboring pixels.
int seen_past(const cv::Mat& left_m, const cv::Mat& right_m, double focal_px, double baseline_m) {
  constexpr float kSlope = 1.05f;
  int count = 0;
  for (int row = 0; row < left_m.rows; ++row) {
    for (int col = 0; col < left_m.cols; ++col) {
      const float z_m = left_m.at<float>(row, col);
      const int at = static_cast<int>(std::lround(col - focal_px * baseline_m / static_cast<double>(z_m)));
      if (!std::isfinite(z_m) || at < 1 || at + 1 >= left_m.cols) continue;
      const auto shows_farther = [&](int u) { return right_m.at<float>(row, u) > kSlope * z_m; };
      if (shows_farther(at - 1) && shows_farther(at) && shows_farther(at + 1)) ++count;
    }
  }
  return count;
}

TEST(FarDetail, IsEqualForBothCamerasOfAStereoPair) {
  const Forest forest;
  Renderer by_size = make_renderer(forest.scene);
  Renderer full = make_renderer(forest.whole);
  std::mt19937_64 random(303);
  constexpr double kBaselineM = 0.5;
  cv::Mat left_m, right_m;
  int through = 0, through_whole = 0;
  for (int k = 0; k < 12; ++k) {
    CameraView left = random_view(random, 1.8);
    left.channel = ImageChannel::depth;
    CameraView right = left;
    right.X_WC = left.X_WC * Eigen::Translation3d(kBaselineM, 0.0, 0.0);
    for (Renderer* renderer : {&by_size, &full}) {
      renderer->draw(left, left_m);
      renderer->draw(right, right_m);
      (renderer == &full ? through_whole : through) += seen_past(left_m, right_m, kFarCamera.focal_x_px, kBaselineM);
    }
  }
  RecordProperty("through", through);
  RecordProperty("through_whole", through_whole);
  EXPECT_LE(through, through_whole);  // thin trunks may fall between pixels with and without far details
}

}  // namespace
}  // namespace hedgehop::sim
