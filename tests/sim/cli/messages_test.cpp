// Messages of commands: one line that names the fault, the place and the valid values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/cli/exit_status.h"

namespace hedgehop::sim::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class Messages : public testing::Test {
 protected:
  /// Returns standard error of a command that must be bad input.
  std::string refused(const std::string& arguments) const {
    const CommandEnd end = folder.hedgehop(arguments);
    EXPECT_EQ(end.status, kBadInput) << arguments << ": " << end.err;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << arguments << ": " << end.err;
    return end.err;
  }
  const CampaignFolder folder;
};

TEST_F(Messages, AnUnknownOptionBeforeACommandListsThoseOfTheProgram) {
  EXPECT_THAT(refused("--foo"), StartsWith("unknown option '--foo'; allowed: --help"));
  EXPECT_THAT(refused("--versoin"), HasSubstr("did you mean '--version'?"));
}

TEST_F(Messages, AMissingValueIsNamed) {
  EXPECT_EQ(refused("batch tiny.yaml --seeds"), "--seeds: a value is missing (see --help)\n");
  EXPECT_EQ(refused("run tiny.yaml --set"), "--set: a value is missing (KEY.PATH=VALUE) (see --help)\n");
  EXPECT_THAT(refused("list"), HasSubstr("TOPIC is required; valid: modules, vehicles"));
}

TEST_F(Messages, MissingFoldersAndFilesAreNamed) {
  folder.write("sweep.yaml", "scenario: tiny.yaml\nparameters: [{path: start.east, values: [0]}]\n");
  EXPECT_EQ(refused("report gone"), "DIR: gone: there is no such folder (see --help)\n");
  EXPECT_EQ(refused("report tiny.yaml"), "DIR: tiny.yaml: is a file; valid: a folder (see --help)\n");
  EXPECT_EQ(refused("sweep sweep.yaml --merge --from gone"), "--from: gone: there is no such folder (see --help)\n");
  EXPECT_EQ(refused("batch tiny.yaml --no-worse-than gone"),
            "--no-worse-than: gone: there is no such folder; valid: the --out of an earlier batch (see --help)\n");
  EXPECT_EQ(refused("batch --failed-only --out gone"), "gone/batch.json: there is no such file\n");
}

TEST_F(Messages, AConfidenceWithoutACheckIsRefused) {
  EXPECT_EQ(refused("batch tiny.yaml --confidence 0.9"),
            "--confidence requires --min-success, --no-worse-than, --until or --until-width (see --help)\n");
}

TEST_F(Messages, UnreadableResultsAreNamedInTheIndexOfRuns) {
  folder.shell("mkdir -p all/good all/bad");
  folder.write("all/bad/result.json", "{");
  const CommandEnd none = folder.hedgehop("runs all");
  EXPECT_EQ(none.status, kBadInput);
  EXPECT_THAT(none.err, StartsWith("all: no result in this folder tree can be read\nbad: "));
  EXPECT_EQ(folder.hedgehop("run tiny.yaml --no-report --no-video --out all/good").status, 0);
  const CommandEnd one = folder.hedgehop("runs all");
  EXPECT_EQ(one.status, 0);
  EXPECT_THAT(one.err, StartsWith("warning: bad: "));
  EXPECT_THAT(one.out, StartsWith("1 result; written: "));
}

TEST_F(Messages, AModuleThatCannotBeLoadedEndsASweepBeforeItsFlights) {
  folder.write("no_library.so", "text");
  folder.write("sweep.yaml",
               "scenario: tiny.yaml\nset: [avoidance.plugin=no_library.so]\n"
               "parameters: [{path: start.east, values: [0, 1]}]\n");
  EXPECT_THAT(refused("sweep sweep.yaml --out unloadable"), HasSubstr("no_library.so"));
  EXPECT_NE(folder.shell("test -e unloadable/flights").status, 0);
}

TEST_F(Messages, PapersOutsideOfACheckoutAreExplained) {
  EXPECT_EQ(refused("reproduce perez2018"),
            "configs/papers: there is no such folder; run this command in the source checkout, or install Hedgehop\n");
}

TEST_F(Messages, FoldersThatCannotBeUsedAreBadInput) {
  folder.shell("mkdir -p br && touch br/scenarios file");
  EXPECT_EQ(refused("branch tiny.yaml --at 0.05 --out br"),
            "br/scenarios: cannot create this folder: Not a directory\n");
  if (::geteuid() == 0) GTEST_SKIP() << "root reads every folder";
  folder.shell("mkdir locked && chmod 0 locked");
  EXPECT_EQ(refused("report locked"), "locked: cannot read this folder: Permission denied\n");
  folder.shell("chmod 700 locked");
}

TEST_F(Messages, ADamagedRecordOfABatchIsExplained) {
  folder.shell("mkdir cut other");
  folder.write("cut/batch.json", "{\n");
  folder.write("other/batch.json", "{\"flights\": []}\n");
  EXPECT_EQ(refused("batch --failed-only --out cut"), "cut/batch.json:2:1: is not complete JSON\n");
  EXPECT_EQ(refused("batch --failed-only --out other"),
            "other/batch.json: is not the record of a batch: the key 'groups' is missing\n");
}

TEST_F(Messages, CompareNamesTheFileThatIsNoScenario) {
  folder.write("c.yaml",
               "tuned_on: none\nflights: [{scenario: tiny.yaml, seeds: 1}, {scenario: wind.yaml, seeds: 1}]\n");
  folder.write("wind.yaml", "use: tiny.yaml\nname: wind\n");
  const std::string options = " --seeds 1:2 --until 'collision: better' --out out";
  EXPECT_EQ(refused("compare tiny.yaml tiny.yaml" + options),
            "compare: BASE and CANDIDATE are the same file 'tiny.yaml'; name two scenarios\n");
  EXPECT_EQ(refused("compare tiny.yaml c.yaml" + options),
            "compare: c.yaml is a campaign or a folder; valid: a scenario\n");
}

TEST_F(Messages, WarningsBeginWithTheirKind) {
  const std::string vehicle = HEDGEHOP_SOURCE_DIR "/configs/vehicles/artis.yaml";
  const CommandEnd end = folder.hedgehop("trim " + vehicle + " --speed 0:60:60 --plot trim.html");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.err, HasSubstr("warning: no steady flight at 60 m/s\n"));
  EXPECT_THAT(end.err, HasSubstr("written: trim.html\n"));
}

}  // namespace
}  // namespace hedgehop::sim::cli
