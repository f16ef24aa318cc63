#include "sim/config/folder_lock.h"

#include <gmock/gmock.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <optional>
#include <string>

#include "sim/config/input_error.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct LockTest : ::testing::Test {
  const TemporaryFolder scratch;
  const fs::path root = scratch.path();

  /// Returns the fault that a second lock prints, or "".
  template <class... Part>
  std::string fault(const fs::path& folder, Part... part) {
    try {
      const FolderLock lock(folder, part...);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
};

TEST_F(LockTest, SecondHolderIsRefusedWithTheProcessOfTheFirst) {
  const FolderLock first(root / "a");
  EXPECT_THAT(fault(root / "a"), HasSubstr("a: in use by another hedgehop command (process " +
                                           std::to_string(::getpid()) + "); wait for its end or choose another --out"));
  EXPECT_EQ(fault(root / "b"), "");
}

TEST_F(LockTest, PartsExcludeTheWholeButNotEachOther) {
  std::optional<FolderLock> one(std::in_place, root / "a", "shard-1-of-2");
  EXPECT_EQ(fault(root / "a", "shard-2-of-2"), "");
  EXPECT_NE(fault(root / "a", "shard-1-of-2"), "");
  EXPECT_NE(fault(root / "a"), "");
  one.reset();
  EXPECT_EQ(fault(root / "a"), "");
}

TEST_F(LockTest, FolderWithoutAccessIsBadInput) {
  fs::create_directories(root / "a/.hedgehop.lock");  // no file can have this name
  EXPECT_THAT(fault(root / "a"), HasSubstr("a: cannot write results: "));
}

TEST_F(LockTest, LinkToAMissingFolderIsBadInput) {
  fs::create_directory_symlink(root / "missing", root / "link");
  EXPECT_THAT(fault(root / "link/inner"), HasSubstr("link: is a link to a missing folder"));
  EXPECT_THAT(fault(root / "link"), HasSubstr("link: is a link to a missing folder"));
  EXPECT_TRUE(fs::is_symlink(root / "link"));
}

TEST_F(LockTest, LeavesNoFilesAndNoEmptyFolders) {
  { const FolderLock lock(root / "new/inner"); }
  EXPECT_TRUE(fs::is_empty(root));
  {
    const FolderLock lock(root / "new/inner");
    std::ofstream(root / "new/inner/result.json") << "{}";
  }
  EXPECT_TRUE(fs::exists(root / "new/inner/result.json"));
  EXPECT_FALSE(fs::exists(root / "new/inner/.hedgehop.lock"));
}

TEST_F(LockTest, IsReleasedWhenItsProcessIsKilled) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const FolderLock lock(root / "a");
    if (::write(ready[1], "x", 1) == 1) ::pause();
    ::_exit(0);
  }
  ::close(ready[1]);  // so that the read ends if the holder does
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  EXPECT_THAT(fault(root / "a"), HasSubstr(std::to_string(holder)));
  ::close(ready[0]);
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_EQ(fault(root / "a"), "");
}

TEST_F(LockTest, WaitsForAChildOfAKilledHolder) {
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t holder = ::fork();
  if (holder == 0) {
    const FolderLock lock(root / "a");
    if (::fork() != 0) {
      ::pause();
      ::_exit(0);
    }
    // The child ends when another process tries the lock for the second time; or by the alarm, if none does.
    ::alarm(30);
    const int events = ::inotify_init1(0);
    ::inotify_add_watch(events, (root / "a/.hedgehop.lock").c_str(), IN_OPEN);
    if (::write(ready[1], "x", 1) != 1) ::_exit(1);
    inotify_event opened[2];
    for (size_t got = 0; got < sizeof opened;) {
      const ssize_t more = ::read(events, opened, sizeof opened - got);
      if (more <= 0) break;
      got += static_cast<size_t>(more);
    }
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  ::kill(holder, SIGKILL);
  ::waitpid(holder, nullptr, 0);
  EXPECT_EQ(fault(root / "a"), "");
}

}  // namespace
}  // namespace hedgehop::sim
