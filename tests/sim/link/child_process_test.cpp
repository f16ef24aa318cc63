#include "sim/link/child_process.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "sim/config/input_error.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::link {
namespace {

class ChildProcessTest : public testing::Test {
 protected:
  std::unique_ptr<ChildProcess> start(const std::vector<std::string>& command) const {
    return std::make_unique<ChildProcess>(command, out_ / "work", out_ / "log");
  }
  std::string log() const {
    std::ifstream stream(out_ / "log");
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static void wait(const ChildProcess& child) {
    pollfd watched{.fd = child.descriptor(), .events = POLLIN, .revents = 0};
    ASSERT_EQ(::poll(&watched, 1, 60'000), 1);
  }
  TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path();
};

TEST_F(ChildProcessTest, RunsInItsFolderAndWritesItsLog) {
  const auto child = start({"sh", "-c", "pwd; echo fault >&2; exit 7"});
  wait(*child);
  EXPECT_TRUE(child->ended());
  EXPECT_EQ(child->end_words(), "exit status 7");
  EXPECT_EQ(log(), std::filesystem::canonical(out_ / "work").string() + "\nfault\n");
}

TEST_F(ChildProcessTest, ProgramThatIsMissingIsABadInput) {
  try {
    start({"no_such_autopilot", "-I", "0"});
    FAIL() << "it started";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "link.command: 'no_such_autopilot' cannot be started: No such file or directory");
  }
}

TEST_F(ChildProcessTest, EndsWithItsWholeGroup) {
  auto child = start({"sh", "-c", "sleep 1000 & echo $!; wait"});
  pid_t grandchild = 0;
  while (grandchild == 0) std::ifstream(out_ / "log") >> grandchild;
  const Descriptor process(static_cast<int>(::syscall(SYS_pidfd_open, grandchild, 0)));
  pollfd watched{.fd = process.number(), .events = POLLIN, .revents = 0};
  ASSERT_EQ(::poll(&watched, 1, 0), 0);  // it runs
  child.reset();
  EXPECT_EQ(::poll(&watched, 1, 60'000), 1);  // readable at its end
}

TEST_F(ChildProcessTest, NameOfASignalIsReported) {
  const auto child = start({"sh", "-c", "kill -SEGV $$"});
  wait(*child);
  EXPECT_EQ(child->end_words(), "SIGSEGV");
}

TEST(FilledCommand, ReplacesEveryPlace) {
  EXPECT_EQ(filled_command({"arducopter", "-I", "{instance}", "--x={port}:{port}:{seed}"}, 3, 9032, 17),
            (std::vector<std::string>{"arducopter", "-I", "3", "--x=9032:9032:17"}));
}

}  // namespace
}  // namespace hedgehop::sim::link
