#include "sim/flight/words.h"

#include <gtest/gtest.h>

namespace hedgehop::sim {
namespace {

TEST(Words, CountsHaveTheirPlural) {
  EXPECT_EQ(counted(0, "flight"), "0 flights");
  EXPECT_EQ(counted(1, "flight"), "1 flight");
  EXPECT_EQ(counted(2, "YAML file"), "2 YAML files");
}

TEST(Words, ANumberThatIsPrintedAsZeroHasNoSign) {
  EXPECT_EQ(decimals(-0.004, 2), "0.00");
  EXPECT_EQ(decimals(-0.006, 2), "-0.01");
  EXPECT_EQ(decimals(-0.4, 0), "0");
  EXPECT_EQ(decimals(-10.0, 0), "-10");
  EXPECT_EQ(decimals(1.25, 4), "1.2500");
}

TEST(Words, LastLineIsNotEmpty) {
  EXPECT_EQ(last_line("notice\n4711;alpha\r\n\n"), "4711;alpha");
  EXPECT_EQ(last_line("10 %\r20 %"), "20 %");
  EXPECT_EQ(last_line("\n"), "");
}

}  // namespace
}  // namespace hedgehop::sim
