// Behavior of the program if its standard streams are full, closed, or no longer read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/sim/cli/ask.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

constexpr int kInternalError = 3;

std::string short_run(const std::string& folder) {
  return "run " HEDGEHOP_SOURCE_DIR
         "/configs/andert2007_tree_160.yaml --renderer tiles --set duration=0.1 --set 'checks=[]' --no-report "
         "--no-video --out " +
         folder;
}

std::string fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("streams_" + name);
  std::filesystem::remove_all(folder);
  return folder.string();
}

TEST(Streams, ResultThatCannotBeWrittenIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const std::string& command : {std::string("list modules"), std::string("schema"), std::string("--version"),
                                     std::string("run --help"), short_run(fresh_folder("full")) + " --json"}) {
    const Answer answer = ask(command + " 2>&1 >/dev/full #");
    EXPECT_EQ(answer.status, kInternalError) << command;
    EXPECT_TRUE(answer.text.ends_with("hedgehop: cannot write to standard output: No space left on device\n"))
        << command << ": " << answer.text;
  }
}

TEST(Streams, ReaderThatClosesItsPipeEndsNoFlight) {
  const std::string folder = fresh_folder("pipe");
  // The status is passed through the second descriptor, not through the pipe.
  const Answer answer = ask(short_run(folder) + " --json | true; test -s " + folder + "/result.json && echo written");
  EXPECT_THAT(answer.text, HasSubstr("written"));
}

TEST(Streams, AClosedPipeIsNoError) {
  // The output exceeds the pipe's buffer, so the program still writes after the reader has exited.
  const Answer answer =
      ask("--version >/dev/null; ( { " HEDGEHOP_PROGRAM " schema; echo status $? >&3; } | true ) 3>&1");
  EXPECT_EQ(answer.text, "status 0\n");
}

TEST(Streams, FullStandardErrorIsNoReasonToFail) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string page = fresh_folder("page");
  EXPECT_EQ(ask("trim " HEDGEHOP_SOURCE_DIR "/configs/vehicles/s900.yaml --plot " + page + " 2>/dev/full #").status, 0);
}

TEST(Streams, ClosedStreamsAreNoReasonToFail) {
  const std::string folder = fresh_folder("closed");
  EXPECT_EQ(ask(short_run(folder) + " <&- >&- 2>&- #").status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder + "/result.json"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
