#include "sim/batch/record.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "sim/batch/seeds.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

TEST(Seeds, RangesIncludeBothEndsAndKeepTheirOrder) {
  EXPECT_EQ(parse_seeds("3"), (std::vector<uint64_t>{3}));
  EXPECT_EQ(parse_seeds("7,1:3"), (std::vector<uint64_t>{7, 1, 2, 3}));
  EXPECT_EQ(parse_seeds("18446744073709551614:18446744073709551615").size(), 2u);
}

TEST(Seeds, RejectsTextsThatAreNotListsOfSeeds) {
  for (const char* text : {"", "1:", ":3", "a", "3:1", "1,1", "1:3,2", "1,,2", "-1", "1.5", "1:2:3", "0:99999999"}) {
    EXPECT_THROW(parse_seeds(text), InputError) << text;
  }
}

TEST(JudgingSeeds, AreDisjointFromTheTuningSeeds) {
  std::mt19937_64 generator(3);
  const auto range = [&](uint64_t& first, uint64_t& last) {
    first = generator() % 20;
    last = first + generator() % 8;
    return std::to_string(first) + ":" + std::to_string(last);
  };
  for (int i = 0; i < 300; ++i) {
    uint64_t a = 0, b = 0, c = 0, d = 0;
    const std::string tuned = range(a, b), judging = range(c, d);
    EXPECT_EQ(judging_fault(tuned, judging).empty(), b < c || d < a) << tuned << " " << judging;
    EXPECT_EQ(within(judging, tuned), a <= c && d <= b) << tuned << " " << judging;
  }
  EXPECT_EQ(judging_fault("none", "1:3"), "");
  EXPECT_NE(judging_fault({}, "1:3"), "");
  EXPECT_NE(judging_fault("some", "1:3"), "");
}

TEST(ShellQuoted, ShellReadsBackTheSameWord) {
  std::mt19937_64 generator(7);
  const std::string letters = "ab7 '\"\\$`*?;&|<>(){}[]!#~=\t%\n\xe9\x1b\x7f";
  for (int i = 0; i < 50; ++i) {
    std::string word;
    for (uint64_t length = generator() % 12; length > 0; --length) word += letters[generator() % letters.size()];
    FILE* const shell = popen(("printf '%s.' " + shell_quoted(word)).c_str(), "r");
    ASSERT_NE(shell, nullptr);
    std::string read;
    for (int c = fgetc(shell); c != EOF; c = fgetc(shell)) read += static_cast<char>(c);
    pclose(shell);
    EXPECT_EQ(read, word + ".");
  }
}

}  // namespace
}  // namespace hedgehop::sim
