#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "scenes/mesh/polyhedron.h"
#include "sim/render/tiles/facets.h"
#include "sim/render/tiles/sun_depths.h"
#include "tests/sim/render/osmesa.h"
#include "tests/sim/render/small_world.h"

// Properties of the renderer tiles only: pixels close to those of Mesa, no holes, few facets.
namespace hedgehop::sim {
namespace {

struct Difference {
  double mean = 0.0, far_off = 0.0;  ///< levels; share of pixels
};

/// Returns the mean difference of two images, and the share of their values that differ by more than `level`.
Difference difference(const cv::Mat& a, const cv::Mat& b, double level) {
  cv::Mat levels;
  cv::absdiff(a, b, levels);
  const cv::Mat values = levels.reshape(1);
  return {cv::mean(values)[0], cv::countNonZero(values > level) / static_cast<double>(values.total())};
}

class TilesAndMesa : public testing::Test {
 protected:
  void SetUp() override {
    HEDGEHOP_REQUIRE_OSMESA();
    mesa_.emplace(city_.scene, Culling::frustum_and_horizon, RendererKind::osmesa);
  }

  const SmallWorld city_ = small_city(6, 91);
  std::optional<Renderer> mesa_;
  Renderer tiles_ = Renderer(city_.scene, Culling::frustum_and_horizon, RendererKind::tiles);

