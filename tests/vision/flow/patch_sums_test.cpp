#include "vision/flow/patch_grid.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

namespace hedgehop::vision::flow {
namespace {

std::vector<int16_t> random_pixels(int count, int largest, std::mt19937_64& random) {
  std::uniform_int_distribution<int> number(-largest, largest);
  std::vector<int16_t> image;
  for (int i = 0; i < count; ++i) image.push_back(static_cast<int16_t>(number(random)));
  return image;
}

TEST(PatchSums, EqualSumsPixelByPixelForRandomPatches) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const int width = 8 * static_cast<int>(2 + random() % 8), height = static_cast<int>(10 + random() % 60);
    const auto a = random_pixels(width * height, 4080, random), b = random_pixels(width * height, 4080, random);
    std::vector<PatchRange> rows, cols;
    for (size_t i = 0; i < 1 + random() % 6; ++i) {
      const int begin = static_cast<int>(random() % static_cast<uint64_t>(height - 4));
      rows.push_back({begin, begin + 1 + static_cast<int>(random() % static_cast<uint64_t>(height - begin))});
    }
    for (size_t i = 0; i < 1 + random() % 6; ++i) {
      const int begin = 2 * static_cast<int>(random() % static_cast<uint64_t>(width / 2 - 1));
      cols.push_back(
          {begin, begin + 2 * (1 + static_cast<int>(random() % static_cast<uint64_t>((width - begin) / 2)))});
    }
    PatchSums sums(rows, cols, width, height, 2);
    sums.begin();
    for (int y = sums.first_row(); y < sums.end_row(); ++y) {
      sums.add(0, &a[static_cast<size_t>(y * width)], &b[static_cast<size_t>(y * width)]);
      sums.add(1, &b[static_cast<size_t>(y * width)], &b[static_cast<size_t>(y * width)]);
      sums.next_row();
    }
    for (size_t r = 0; r < rows.size(); ++r) {
      for (size_t c = 0; c < cols.size(); ++c) {
        int64_t ab = 0, bb = 0;
        for (int y = rows[r].begin; y < rows[r].end; ++y) {
          for (int x = cols[c].begin; x < cols[c].end; ++x) {
            const auto i = static_cast<size_t>(y * width + x);
            ab += static_cast<int64_t>(a[i]) * b[i];
            bb += static_cast<int64_t>(b[i]) * b[i];
          }
        }
        ASSERT_EQ(sums.sum(0, static_cast<int>(r), static_cast<int>(c)), ab);
        ASSERT_EQ(sums.sum(1, static_cast<int>(r), static_cast<int>(c)), bb);
      }
    }
  }
}

TEST(PatchSums, StayExactWhenRunningColumnSumsWrap) {
  // 600 rows of the largest products exceed 32 bits many times; a patch of 64 rows does not.
  const int width = 16, height = 600;
  const std::vector<int16_t> line(width, int16_t{4080});
  const std::vector<PatchRange> rows = {{500, 564}}, first = {{0, 64}}, cols = {{0, 16}};
  const std::vector<PatchRange> both = {first[0], rows[0]};
  PatchSums sums(both, cols, width, height, 1);
  sums.begin();
  for (int y = sums.first_row(); y < sums.end_row(); ++y) {
    sums.add(0, line.data(), line.data());
    sums.next_row();
  }
  const int64_t expected = int64_t{4080} * 4080 * 64 * 16;
  EXPECT_EQ(sums.sum(0, 0, 0), expected);
  EXPECT_EQ(sums.sum(0, 1, 0), expected);
}

TEST(PatchSums, RefuseOddColumnsAndPatchesOutside) {
  const std::vector<PatchRange> rows = {{0, 4}}, cols = {{0, 4}}, odd = {{1, 5}}, outside = {{0, 40}}, none;
  EXPECT_THROW(PatchSums(rows, odd, 16, 8, 1), std::invalid_argument);
  EXPECT_THROW(PatchSums(rows, outside, 16, 8, 1), std::invalid_argument);
  EXPECT_THROW(PatchSums(outside, cols, 16, 8, 1), std::invalid_argument);
  EXPECT_THROW(PatchSums(none, cols, 16, 8, 1), std::invalid_argument);
  EXPECT_THROW(PatchSums(rows, cols, 15, 8, 1), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::vision::flow
