#include "vision/mapping/depth_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "tests/vision/mapping/sky_view.h"

namespace hedgehop::vision::mapping {
namespace {

struct Found {
  int sky = 0, of_sky = 0, wrong = 0;
};

Found find(const SkyView& view) {
  const DepthBlocks blocks = view.blocks();
  Found found;
  for (int row = 0; row < blocks.rows(); ++row) {
    for (int col = 0; col < blocks.cols(); ++col) {
      const int v = row * DepthBlocks::kBlockPx + 4, u = col * DepthBlocks::kBlockPx + 4;
      const bool sky = view.is_sky[static_cast<size_t>(v * view.world.width_px + u)];
      const bool said = blocks.at(row, col).kind == DepthBlock::Kind::sky;
      found.of_sky += sky;
      found.sky += said && sky;
      // Only far ground below the horizon may be taken for sky.
      constexpr double kHorizon = 0.03;  // sine of an elevation
      const Eigen::Vector3d ray_W = view.X_WC.linear() * view.world.geometry.ray_at_unit_depth({u, v}).normalized();
      found.wrong += said && !sky && -ray_W.z() > kHorizon;
    }
  }
  return found;
}

TEST(FindSky, FindsSkyAboveFarGround) {
  const Found found = find(look({}, 4.0, {}));
  EXPECT_GT(found.of_sky, 300);
  EXPECT_GT(found.sky, 0.9 * found.of_sky);
}

/// Blocks marked as sky among untextured blocks.
int within_blank(const SkyView& view) {
  const DepthBlocks blocks = view.blocks();
  const auto is_blank = [&](int row, int col) {
    return view.is_blank[static_cast<size_t>((row * 8 + 4) * view.world.width_px + col * 8 + 4)];
  };
  int found = 0;
  for (int row = 1; row + 1 < blocks.rows(); ++row) {
    for (int col = 1; col + 1 < blocks.cols(); ++col) {
      int blank = 0;
      for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = col - 1; c <= col + 1; ++c) blank += is_blank(r, c);
      }
      found += blank == 9 && blocks.at(row, col).kind == DepthBlock::Kind::sky;
    }
  }
  return found;
}

