#include "vision/mapping/distance_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hedgehop::vision::mapping {
namespace {

TEST(DistanceField, EqualsBruteForceOnRandomGrids) {
  constexpr float kFloat = 1e-4F;
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const int rows = 1 + static_cast<int>(random() % 30), cols = 1 + static_cast<int>(random() % 30);
    std::vector<uint8_t> marked(static_cast<size_t>(rows * cols));
    for (uint8_t& m : marked) m = random() % 20 == 0;
    marked[random() % marked.size()] = 1;
    DistanceField field;
    field.build(marked, rows, cols);
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < cols; ++c) {
        double least = 1e9;
        for (int i = 0; i < rows * cols; ++i) {
          if (marked[static_cast<size_t>(i)]) least = std::min(least, std::hypot(r - i / cols, c - i % cols));
        }
        ASSERT_NEAR(field.at(r, c), least, kFloat) << trial;
      }
    }
  }
}

TEST(DistanceField, IsFarWithoutMarkedCells) {
  DistanceField field;
  field.build(std::vector<uint8_t>(12, 0), 3, 4);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) EXPECT_GE(field.at(r, c), DistanceField::kFar);
  }
}

}  // namespace
}  // namespace hedgehop::vision::mapping
