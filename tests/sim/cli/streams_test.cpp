// Behavior of the program if its standard streams are full, closed, or no longer read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/sim/cli/ask.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;

std::string short_run(const std::filesystem::path& out) {
  return "run " HEDGEHOP_SOURCE_DIR
         "/configs/andert2007_tree_160.yaml --renderer tiles --set duration=0.1 --set 'checks=[]' --no-report "
         "--no-video --out " +
         out.string();
}

TEST(Streams, ResultThatCannotBeWrittenIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  for (const std::string& command : {std::string("list modules"), std::string("schema"), std::string("--version"),
                                     std::string("run --help"), short_run(folder.path() / "out") + " --json"}) {
    const Answer answer = ask(command + " 2>&1 >/dev/full #");
    EXPECT_EQ(answer.status, kInternalError) << command;
    EXPECT_TRUE(answer.text.ends_with("hedgehop: cannot write to standard output: No space left on device\n"))
        << command << ": " << answer.text;
  }
}

TEST(Streams, ReaderThatClosesItsPipeEndsNoFlight) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  const Answer answer = ask("--version >/dev/null; ( { " HEDGEHOP_PROGRAM " " + short_run(out) +
                            " --json; echo status $? >&3; } | : ) 3>&1");
  EXPECT_THAT(answer.text, HasSubstr("status 0\n"));
  EXPECT_TRUE(std::filesystem::exists(out / "result.json"));
}

TEST(Streams, AClosedPipeIsNoError) {
  // The output exceeds the pipe's buffer, so the program still writes after the reader has exited.
  const Answer answer =
      ask("--version >/dev/null; ( { " HEDGEHOP_PROGRAM " schema; echo status $? >&3; } | true ) 3>&1");
  EXPECT_EQ(answer.text, "status 0\n");
}

TEST(Streams, FullStandardErrorIsNoReasonToFail) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string();
  EXPECT_EQ(ask("trim " HEDGEHOP_SOURCE_DIR "/configs/vehicles/s900.yaml --plot " + page + " 2>/dev/full #").status, 0);
}

TEST(Streams, ClosedStreamsAreNoReasonToFail) {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  EXPECT_EQ(ask(short_run(out) + " <&- >&- 2>&- #").status, 0);
  EXPECT_TRUE(std::filesystem::exists(out / "result.json"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