// While banking, the image is tilted: objects above ground in the image are not above it in the world.
TEST(FindSky, TiltedCameraFindsSkyAndExcludesTowers) {
  for (const double roll_rad : {-0.4, -0.2, 0.2, 0.4}) {
    const Found open = find(look({}, 15.0, {}, -0.1, roll_rad));
    EXPECT_GT(open.of_sky, 200);
    EXPECT_GT(open.sky, 0.8 * open.of_sky) << roll_rad;
    EXPECT_EQ(open.wrong, 0) << roll_rad;
    std::ptrdiff_t tower_px = 0;
    for (const double aside_m : {-6.0, 0.0, 6.0}) {
      const Eigen::AlignedBox3d tower(Eigen::Vector3d(12.0, aside_m - 3.0, -60.0),
                                      Eigen::Vector3d(18.0, aside_m + 3.0, 0.0));
      const SkyView view = look({}, 15.0, {tower}, -0.1, roll_rad);
      // As bright as the sky: only the ground below distinguishes it.
      SkyView like = view;
      like.grey.setTo(kSkyGrey, like.grey == kBoxGrey);
      EXPECT_EQ(within_blank(like), 0) << roll_rad << " " << aside_m;
      tower_px += std::ranges::count(view.is_blank, true);
    }
    EXPECT_GT(tower_px, 10'000);
  }
}

// A view so wide and steep that image rows are parallel to vertical planes.
TEST(FindSky, InAWideSteepViewOnlySkyIsSky) {
  MappedWorld world;
  world.geometry.focal_px = 60.0;
  for (const double pitch_rad : {-0.75, 0.75}) EXPECT_EQ(find(look(world, 4.0, {}, pitch_rad)).wrong, 0) << pitch_rad;
}

TEST(FindSky, UntexturedWallIsNotSky) {
  for (const double ahead_m : {3.0, 6.0, 10.0, 15.0}) {
    for (const double high_m : {6.0, 30.0}) {
      const Eigen::AlignedBox3d wall(Eigen::Vector3d(ahead_m, -3.0, -high_m), Eigen::Vector3d(ahead_m + 1.0, 3.0, 0.0));
      EXPECT_EQ(find(look({}, 4.0, {wall})).wrong, 0) << ahead_m << " " << high_m;
    }
  }
}

// If a tall untextured wall fills the view, only its ground distinguishes it from sky. From a high vehicle with the
// nose down, the wall's base is far below the axis, at larger z in C than the wall above.
TEST(FindSky, FreeRangeOfSkyIsLimitedByItsGround) {
  struct Flight {
    double wall_m, height_m, pitch_rad;
  };
  for (const auto& [wall_m, height_m, pitch_rad] : {Flight{40.0, 4.0, 0.0}, {26.0, 15.0, -0.2}, {26.0, 15.0, -0.35}}) {
    const Eigen::AlignedBox3d wall(Eigen::Vector3d(wall_m, -90.0, -90.0), Eigen::Vector3d(wall_m + 1.0, 90.0, 0.0));
    const SkyView view = look({}, height_m, {wall}, pitch_rad);
    const DepthBlocks blocks = view.blocks();
    int passed = 0;
    for (int row = 0; row < blocks.rows(); ++row) {
      for (int col = 0; col < blocks.cols(); ++col) {
        if (blocks.at(row, col).kind != DepthBlock::Kind::sky) continue;
        ++passed;
        const cv::Point middle(col * DepthBlocks::kBlockPx + 4, row * DepthBlocks::kBlockPx + 4);
        const Eigen::Vector3d off_W = view.X_WC.linear() * view.world.geometry.ray_at_unit_depth(middle) *
                                      view.world.geometry.z_m(blocks.at(row, col).foot16);
        constexpr double kRounding = 1.06;
        EXPECT_LT(off_W.x(), kRounding * wall_m) << row << " " << col;
      }
    }
    EXPECT_GT(passed, 0) << pitch_rad;  // otherwise the test would be vacuous
  }
}

/// A textured wall across the left half of the view, with sky above it: ground is far only on the right.
MappedWorld walled(double ahead_m) {
  MappedWorld world;
  world.boxes_W.emplace_back(Eigen::Vector3d(ahead_m, -90.0, -7.0), Eigen::Vector3d(ahead_m + 1.0, 0.0, 0.0));
  return world;
}

TEST(FindSky, FindsSkyAboveAWallWithTheRangeOfTheWall) {
  constexpr double kWallM = 19.0;
  const SkyView view = look(walled(kWallM), 4.0, {});
  const Found found = find(view);
  EXPECT_GT(found.sky, 0.9 * found.of_sky);
  EXPECT_EQ(found.wrong, 0);
  const DepthBlocks blocks = view.blocks();
  for (int row = 0; row < blocks.rows() / 4; ++row) {
    for (int col = 0; col < blocks.cols() / 2 - 1; ++col) {
      EXPECT_LT(view.world.geometry.z_m(blocks.at(row, col).foot16), kWallM + 0.5) << row << " " << col;
    }
  }
}

// An untextured slab in front of a wall reaches the image's upper border, like the sky next to it.
TEST(FindSky, UntexturedSlabInFrontOfAWallIsNotSky) {
  for (const double ahead_m : {3.0, 6.0, 10.0}) {
    const Eigen::AlignedBox3d slab(Eigen::Vector3d(ahead_m, -90.0, -60.0), Eigen::Vector3d(ahead_m + 1.0, -0.5, -4.5));
    EXPECT_EQ(find(look(walled(19.0), 4.0, {slab})).wrong, 0) << ahead_m;
  }
}

// Only its brightness distinguishes a ceiling over a far wall from sky, so that sky is required for comparison.
TEST(FindSky, FindsNoSkyAboveWallsOnAllSides) {
  MappedWorld world;
  world.boxes_W.emplace_back(Eigen::Vector3d(17.0, -90.0, -7.0), Eigen::Vector3d(18.0, 90.0, 0.0));
  const Found found = find(look(world, 4.0, {}));
  EXPECT_EQ(found.sky + found.wrong, 0);
}

TEST(FindSky, UntexturedWallAcrossTheViewIsNotSky) {
  const Eigen::AlignedBox3d wall(Eigen::Vector3d(8.0, -90.0, -90.0), Eigen::Vector3d(9.0, 90.0, 0.0));
  EXPECT_EQ(find(look({}, 4.0, {wall})).wrong, 0);
}

// Matchers occasionally match pixels on untextured walls. Such matches are not ground.
TEST(FindSky, MatchesOnAnUntexturedWallAreNotGround) {
  constexpr double kNoiseM = 40.0;
  for (const double wall_m : {4.0, 6.0, 8.0}) {
    const Eigen::AlignedBox3d wall(Eigen::Vector3d(wall_m, -90.0, -90.0), Eigen::Vector3d(wall_m + 1.0, 90.0, 0.0));
    SkyView view = look({}, 4.0, {wall});
    const int horizon_px = view.world.height_px / 2;
    const auto noise16 = static_cast<double>(std::lround(view.world.geometry.disparity16(kNoiseM)));
    view.disparity16.rowRange(horizon_px + 8, horizon_px + 24).setTo(noise16);
    EXPECT_EQ(find(view).sky + find(view).wrong, 0) << wall_m;
  }
}

TEST(FindSky, UntexturedBoxInTheAirIsNotSky) {
  for (const double above_m : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
    const Eigen::Vector3d middle_W(6.0, 0.5, -4.0 - above_m);
    const Eigen::AlignedBox3d box(middle_W - Eigen::Vector3d(0.5, 0.8, 0.8), middle_W + Eigen::Vector3d(0.5, 0.8, 0.8));
    EXPECT_EQ(find(look({}, 4.0, {box})).wrong, 0) << above_m;
  }
}

TEST(FindSky, FindsNoSkyIfOnlyCloseGroundIsMatched) {
  SkyView view = look({}, 4.0, {});
  view.disparity16.setTo(stereo::kNoDisparity, view.disparity16 < view.world.geometry.disparity16(15.0));  // as in fog
  EXPECT_EQ(find(view).sky, 0);
}

/// Darkens the sky in a part of an image.
void draw_before_sky(SkyView& view, const cv::Rect& part, int grey) {
  for (int v = part.y; v < part.br().y; ++v) {
    for (int u = part.x; u < part.br().x; ++u) {
      const bool sky = view.is_sky[static_cast<size_t>(v * view.world.width_px + u)];
      if (sky) view.grey.at<uint8_t>(v, u) = static_cast<uint8_t>(grey);
    }
  }
}

// An unmatched pole, and a wire just above the horizon, one pixel wide: not sky, without effect on the adjacent sky.
TEST(FindSky, ThinObjectInFrontOfSkyIsALine) {
  const SkyView open = look({}, 4.0, {});
  const Found before = find(open);
  const int horizon_px = static_cast<int>(open.world.geometry.center_v_px);
  for (const cv::Rect& thin : {cv::Rect(161, 0, 1, horizon_px), cv::Rect(0, horizon_px - 12, 320, 1)}) {
    for (const int grey : {0, kSkyGrey - 40}) {
      SkyView view = open;
      view.grey = open.grey.clone();
      draw_before_sky(view, thin, grey);
      const DepthBlocks blocks = view.blocks();
      int crossed = 0, lines = 0;
      for (int row = 0; row < blocks.rows(); ++row) {
        for (int col = 0; col < blocks.cols(); ++col) {
          const cv::Rect block(8 * col, 8 * row, 8, 8);
          const bool is_crossed = !(block & thin).empty() && (block & thin).area() >= 8 && block.br().y < horizon_px;
          const bool is_line = blocks.at(row, col).kind == DepthBlock::Kind::line;
          crossed += is_crossed;
          lines += is_line;
          EXPECT_TRUE((block & thin).area() > 0 || !is_line) << row << ' ' << col;
          EXPECT_FALSE(is_crossed && blocks.at(row, col).kind == DepthBlock::Kind::sky) << row << ' ' << col;
        }
      }
      const bool upright = thin.width == 1;
      // A column may contain three blocks of a line: for a pole, the lowest part at the vehicle's altitude.
      EXPECT_GE(lines, upright ? 3 : crossed) << grey;
      EXPECT_GE(find(view).sky, before.sky - crossed) << grey;
    }
  }
}

TEST(FindSky, CameraNoiseIsNotALine) {
  SkyView view = look({}, 4.0, {});
  const Found before = find(view);
  cv::Mat noise(view.grey.size(), CV_16SC1), noisy;
  cv::RNG generator(1);
  constexpr double kSigma = 4.0;  // grey levels; of a sensor in daylight less
  generator.fill(noise, cv::RNG::NORMAL, 0.0, kSigma);
  view.grey.convertTo(noisy, CV_16SC1);
  noisy += noise;
  noisy.convertTo(view.grey, CV_8UC1);
  EXPECT_EQ(view.blocks().share(DepthBlock::Kind::line), 0.0);
  EXPECT_GT(find(view).sky, 0.9 * before.sky);
}

}  // namespace
}  // namespace hedgehop::vision::mapping
