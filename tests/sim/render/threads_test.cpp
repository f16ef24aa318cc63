#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

namespace hedgehop::sim {
namespace {

std::string digest_with(const std::string& environment) {
  const std::string command = environment + " " HEDGEHOP_RENDER_DIGEST;
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::array<char, 64> line{};
  const bool answered = pipe != nullptr && std::fgets(line.data(), line.size(), pipe) != nullptr;
  EXPECT_EQ(pclose(pipe), 0) << command;
  return answered ? line.data() : "";
}

TEST(Threads, RasteriserThreadsChangeNoPixel) {
  const std::string alone = digest_with("LP_NUM_THREADS=0");
  EXPECT_EQ(alone.size(), 17u);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=1"), alone);
  EXPECT_EQ(digest_with("LP_NUM_THREADS=2"), alone);
  EXPECT_EQ(digest_with("env -u LP_NUM_THREADS"), alone);
}

}  // namespace
}  // namespace hedgehop::sim