  /// Returns the mean over random views.
  Difference compare(ImageChannel channel, int samples, double level) {
    std::mt19937_64 random(92);
    Difference sum;
    constexpr int kViews = 20;
    cv::Mat expected, drawn;
    for (int i = 0; i < kViews; ++i) {
      CameraView view{vision::camera::PinholeCamera::from_fov(320, 240, 1.3), random_pose(random, 80.0, 40.0, 0.5)};
      view.channel = channel;
      view.samples = samples;
      mesa_->draw(view, expected);
      tiles_.draw(view, drawn);
      const Difference here = difference(expected, drawn, level);
      sum.mean += here.mean / kViews;
      sum.far_off += here.far_off / kViews;
    }
    return sum;
  }
};

constexpr double kFarOffLevels = 8.0;

TEST_F(TilesAndMesa, GreyDiffersByAtMostAThirdOfALevel) {
  const Difference found = compare(ImageChannel::grey, 1, kFarOffLevels);
  EXPECT_LE(found.mean, 0.3);
  EXPECT_LE(found.far_off, 5e-4);
}

TEST_F(TilesAndMesa, ColorDiffersByAtMostAThirdOfALevel) {
  const Difference found = compare(ImageChannel::color, 1, kFarOffLevels);
  EXPECT_LE(found.mean, 0.3);
  EXPECT_LE(found.far_off, 5e-4);
}

TEST_F(TilesAndMesa, FourSamplesDifferByAtMostAThirdOfALevel) {
  const Difference found = compare(ImageChannel::grey, 4, kFarOffLevels);
  EXPECT_LE(found.mean, 0.3);
  EXPECT_LE(found.far_off, 5e-4);
}

TEST_F(TilesAndMesa, DepthsAndLabelsDifferAtEdgesOnly) {
  std::mt19937_64 random(93);
  size_t pixels = 0, depths = 0, labels = 0;
  cv::Mat expected, drawn;
  for (int i = 0; i < 20; ++i) {
    CameraView view{vision::camera::PinholeCamera::from_fov(320, 240, 1.3), random_pose(random, 80.0, 40.0, 0.5)};
    view.channel = ImageChannel::depth;
    mesa_->draw(view, expected);
    tiles_.draw(view, drawn);
    for (size_t k = 0; k < expected.total(); ++k, ++pixels) {
      const float a = reinterpret_cast<float*>(expected.data)[k], b = reinterpret_cast<float*>(drawn.data)[k];
      const bool agree = std::isfinite(a) && std::isfinite(b) ? std::abs(a - b) <= 1e-3f * a : a == b;
      depths += agree ? 0 : 1;
    }
    view.channel = ImageChannel::labels;
    mesa_->draw(view, expected);
    tiles_.draw(view, drawn);
    labels += static_cast<size_t>(cv::countNonZero(expected != drawn));
  }
  EXPECT_LE(static_cast<double>(depths), 2e-4 * static_cast<double>(pixels));
  EXPECT_LE(static_cast<double>(labels), 2e-4 * static_cast<double>(pixels));
}

/// Returns a ball around the origin, seen from inside.
scenes::Scene hollow_ball(double radius_m) {
  SmallWorld world;
  const scenes::mesh::Polyhedron ball = scenes::mesh::ball(3);
  scenes::Mesh& mesh = world.scene.meshes.front();
  mesh = {};
  mesh.material = "opaque";
  scenes::Chunk chunk;
  for (const Eigen::Vector3d& corner : ball.corners) {
    mesh.vertices.emplace_back().p_W = (radius_m * corner).cast<float>();
    chunk.box_W.extend(mesh.vertices.back().p_W);
  }
  for (const auto& [a, b, c] : ball.faces) {
    for (const uint32_t index : {a, c, b}) mesh.indices.push_back(index);
  }
  chunk.index_count = static_cast<uint32_t>(mesh.indices.size());
  mesh.chunks = {chunk};
  return world.scene;
}

// 1,280 triangles in 10,000 random views.
TEST(Tiles, LeavesNoHolesAlongSharedEdges) {
  Renderer renderer(hollow_ball(10.0), Culling::none, RendererKind::tiles);
  std::mt19937_64 random(94);
  cv::Mat labels;
  for (int i = 0; i < 10'000; ++i) {
    const auto uniform_coordinate = [&] { return uniform(random, -5.0, 5.0); };
    CameraView view{vision::camera::PinholeCamera::from_fov(64, 48, uniform(random, 0.2, 2.5))};
    view.X_WC.translation() = Eigen::Vector3d(uniform_coordinate(), uniform_coordinate(), uniform_coordinate());
    view.X_WC.linear() =
        Eigen::Quaterniond(uniform_coordinate(), uniform_coordinate(), uniform_coordinate(), uniform_coordinate())
            .normalized()
            .toRotationMatrix();
    view.channel = ImageChannel::labels;
    renderer.draw(view, labels);
    ASSERT_EQ(cv::countNonZero(labels != 1), 0) << "view " << i;
  }
}

// Two walls meet at an upright edge within a rounding of the last column of a tile, far from the first column of the
// image. If rounding moves the edge, the wall of the next tile must be drawn in that column.
TEST(Tiles, LeavesNoHolesIfAnUprightEdgeIsRoundedAcrossTiles) {
  constexpr double kCenterPx = 2000.0;
  std::mt19937_64 random(95);
  cv::Mat labels;
  for (int i = 0; i < 4000; ++i) {
    const double focal_px = uniform(random, 150.0, 250.0), away_m = uniform(random, 3.0, 10.0);
    const double u = 4000.0 - 1.0 - 8.0 * static_cast<double>(i % 40) + uniform(random, -2e-4, 2e-4);
    SmallWorld world;
    const auto north_m = static_cast<float>(away_m), top_m = static_cast<float>(-0.2 * away_m);
    const auto width_m = static_cast<float>(20.0 * away_m + away_m * (u - kCenterPx) / focal_px);
    world.add_quad({north_m, -20 * north_m, top_m}, {0, width_m, 0}, {0, 0, -2 * top_m});
    const scenes::Vertex corner = world.scene.meshes.front().vertices.back();  // the shared edge, to the last bit
    world.add_quad(corner.p_W, {0, 10 * north_m, 0}, {0, 0, -2 * top_m});
    Renderer renderer(world.scene, Culling::none, RendererKind::tiles);
    const vision::camera::PinholeCamera camera{4000, 8, focal_px, focal_px, kCenterPx, 3.5};
    renderer.draw({camera, look_at({0, 0, 0}, {1, 0, 0}), ImageChannel::labels}, labels);
    ASSERT_EQ(cv::countNonZero(labels), static_cast<int>(labels.total())) << i;
  }
}

// The centers of pixels are exactly on an edge.
TEST(Tiles, AssignsAPixelOnAnEdgeToOneSide) {
  SmallWorld world;
  for (const float east_m : {-2.0f, -1.0f, 0.0f, 1.0f}) world.add_quad({5, east_m, -2}, {0, 1, 0}, {0, 0, 4});
  Renderer renderer(world.scene, Culling::none, RendererKind::tiles);
  cv::Mat labels;
  // Focal length 5 px at 5 m: one pixel per meter, with its center on an edge.
  renderer.draw(
      {vision::camera::PinholeCamera{5, 5, 5.0, 5.0, 2.0, 2.0}, look_at({0, 0, 0}, {1, 0, 0}), ImageChannel::labels},
      labels);
  for (int row = 0; row < 4; ++row) {
    for (int col = 1; col < 4; ++col) EXPECT_NE(labels.at<int>(row, col), 0) << row << " " << col;
  }
}

TEST(Tiles, DrawsOneOrFourSamples) {
  Renderer renderer(SmallWorld().scene, Culling::none, RendererKind::tiles);
  for (const int samples : {1, 4}) EXPECT_NO_THROW(renderer.require_samples(samples));
  for (const int samples : {0, 2, 3, 8}) EXPECT_THROW(renderer.require_samples(samples), std::invalid_argument);
}

TEST(TilesFacets, MergesTwoTrianglesOfARectangle) {
  SmallWorld world;
  world.add_box(Eigen::AlignedBox3f(Eigen::Vector3f(1, 2, -3), Eigen::Vector3f(4, 7, 0)));
  const SceneGeometry geometry = make_geometry(world.scene);
  const tiles::Facets facets = tiles::make_facets(geometry);
  EXPECT_EQ(2 * facets.shapes.size(), geometry.indices.size() / 3);
  EXPECT_EQ(facets.range(0, static_cast<uint32_t>(geometry.indices.size())).count, facets.shapes.size());
}

/// Returns a map of random steps and slopes whose size is not a multiple of the block size.
std::vector<float> random_depths(int stride, std::mt19937_64& random) {
  std::uniform_real_distribution<float> even(0.0f, 1.0f);
  std::vector<float> depths(static_cast<size_t>(stride) * static_cast<size_t>(stride), 0.0f);
  for (int patch = 0; patch < 20; ++patch) {
    const int left = static_cast<int>(even(random) * static_cast<float>(stride)),
              top = static_cast<int>(even(random) * static_cast<float>(stride));
    const float here = even(random), right = 0.01f * (even(random) - 0.5f), down = 0.01f * (even(random) - 0.5f);
    for (int y = top; y < std::min(top + 40, stride); ++y) {
      for (int x = left; x < std::min(left + 40, stride); ++x) {
        depths[static_cast<size_t>(y * stride + x)] =
            here + right * static_cast<float>(x) + down * static_cast<float>(y);
      }
    }
  }
  return depths;
}

TEST(Tiles, SunBlocksBoundEveryDepthInThem) {
  constexpr float kRounding = 4e-6f;  // margin of the reader
  std::mt19937_64 random(3);
  for (const int stride : {10, 67, 130}) {
    const std::vector<float> depths = random_depths(stride, random);
    std::vector<tiles::SunBlock> memory[tiles::SunBlocks::kLevels];
    const tiles::SunBlocks blocks = tiles::make_sun_blocks(depths.data(), stride, memory);
    for (int level = 0; level < tiles::SunBlocks::kLevels; ++level) {
      const int log2 = tiles::SunBlocks::kFirstLog2 + level;
      for (int y = 0; y < stride; ++y) {
        for (int x = 0; x < stride; ++x) {
          const float depth = depths[static_cast<size_t>(y * stride + x)];
          const tiles::SunBlock& block = blocks.levels[level][(y >> log2) * blocks.across[level] + (x >> log2)];
          ASSERT_LE(block.min_depth, depth);
          ASSERT_GE(block.max_offset + block.right * static_cast<float>(x - 1) + block.down * static_cast<float>(y - 1),
                    depth - kRounding)
              << level << ", " << x << ", " << y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
