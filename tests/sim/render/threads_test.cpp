#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace hedgehop::sim {
namespace {

/// Digests of a small city and every example world, a line each.
std::string digest_with(const std::string& environment, const std::string& context = "osmesa") {
  const std::string command = environment + " " HEDGEHOP_RENDER_DIGEST " " + context;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 128> line{};
  std::string digests;
  while (pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr) digests += line.data();
  EXPECT_EQ(pclose(pipe), 0) << command;
  return digests;
}

/// The line with which it fails to draw.
std::string refusal_with(const std::string& environment, const std::string& context) {
  const std::string command = environment + " " HEDGEHOP_RENDER_DIGEST " " + context + " 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 512> line{};
  EXPECT_TRUE(pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr);
  EXPECT_NE(pclose(pipe), 0);
  return line.data();
}

TEST(Threads, RasterizerThreadsChangeNoPixel) {
  const std::string alone = digest_with("LP_NUM_THREADS=0");
  EXPECT_EQ(std::ranges::count(alone, '\n'), 20) << alone;  // ten scenes, with shadows and without
  EXPECT_EQ(digest_with("LP_NUM_THREADS=0"), alone);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=1"), alone);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=2"), alone);
  EXPECT_EQ(digest_with("env -u LP_NUM_THREADS"), alone);
}

TEST(Contexts, EglDrawsTheSamePixelsAsOsmesaWithTheSameRasterizer) {
  const std::string software = "LIBGL_ALWAYS_SOFTWARE=1";
  EXPECT_EQ(digest_with(software, "egl"), digest_with(software, "osmesa"));
}

TEST(Contexts, TilesDrawTheSamePixelsWithAndWithoutVectors) {
  const std::string plain = digest_with("HEDGEHOP_TILES=plain", "tiles");
  EXPECT_EQ(std::ranges::count(plain, '\n'), 20) << plain;
  EXPECT_EQ(digest_with("env -u HEDGEHOP_TILES", "tiles"), plain);
  EXPECT_EQ(digest_with("HEDGEHOP_TILES=avx2", "tiles"), plain);
}

TEST(Contexts, TilesRefuseKernelsThatThisProcessorHasNot) {
  EXPECT_THAT(refusal_with("HEDGEHOP_TILES=mmx", "tiles"),
              testing::AllOf(testing::HasSubstr("HEDGEHOP_TILES=mmx"), testing::HasSubstr("plain")));
}

// Kept, so that every machine and compiler is held to the same bits: five channels, a pinhole and a fisheye, one sample
// and four. An intended change of the images changes them.
TEST(Contexts, TilesDrawThePixelsThatAreKept) {
  const std::string drawn = digest_with("env -u HEDGEHOP_TILES", "tiles");
  EXPECT_THAT(drawn, testing::HasSubstr("80367b98db3d512a small city\n"));
  EXPECT_THAT(drawn, testing::HasSubstr("b93a62d92148f9c8 small city with shadows\n"));
}

TEST(Contexts, TilesLeaveTheChoiceOfMathLibrarysInstructionsNoInfluence) {
  EXPECT_EQ(digest_with("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA OPENCV_CPU_DISABLE=AVX2,AVX", "tiles"),
            digest_with("env -u GLIBC_TUNABLES", "tiles"));
}

TEST(Contexts, EglWithoutADriverIsRefusedWithTheRemedy) {
  EXPECT_THAT(
      refusal_with("__EGL_VENDOR_LIBRARY_DIRS=/nowhere", "egl"),
      testing::AllOf(testing::HasSubstr("no OpenGL 3.3 core context from EGL"), testing::HasSubstr("libegl-mesa0")));
}

}  // namespace
}  // namespace hedgehop::sim
