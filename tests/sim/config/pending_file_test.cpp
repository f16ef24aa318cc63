#include "sim/config/pending_file.h"

#include <gmock/gmock.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

#include "sim/config/whole_file.h"
#include "tests/sim/config/input_files.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<std::string> names_here() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(".")) names.push_back(entry.path().filename().string());
  return names;
}

TEST(PendingFile, OfAKilledProcessIsAbsent) {
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) {
    const PendingFile file("table.csv");
    (void)!::write(file.descriptor(), "half", 4);
    ::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_THAT(names_here(), IsEmpty());
}

/// A container may hide /proc, through which a file gets its name.
TEST(PendingFile, AppearsWithoutProc) {
  constexpr int kNotAllowed = 77;
  const Folder folder;
  const pid_t child = fork();
  if (child == 0) {
    const bool hidden = ::unshare(CLONE_NEWNS) == 0 &&
                        ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                        ::mount("tmpfs", "/proc", "tmpfs", 0, nullptr) == 0;
    if (!hidden) ::_exit(kNotAllowed);
    try {
      write_file_whole("table.csv", "whole");
      ::_exit(0);
    } catch (const std::exception&) {
      ::_exit(1);
    }
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kNotAllowed) GTEST_SKIP() << "only root may hide /proc";
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_THAT(names_here(), ElementsAre("table.csv"));
}

TEST(PendingFile, AppearsWholeAndReplacesAnEarlierFile) {
  const Folder folder;
  for (const std::string text : {"first", "second"}) {
    PendingFile file("table.csv");
    std::ofstream(file.path()) << text;
    const std::vector<std::string> names = names_here();
    if (text == "first") {
      EXPECT_THAT(names, IsEmpty());
    } else {
      EXPECT_EQ(read_file_whole("table.csv"), "first");
    }
    file.publish();
    EXPECT_EQ(read_file_whole("table.csv"), text);
  }
  EXPECT_THAT(names_here(), ElementsAre("table.csv"));
}

TEST(PendingFile, ThatCannotReplaceAFolderIsDiscarded) {
  const Folder folder;
  fs::create_directory("table.csv");
  PendingFile file("table.csv");
  EXPECT_THROW(file.publish(), std::system_error);
  EXPECT_THAT(names_here(), ElementsAre("table.csv"));
}

TEST(PendingFile, HasThePermissionsOfTheUmask) {
  const Folder folder;
  const mode_t before = ::umask(027);
  write_file_whole("table.csv", "");
  ::umask(before);
  EXPECT_EQ(fs::status("table.csv").permissions(), static_cast<fs::perms>(0640));
}

}  // namespace
}  // namespace hedgehop::sim
