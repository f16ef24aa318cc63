// Campaigns that are killed, or whose workers are killed, and then resumed. No result may be lost or differ.
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <sstream>

#include "tests/sim/disk/small_campaign.h"

extern char** environ;

namespace hedgehop::sim {
namespace {

using ::testing::IsEmpty;

class Killed : public ::testing::TestWithParam<std::string_view> {
 protected:
  /// Returns the names of incomplete files in `out`.
  std::vector<std::string> incomplete_files() const {
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator at(folder.path() / "out", error), end; at != end; ++at) {
      if (at->path().extension() == ".part") names.push_back(at->path().string());
    }
    return names;
  }
  /// Resumes the killed campaign in `out`, expects the files of an undisturbed campaign and removes the folder.
  void resume(const std::map<std::string, std::string>& whole, const std::string& killed) {
    const CommandEnd end = folder.hedgehop(folder.arguments(GetParam(), "out", 2));
    EXPECT_EQ(end.status, SmallCampaign::status(GetParam())) << killed << ": " << end.err;
    std::vector<std::string> different = differences(whole, folder.lasting_files("out"));
    // A batch that stops at a claim discards the flights past its stop, but their files may remain.
    if (GetParam() == "until") std::erase_if(different, [&](const auto& name) { return !whole.contains(name); });
    EXPECT_THAT(different, IsEmpty()) << killed;
    EXPECT_THAT(incomplete_files(), IsEmpty()) << killed;
    std::filesystem::remove_all(folder.path() / "out");
  }
  SmallCampaign folder;
  std::mt19937_64 random{1};
};

TEST_P(Killed, BeforeAnyFileCallLosesNoResults) {
  const auto whole = folder.fly_undisturbed(GetParam());
  const uint64_t calls = folder.calls();
  ASSERT_GT(calls, 20u);
  const int kills = count_asked("HEDGEHOP_KILLS", 1);
  for (int i = 0; i < kills; ++i) {
    const uint64_t at = 1 + random() % calls;
    const std::string_view who = random() % 2 == 0 ? "kill_first" : "kill";
    const CommandEnd end = folder.shell(folder.on_failing_disk("out", who, at) + HEDGEHOP_PROGRAM " " +
                                        folder.arguments(GetParam(), "out", 2));
    // The killed flight of a sequence counts against its claim, which may be shown nevertheless, or is not flown.
    const bool may_end = end.status == 1 || (GetParam() == "until" && end.status == 0) || end.status == 4;
    EXPECT_TRUE(may_end || end.status == 128 + SIGKILL) << end.status << end.err;
    resume(whole, fmt::format("{} before call {} of {}", who, at, calls));
  }
}

/// Runs the command in this folder as a process.
pid_t start(const SmallCampaign& folder, const std::string& arguments) {
  const std::string line =
      "cd '" + folder.path().string() + "' && exec " HEDGEHOP_PROGRAM " " + arguments + " >stdout.txt 2>stderr.txt";
  std::string shell = "sh", option = "-c", text = line;
  char* const words[] = {shell.data(), option.data(), text.data(), nullptr};
  pid_t pid = -1;
  return posix_spawn(&pid, "/bin/sh", nullptr, nullptr, words, environ) == 0 ? pid : -1;
}

std::vector<pid_t> children(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{0}/task/{0}/children", pid));
  std::vector<pid_t> all;
  for (pid_t child = 0; file >> child;) all.push_back(child);
  return all;
}

/// Sends SIGKILL to the command or to one of its workers at a random time.
TEST_P(Killed, AtAnyTimeLosesNoResults) {
  const int kills = count_asked("HEDGEHOP_KILLS", 1);
  const auto begun = std::chrono::steady_clock::now();
  const auto whole = folder.fly_undisturbed(GetParam());
  const double whole_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
  for (int i = 0; i < kills; ++i) {
    const pid_t command = start(folder, folder.arguments(GetParam(), "out", 2));
    ASSERT_GT(command, 0);
    const int after_ms = std::uniform_int_distribution(0, static_cast<int>(whole_ms))(random);
    const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, command, 0));
    pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
    poll(&watched, 1, after_ms);
    const std::vector<pid_t> workers = children(command);
    const bool at_worker = random() % 2 == 0 && !workers.empty();
    kill(at_worker ? workers[random() % workers.size()] : command, SIGKILL);
    int status = 0;
    waitpid(command, &status, 0);
    close(descriptor);
    EXPECT_THAT(incomplete_files(), IsEmpty());
    resume(whole, fmt::format("{} killed after {} of {:.0f} ms", at_worker ? "worker" : "command", after_ms, whole_ms));
  }
}

INSTANTIATE_TEST_SUITE_P(Campaign, Killed, ::testing::ValuesIn(SmallCampaign::kCommands),
                         [](const auto& row) { return std::string(row.param); });
INSTANTIATE_TEST_SUITE_P(Sequence, Killed, ::testing::ValuesIn(SmallCampaign::kSequences),
                         [](const auto& row) { return std::string(row.param); });

}  // namespace
}  // namespace hedgehop::sim
