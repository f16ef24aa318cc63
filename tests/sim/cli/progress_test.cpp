// Progress output on a terminal (a pseudo-terminal of a given width).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <regex>
#include <string>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim::cli {
namespace {

/// Returns the output of a command on a terminal with the given number of columns.
std::string on_terminal(const std::string& command, unsigned short columns) {
  winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  }
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; (n = ::read(terminal, part.data(), part.size())) > 0;)
    text.append(part.data(), static_cast<size_t>(n));
  ::close(terminal);
  ::waitpid(child, nullptr, 0);
  return text;
}

TEST(Progress, LineOfAFlightFitsANarrowTerminalAndShowsTheRemainingTime) {
  const TemporaryFolder folder;
  const std::string command =
      HEDGEHOP_PROGRAM
      " run " HEDGEHOP_SOURCE_DIR
      "/configs/andert2007_tree_160.yaml --renderer tiles --set name=a_name_that_is_longer_than_the_line "
      "--set duration=3 --set 'checks=[]' --no-report --no-video --json --out " +
      folder.path().string() + "/out >/dev/null";
  EXPECT_THAT(on_terminal(command, 200), testing::ContainsRegex(": [0-9]+ of [0-9]+ s, at most [0-9]+ s left"));
  const std::string narrow = on_terminal(command, 50);
  const std::regex redrawn("\r\033\\[K([^\r\n]*)");
  size_t lines = 0;
  for (std::sregex_iterator match(narrow.begin(), narrow.end(), redrawn), end; match != end; ++match, ++lines) {
    if ((*match)[1].str().starts_with("warning: ")) continue;  // a line of its own, after the progress
    EXPECT_LT((*match)[1].length(), 50) << (*match)[1];
  }
  EXPECT_GT(lines, 1u);
}

TEST(Progress, CampaignEndsWithTheNumberOfFlownFlightsAndTheirWallTime) {
  const CampaignFolder folder;
  const auto progress = [&](const std::string& seeds) {
    const CommandEnd end = folder.hedgehop("batch tiny.yaml --resume --no-report --out out --seeds " + seeds);
    EXPECT_EQ(end.status, 0) << end.err;
    return end.err;
  };
  EXPECT_THAT(progress("1:2"), testing::ContainsRegex("\n2/2, 2 flown in [0-9]+ s\n"));
  EXPECT_THAT(progress("1:3"), testing::ContainsRegex("\n3/3, 1 flown in [0-9]+ s\n"));
  EXPECT_THAT(progress("1:3"), testing::Not(testing::HasSubstr("flown in")));
}

}  // namespace
}  // namespace hedgehop::sim::cli
