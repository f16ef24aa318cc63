// Campaigns on a disk that is full, broken, or interrupts calls. Requirements: one error line, a documented exit
// status, no incomplete file under its final name, no loss of computed results, and the same tables after the disk
// recovers.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "tests/sim/cli/exit_status.h"
#include "tests/sim/disk/small_campaign.h"

namespace hedgehop::sim {
namespace {

using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// Returns the lines of standard error without progress.
std::vector<std::string> complaints(const std::string& err) {
  std::istringstream lines(err);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);) {
    const bool is_of_the_flight = line.find("no check requires the goal") != std::string::npos;
    if ((line.starts_with("hedgehop: ") || line.starts_with("warning: ")) && !is_of_the_flight) found.push_back(line);
  }
  return found;
}

/// A campaign without faults.
struct Undisturbed {
  std::map<std::string, std::string> files;
  uint64_t calls = 0;
};

/// Expects a documented exit status and one line: 2 if the folder could not be written before the first flight.
void expect_reported(const CommandEnd& end, const std::string& when) {
  if (end.status == kBadInput) {
    EXPECT_THAT(end.err, ContainsRegex("^out: cannot write results: [^\n]*\n$")) << when;
    return;
  }
  EXPECT_THAT(end.status, AnyOf(kFails, kInternalError)) << when << end.out << end.err;
  EXPECT_THAT(complaints(end.err), SizeIs(end.status == kInternalError ? 1 : 0)) << when << ": " << end.err;
}

class Disk : public ::testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override { std::filesystem::remove_all(folder.path() / "out"); }
  CommandEnd fly(std::string_view fault, uint64_t at, int workers = 1) const {
    return folder.shell(folder.on_failing_disk("out", fault, at) + HEDGEHOP_PROGRAM " " +
                        folder.arguments(GetParam(), "out", workers));
  }
  /// Returns the command's campaign without faults, flown once for all tests.
  const Undisturbed& undisturbed() const {
    static std::map<std::string_view, Undisturbed> known;
    Undisturbed& one = known[GetParam()];
    if (one.files.empty()) {
      one.files = folder.fly_undisturbed(GetParam());
      one.calls = folder.calls();
    }
    return one;
  }
  /// Returns the calls to test: all calls if requested (scripts/soak), otherwise a sample. The last one closes the lock
  /// of the folder, which holds no data.
  std::vector<uint64_t> calls_to_try() const {
    const auto count = static_cast<uint64_t>(count_asked("HEDGEHOP_DISK_FAULTS", 1));
    std::vector<uint64_t> all(undisturbed().calls - 1);
    std::iota(all.begin(), all.end(), 1);
    std::vector<uint64_t> some;
    std::ranges::sample(all, std::back_inserter(some), static_cast<std::ptrdiff_t>(count), std::mt19937_64(1));
    return some;
  }
  /// Expects that a flight with a result.json is complete and is kept, and that repeating the command gives the same
  /// files as a command without faults.
  void expect_recovery(const std::map<std::string, std::string>& whole, const std::string& when) {
    for (const auto& [name, text] : folder.lasting_files("out")) {
      if (!name.ends_with("/result.json")) continue;
      EXPECT_EQ(text, whole.at(name)) << when << ": " << name;
    }
    const CommandEnd end = folder.hedgehop(folder.arguments(GetParam(), "out", 2));
    EXPECT_EQ(end.status, 0) << when << ": " << end.err;
    EXPECT_THAT(differences(whole, folder.lasting_files("out")), IsEmpty()) << when;
    std::filesystem::remove_all(folder.path() / "out");
  }

  static SmallCampaign& shared() {
    static SmallCampaign one;
    return one;
  }
  const SmallCampaign& folder = shared();
};

TEST_P(Disk, ThatFailsAtAnyCallIsReportedWithoutLossOfResults) {
  const auto& whole = undisturbed().files;
  for (const std::string_view fault : {"full", "broken", "hiccup"}) {
    // Messages of the C library and of SQLite.
    const std::string words = fault == "full" ? "No space left on device|database or disk is full"
                                              : "Input/output error|disk I/O error|unable to open database";
    for (const uint64_t at : calls_to_try()) {
      const std::string when = fmt::format("{} from call {}", fault, at);
      const CommandEnd end = fly(fault, at);
      expect_reported(end, when);
      EXPECT_THAT(end.out + end.err, ContainsRegex(words)) << when;
      expect_recovery(whole, when);
    }
  }
}

