#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

TEST(Bless, ReferenceHoldsItsOwnFlightAndRefusesAnother) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("run tiny.yaml --seed 3 --no-report --no-video --out first").status, 0);
  ASSERT_EQ(folder.hedgehop("bless first --reason 'straight to the goal'").status, 0);
  EXPECT_THAT(folder.read("tiny.reference.csv"), HasSubstr("# reason: straight to the goal\n# version: "));
  EXPECT_THAT(folder.read("tiny.reference.csv"), HasSubstr("# seed: 3\n"));
  for (const std::string measure : {"band", "frechet", "dtw"}) {
    folder.write("held.yaml",
                 "use: tiny.yaml\nname: held\nchecks: [{check: path_tolerance, reference: "
                 "tiny.reference.csv, at_most: 0.02, measure: " +
                     measure + "}]\n");
    const std::string run = "run held.yaml --no-report --no-video --out held --seed ";
    EXPECT_EQ(folder.hedgehop(run + "3").status, 0) << measure;
    EXPECT_EQ(folder.hedgehop(run + "4").status, 1) << measure;  // starts elsewhere
  }
}

TEST(Bless, ReplacesAReferenceOnlyWithForceAndDryRunNamesTheFile) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("run tiny.yaml --seed 3 --no-report --no-video --out first").status, 0);
  const CommandEnd dry = folder.hedgehop("bless first --reason one --dry-run");
  EXPECT_EQ(dry.status, 0);
  EXPECT_THAT(dry.out, HasSubstr("would write: "));
  EXPECT_THAT(dry.out, HasSubstr("tiny.reference.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "tiny.reference.csv"));
  ASSERT_EQ(folder.hedgehop("bless first --reason one").status, 0);
  for (const std::string option : {"", " --dry-run"}) {
    const CommandEnd again = folder.hedgehop("bless first --reason two" + option);
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.err, HasSubstr("tiny.reference.csv: is there already; --force replaces it"));
  }
  EXPECT_THAT(folder.read("tiny.reference.csv"), HasSubstr("# reason: one\n"));
  EXPECT_EQ(folder.hedgehop("bless first --reason two --force").status, 0);
  EXPECT_THAT(folder.read("tiny.reference.csv"), HasSubstr("# reason: two\n"));
}

TEST(Bless, NamesTheCheckOfTheScenarioOrTheOneToAdd) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("run tiny.yaml --seed 3 --no-report --no-video --out first").status, 0);
  EXPECT_THAT(folder.hedgehop("bless first --reason one").out,
              HasSubstr("add to the checks: - {check: path_tolerance, reference: tiny.reference.csv, at_most: 0.5}\n"));
  folder.write(
      "held.yaml",
      "use: tiny.yaml\nname: held\nchecks: [{check: max_speed, at_most: 9}, {check: path_tolerance, reference: "
      "tiny.reference.csv, at_most: 0.02}]\n");
  ASSERT_EQ(folder.hedgehop("run held.yaml --seed 3 --no-report --no-video --out held").status, 0);
  const CommandEnd end = folder.hedgehop("bless held --reason two --force");
  EXPECT_THAT(end.out, HasSubstr("tiny.reference.csv"));
  EXPECT_THAT(end.out, HasSubstr("checked by: checks.1 of the scenario\n"));
}

TEST(Bless, RejectsAFailedFlight) {
  const CampaignFolder folder;
  folder.write("slow.yaml", "use: tiny.yaml\nname: slow\nchecks: [{check: max_speed, at_most: 0.01}]\n");
  ASSERT_EQ(folder.hedgehop("run slow.yaml --no-report --no-video --out slow").status, 1);
  const CommandEnd end = folder.hedgehop("bless slow --reason 'near enough'");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("the flight failed (max_speed)"));
  EXPECT_EQ(folder.hedgehop("bless slow --reason 'near enough' --force").status, 0);
}

// As in another folder than that of the run.
TEST(Bless, RejectsARunWhoseScenarioIsNotThere) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("run tiny.yaml --seed 3 --no-report --no-video --out first").status, 0);
  std::filesystem::rename(folder.path() / "tiny.yaml", folder.path() / "moved.yaml");
  const CommandEnd end = folder.hedgehop("bless first --reason one");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err,
              HasSubstr("tiny.yaml: no such scenario here; call bless in the folder in which run was called\n"));
}

TEST(Bless, MissingReferenceIsRefusedBeforeTheFlight) {
  const CampaignFolder folder;
  folder.write("held.yaml", "use: tiny.yaml\nchecks:\n  - {check: path_tolerance, reference: none.csv, at_most: 1}\n");
  const CommandEnd end = folder.hedgehop("run held.yaml --out held");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(
      end.err,
      ContainsRegex("held.yaml:3:40: 'checks.0.reference': .*none.csv: there is no such file; `hedgehop bless`"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "held"));
}

TEST(ShippedSweeps, AreAcceptedWhole) {
  const CampaignFolder folder;
  ASSERT_FALSE(std::filesystem::is_empty(HEDGEHOP_SOURCE_DIR "/configs/sweeps"));
  for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs/sweeps")) {
    const CommandEnd end = folder.hedgehop("sweep '" + entry.path().string() + "' --missing --out none");
    EXPECT_EQ(end.status, 0) << end.err;
    EXPECT_GT(std::stoi(end.out), 0);
  }
}

TEST(ShippedCampaigns, AreAcceptedWhole) {
  const CampaignFolder folder;
  const std::string nothing = folder.worker("exit 3");
  ASSERT_FALSE(std::filesystem::is_empty(HEDGEHOP_SOURCE_DIR "/configs/campaigns"));
  for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs/campaigns")) {
    const CommandEnd end =
        folder.hedgehop("batch '" + entry.path().string() + "' --seeds 1 --out out --program " + nothing);
    EXPECT_EQ(end.status, 1) << end.err;  // 2 would mean a bad file
  }
}

}  // namespace
}  // namespace hedgehop::sim
