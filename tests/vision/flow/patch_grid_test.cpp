#include "vision/flow/patch_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace hedgehop::vision::flow {
namespace {

TEST(PatchGrid, PaperGridKeepsItsMarginAndSize) {
  const PatchGrid grid = make_patch_grid(16, 16, 64, 28, 2, 400, 400);
  ASSERT_EQ(grid.rows.size(), 16u);
  ASSERT_EQ(grid.cols.size(), 16u);
  EXPECT_EQ(grid.cols.front().begin, 28);
  EXPECT_EQ(grid.cols.back().end, 372);
  for (const PatchRange& range : grid.cols) EXPECT_EQ(range.end - range.begin, 64);
  // Patch centers then span the paper's useful field of about 70 degrees (f = 200 px).
  const double half = grid.cols.back().center() - 199.5;
  EXPECT_NEAR(2.0 * std::atan(half / 200.0) * 180.0 / M_PI, 70.0, 1.0);
}

TEST(PatchGrid, IsSymmetricAndEvenlySpacedForRandomLayouts) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 300; ++trial) {
    const int alignment = 1 << (random() % 3);
    const int unit = 2 * alignment;
    const int width = unit * static_cast<int>(20 + random() % 150), patch = unit * static_cast<int>(1 + random() % 8);
    const int margin = static_cast<int>(random() % 16), count = static_cast<int>(1 + random() % 20);
    if (width - patch - 2 * (margin + unit) < 0) continue;
    const auto cols = make_patch_grid(1, count, patch, margin, alignment, width, 800).cols;
    ASSERT_EQ(cols.size(), static_cast<size_t>(count));
    const double spacing = count > 1 ? (cols.back().center() - cols.front().center()) / (count - 1) : 0.0;
    for (size_t i = 0; i < cols.size(); ++i) {
      EXPECT_GE(cols[i].begin, margin);
      EXPECT_LE(cols[i].end, width - margin);
      EXPECT_EQ(cols[i].begin % unit, 0);
      EXPECT_NEAR(cols[i].center(), cols.front().center() + spacing * static_cast<double>(i), unit);
      const double mirrored = cols[i].center() + cols[cols.size() - 1 - i].center();
      // A single center patch may be off by half a step if the image has no center step.
      EXPECT_NEAR(mirrored, width - 1, 2 * i + 1 == cols.size() ? unit : 1e-9);
    }
  }
}

TEST(PatchGrid, OneRowIsCentered) {
  const PatchGrid grid = make_patch_grid(1, 8, 64, 28, 2, 400, 400);
  ASSERT_EQ(grid.rows.size(), 1u);
  EXPECT_EQ(grid.rows[0].center(), 199.5);
}

TEST(PatchGrid, RefusesPatchesThatDoNotFit) {
  EXPECT_THROW(make_patch_grid(2, 2, 64, 0, 1, 63, 100), std::invalid_argument);
  EXPECT_THROW(make_patch_grid(2, 2, 64, 20, 1, 100, 100), std::invalid_argument);
  EXPECT_THROW(make_patch_grid(0, 2, 16, 0, 1, 100, 100), std::invalid_argument);
}

TEST(PatchGrid, ReducedPatchesCoverTheSameArea) {
  const PatchGrid grid = make_patch_grid(6, 7, 32, 8, 1, 200, 160);
  const PatchGrid half = reduce_patch_grid(grid, 2, 0, 100, 80);
  for (size_t i = 0; i < grid.cols.size(); ++i) {
    // A reduced pixel i is at 2 i + 0.5; columns may move to the next even reduced pixel.
    EXPECT_NEAR(2.0 * half.cols[i].center() + 0.5, grid.cols[i].center(), 2.0);
    EXPECT_EQ(half.cols[i].begin % 2, 0);
    EXPECT_EQ(half.cols[i].end - half.cols[i].begin, 16);
  }
  for (size_t i = 0; i < grid.rows.size(); ++i) {
    EXPECT_NEAR(2.0 * half.rows[i].center() + 0.5, grid.rows[i].center(), 1.0);
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
