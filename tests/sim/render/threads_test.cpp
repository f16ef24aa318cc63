#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "tests/sim/render/osmesa.h"
#include "tests/sim/render/small_world.h"

namespace hedgehop::sim {
namespace {

/// Returns the hashes of a small city and of every example world, one line each.
std::string digest_with(const std::string& environment, const std::string& renderer = "osmesa") {
  const std::string command = environment + " " HEDGEHOP_RENDER_DIGEST " " + renderer;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 128> line{};
  std::string digests;
  while (pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr) digests += line.data();
  EXPECT_EQ(pclose(pipe), 0) << command;
  return digests;
}

/// Returns the error message.
std::string error_with(const std::string& environment, const std::string& renderer) {
  const std::string command = environment + " " HEDGEHOP_RENDER_DIGEST " " + renderer + " 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 512> line{};
  EXPECT_TRUE(pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr);
  EXPECT_NE(pclose(pipe), 0);
  return line.data();
}

TEST(Threads, NumberOfRasterizerThreadsChangesNoPixel) {
  HEDGEHOP_REQUIRE_OSMESA();
  const std::string alone = digest_with("LP_NUM_THREADS=0");
  EXPECT_EQ(std::ranges::count(alone, '\n'), 20) << alone;  // ten scenes with and without shadows
  EXPECT_EQ(digest_with("LP_NUM_THREADS=0"), alone);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=1"), alone);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=2"), alone);
  EXPECT_EQ(digest_with("env -u LP_NUM_THREADS"), alone);
}

TEST(Renderers, EglAndOsmesaDrawEqualPixelsWithTheSameRasterizer) {
  HEDGEHOP_REQUIRE_OSMESA();
  HEDGEHOP_REQUIRE_EGL();
  const std::string software = "LIBGL_ALWAYS_SOFTWARE=1";
  EXPECT_EQ(digest_with(software, "egl"), digest_with(software, "osmesa"));
}

TEST(Renderers, OsmesaAndEglInOneProcessDrawTheirOwnScenes) {
  HEDGEHOP_REQUIRE_OSMESA();
  HEDGEHOP_REQUIRE_EGL();
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", /*overwrite=*/1);
  const SmallWorld worlds[] = {small_city(5, 81), small_city(5, 82)};
  std::mt19937_64 random(83);
  const CameraView view{vision::camera::PinholeCamera::from_fov(200, 150, 1.2), random_pose(random, 80.0, 40.0, 0.8),
                        ImageChannel::color};
  const auto make = [&](size_t world, RendererKind kind) { return Renderer(worlds[world].scene, Culling::none, kind); };
  cv::Mat alone[2], drawn;
  for (size_t i = 0; i < 2; ++i) make(i, RendererKind::osmesa).draw(view, alone[i]);
  ASSERT_GT(cv::norm(alone[0], alone[1]), 0.0);
  Renderer renderers[] = {make(0, RendererKind::osmesa), make(1, RendererKind::egl)};
  for (size_t image = 0; image < 6; ++image) {
    renderers[image % 2].draw(view, drawn);
    EXPECT_EQ(cv::norm(drawn, alone[image % 2]), 0.0) << image;
  }
}

TEST(Renderers, TilesDrawsEqualPixelsWithAllKernels) {
  const std::string plain = digest_with("HEDGEHOP_TILES=plain", "tiles");
  EXPECT_EQ(std::ranges::count(plain, '\n'), 20) << plain;
  EXPECT_EQ(digest_with("env -u HEDGEHOP_TILES", "tiles"), plain);
  EXPECT_EQ(digest_with("HEDGEHOP_TILES=avx2", "tiles"), plain);
}

TEST(Renderers, TilesRejectsUnknownKernels) {
  EXPECT_THAT(error_with("HEDGEHOP_TILES=mmx", "tiles"),
              testing::AllOf(testing::HasSubstr("HEDGEHOP_TILES=mmx"), testing::HasSubstr("plain")));
}

// Reference hashes: every machine and compiler must give the same bits. Five channels, pinhole and fisheye, one and
// four samples. An intended change of the images changes them.
TEST(Renderers, TilesDrawsTheReferencePixels) {
  const std::string drawn = digest_with("env -u HEDGEHOP_TILES", "tiles");
  EXPECT_THAT(drawn, testing::HasSubstr("80367b98db3d512a small city\n"));
  EXPECT_THAT(drawn, testing::HasSubstr("b93a62d92148f9c8 small city with shadows\n"));
}

TEST(Renderers, InstructionsOfLibmAndOpenCvChangeNoPixelOfTiles) {
  EXPECT_EQ(digest_with("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA OPENCV_CPU_DISABLE=AVX2,AVX", "tiles"),
            digest_with("env -u GLIBC_TUNABLES", "tiles"));
}

TEST(Renderers, EglWithoutADriverNamesARemedy) {
  HEDGEHOP_REQUIRE_EGL();
  EXPECT_THAT(
      error_with("__EGL_VENDOR_LIBRARY_DIRS=/missing", "egl"),
      testing::AllOf(testing::HasSubstr("EGL created no OpenGL 3.3 core context"), testing::HasSubstr("libegl-mesa0")));
}

}  // namespace
}  // namespace hedgehop::sim