TEST_P(Disk, ThatInterruptsCallsAndWritesInPartsIsNoError) {
  const auto& whole = undisturbed().files;
  const CommandEnd end = fly("interrupted", 0, 2);
  EXPECT_EQ(end.status, 0) << end.out << end.err;
  EXPECT_THAT(complaints(end.err), IsEmpty());
  EXPECT_THAT(differences(whole, folder.lasting_files("out")), IsEmpty());
}

/// With a limit on file sizes, the user must get the write error, not the signal.
TEST_P(Disk, ThatLimitsFileSizesEndsNoCampaignWithASignal) {
  const auto& whole = undisturbed().files;
  const CommandEnd end = folder.shell("ulimit -f 4; " HEDGEHOP_PROGRAM " " + folder.arguments(GetParam(), "out", 1));
  EXPECT_THAT(end.status, AnyOf(kFails, kInternalError)) << end.out << end.err;
  EXPECT_THAT(end.out + end.err, HasSubstr("File too large"));
  expect_recovery(whole, "limited");
}

/// The most common case: the folder is not writable, which is detected before the first flight.
TEST_P(Disk, ThatIsReadOnlyIsBadInputBeforeAnyFlight) {
  const std::string line = "unshare -rm sh -c 'mkdir -p out && mount -t tmpfs -o ro none out && " HEDGEHOP_PROGRAM " " +
                           folder.arguments(GetParam(), "out", 1) + "'";
  if (folder.shell("unshare -rm sh -c 'mkdir -p out && mount -t tmpfs -o ro none out'").status != 0) {
    GTEST_SKIP() << "no mounts here";
  }
  const CommandEnd end = folder.shell(line);
  EXPECT_EQ(end.status, kBadInput);
  EXPECT_THAT(end.err, ContainsRegex("^out: cannot write results: .*Read-only file system\n$"));
}

/// Real full disks of several sizes.
TEST_P(Disk, ThatIsFullIsReportedWithoutLossOfResults) {
  if (folder.shell("unshare -rm sh -c 'mkdir -p out && mount -t tmpfs -o size=64k none out'").status != 0) {
    GTEST_SKIP() << "no mounts here";
  }
  const auto& whole = undisturbed().files;
  for (const int kilobytes : {4, 80}) {
    const CommandEnd end = folder.shell(
        fmt::format("unshare -rm sh -c 'mkdir -p out && mount -t tmpfs -o size={}k none out && {{ {} {}; status=$?; cp "
                    "-r out kept; exit $status; }}'",
                    kilobytes, HEDGEHOP_PROGRAM, folder.arguments(GetParam(), "out", 1)));
    EXPECT_THAT(end.status, AnyOf(kFails, kInternalError)) << kilobytes << end.out << end.err;
    EXPECT_THAT(end.out + end.err, HasSubstr("No space left on device")) << kilobytes;
    std::filesystem::remove_all(folder.path() / "out");
    std::filesystem::rename(folder.path() / "kept", folder.path() / "out");
    expect_recovery(whole, fmt::format("{} kB", kilobytes));
  }
}

INSTANTIATE_TEST_SUITE_P(Campaign, Disk, ::testing::ValuesIn(SmallCampaign::kCommands),
                         [](const auto& row) { return std::string(row.param); });

/// One flight with video and page: a missing video is a warning, any other missing file is an error. Tests each file
/// call.
TEST(DiskOfARun, ThatFailsAtAnyCallIsReported) {
  const SmallCampaign folder;
  const std::string run = HEDGEHOP_PROGRAM " run tiny.yaml --out out";
  ASSERT_EQ(folder.shell(folder.on_failing_disk("out", "none", 0) + run).status, 0);
  const uint64_t calls = folder.calls(),
                 step = std::max<uint64_t>(1, calls / static_cast<uint64_t>(count_asked("HEDGEHOP_DISK_FAULTS", 5)));
  for (uint64_t at = 1; at < calls; at += step) {  // the last call closes the lock of the folder
    std::filesystem::remove_all(folder.path() / "out");
    const CommandEnd end = folder.shell(folder.on_failing_disk("out", "hiccup", at) + run);
    const std::string when = fmt::format("call {} of {}: {}", at, calls, end.err);
    EXPECT_THAT(end.err, HasSubstr("Input/output error")) << when;
    if (end.err.find("warning: incomplete video") == std::string::npos) {
      expect_reported(end, when);
    } else {
      EXPECT_EQ(end.status, 0) << when;
      EXPECT_THAT(complaints(end.err), SizeIs(1)) << when;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      EXPECT_THAT(entry.path().string(), Not(EndsWith(".part"))) << when;
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim
