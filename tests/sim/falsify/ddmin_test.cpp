#include "sim/falsify/ddmin.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace hedgehop::sim {
namespace {

/// Returns the number of trials that reduce eight items to the required ones.
size_t trials(const Subset& needed) {
  size_t count = 0;
  const Subset left = ddmin(8, [&](const Subset& items) {
    ++count;
    return std::ranges::includes(items, needed);
  });
  EXPECT_EQ(left, needed);
  return count;
}

/// The reference values were counted with a second implementation.
TEST(Ddmin, NumberOfTrialsMatchesAnIndependentImplementation) {
  EXPECT_EQ(trials({3}), 6u);
  EXPECT_EQ(trials({2, 7}), 15u);
  EXPECT_EQ(trials({1, 4, 6}), 26u);
  EXPECT_EQ(trials({0, 1, 2, 3, 4, 5, 6, 7}), 26u);
}

TEST(Ddmin, RemovesEveryItemIfTheEmptySetFails) {
  EXPECT_EQ(trials({}), 4u);
  EXPECT_THAT(ddmin(0, [](const Subset&) { return true; }), ::testing::IsEmpty());
}

/// Each result fails, and passes without any one of its items. This also holds if failing is not monotone.
TEST(Ddmin, ResultIsOneMinimal) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const unsigned salt = random();
    const auto fails = [&](const Subset& items) {
      size_t hash = salt;
      for (const size_t item : items) hash = hash * 31 + item * item + 7;
      return items.size() == 9 || (hash / 7) % 3 == 0;
    };
    const Subset left = ddmin(9, fails);
    ASSERT_TRUE(fails(left));
    for (size_t i = 0; i < left.size(); ++i) {
      Subset fewer = left;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      ASSERT_FALSE(fails(fewer));
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
