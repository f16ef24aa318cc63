#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class PlanFolder : public CampaignFolder {
 public:
  PlanFolder() {
    write_plan("");
    write_plan(", sha256: " + sha256_of("plan.yaml"));
  }
  /// @param hash  end of the scenario's entry.
  void write_plan(const std::string& hash) const {
    write("plan.yaml",
          "question: does tiny collide in under half of its starts?\n"
          "flights: [{scenario: tiny.yaml, seeds: 101:110" +
              hash +
              "}]\n"
              "rule: {until: collision < 0.5}\n"
              "tuned_on: {seeds: 1:100, settings_tried: 14}\n");
  }
  /// Returns the SHA-256 that `validate` prints for the scenario of a plan.
  std::string sha256_of(const std::string& file) const {
    const std::string words = hedgehop("validate " + file).out;
    const size_t at = words.find("sha256: ");
    return at == std::string::npos ? words : words.substr(at + 8, 64);
  }
  Json plan(const std::string& out = "out") const { return json(out + "/batch.json").at("conduct").at("plan"); }
  /// Returns the state of the plan on the page of `out`.
  std::string on_page() const {
    EXPECT_EQ(hedgehop("report out").status, 0);
    const std::string page = read("out/report.html");
    const size_t at = page.find("\"now\":\"");
    return at == std::string::npos ? "" : page.substr(at + 7, page.find('"', at + 7) - at - 7);
  }
};

TEST(Plan, IsFlownAsRegistered) {
  const PlanFolder folder;
  const CommandEnd end = folder.hedgehop("batch --plan plan.yaml --out out");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(folder.plan().at("sha256").get<std::string>(), folder.shell("sha256sum plan.yaml").out.substr(0, 64));
  EXPECT_THAT(folder.plan().at("deviations"), IsEmpty());
  const Json conduct = folder.json("out/batch.json").at("conduct");
  EXPECT_EQ(conduct.at("planned"), 10);
  EXPECT_EQ(conduct.at("seeds"), "101:110");
  EXPECT_EQ(conduct.at("tuned_on"), "1:100");
  EXPECT_EQ(conduct.at("settings_tried"), 14);
  EXPECT_EQ(conduct.at("rule"), "collision < 0.5");
  EXPECT_EQ(folder.json("out/batch.json").at("sequential").at(0).at("verdict"), "shown");
}

TEST(Plan, StatesNoNumberOfSettingsThatItDoesNotRegister) {
  const PlanFolder folder;
  std::string text = folder.read("plan.yaml");
  const std::string settings = ", settings_tried: 14";
  folder.write("plan.yaml", text.erase(text.find(settings), settings.size()));
  ASSERT_EQ(folder.hedgehop("batch --plan plan.yaml --out out").status, 0);
  EXPECT_TRUE(folder.json("out/batch.json").at("conduct").at("settings_tried").is_null());
}

TEST(Plan, AChangeAfterTheFlightsIsShownOnThePage) {
  const PlanFolder folder;
  ASSERT_EQ(folder.hedgehop("batch --plan plan.yaml --out out").status, 0);
  EXPECT_EQ(folder.on_page(), "same");
  std::string text = folder.read("plan.yaml");
  text.replace(text.find("0.5"), 3, "0.6");
  folder.write("plan.yaml", text);
  EXPECT_EQ(folder.on_page(), "changed");
  std::filesystem::remove(folder.path() / "plan.yaml");
  EXPECT_EQ(folder.on_page(), "gone");
}

TEST(Plan, CoversEveryResolvedValueAndFileOfTheScenario) {
  const PlanFolder folder;
  folder.write("gusts.yaml", "turbulence_w20: 16\n");
  folder.write("tiny.yaml", folder.read("tiny.yaml") + "wind: {use: gusts.yaml}\n");
  folder.write_plan(", sha256: " + folder.sha256_of("plan.yaml"));
  const auto deviations = [&](const std::string& options = "") {
    folder.shell("rm -rf out");
    folder.hedgehop("batch --plan plan.yaml --out out" + options);
    return folder.plan().at("deviations");
  };
  const auto changed = HasSubstr("tiny.yaml: resolved scenario has SHA-256 ");
  EXPECT_THAT(deviations(), IsEmpty());
  folder.write("gusts.yaml", "# no change\nturbulence_w20: 16.0\n");
  EXPECT_THAT(deviations(), IsEmpty());
  folder.write("gusts.yaml", "turbulence_w20: 0\n");
  EXPECT_THAT(deviations(), ElementsAre(changed));
  folder.write("gusts.yaml", "turbulence_w20: 16\n");
  EXPECT_THAT(deviations(" --set drawing.visibility=50"), ElementsAre(changed, "drawing.visibility=50 was set"));
  folder.write("tiny.yaml", folder.read("tiny.yaml") + "command_latency: 0.1\n");
  EXPECT_THAT(deviations(), ElementsAre(changed));
}

TEST(Plan, WithoutTheHashOfItsScenarioRegistersNone) {
  const PlanFolder folder;
  folder.write_plan("");
  folder.hedgehop("batch --plan plan.yaml --out out");
  EXPECT_THAT(folder.plan().at("deviations"), ElementsAre(AllOf(HasSubstr("tiny.yaml: resolved scenario has SHA-256 "),
                                                                HasSubstr(", registered none"))));
}

TEST(Plan, OfAMovedFolderHoldsAndAChangedMeshIsADeviation) {
  const PlanFolder folder;
  folder.write("post.obj", "v 40 0 0\nv 41 0 0\nv 40 1 0\nf 1 2 3\n");
  folder.write("tiny.yaml", folder.read("tiny.yaml") + "  # a post far away\n");
  folder.write("tiny.yaml", folder.read("tiny.yaml")
                                .replace(folder.read("tiny.yaml").find("{texture_size: 64}"), 18,
                                         "{texture_size: 64, imports: [{file: post.obj, name: "
                                         "post}]}"));
  const std::string hash = folder.sha256_of("plan.yaml");
  ASSERT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos) << hash;
  folder.shell("mkdir moved && cp tiny.yaml post.obj plan.yaml moved");
  EXPECT_EQ(folder.sha256_of("moved/plan.yaml"), hash);
  folder.write("moved/post.obj", "v 40 0 0\nv 41 0 0\nv 40 2 0\nf 1 2 3\n");
  EXPECT_NE(folder.sha256_of("moved/plan.yaml"), hash);
}

/// A new key of scenarios changes the hash; `hedgehop validate configs/plans` prints it.
TEST(Plan, OfThisFolderIsRegisteredWithItsScenarios) {
  const CampaignFolder folder;
  const CommandEnd end = folder.hedgehop("validate " HEDGEHOP_SOURCE_DIR "/configs/plans");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, Not(HasSubstr("registered: "))) << end.out;
}

TEST(PlanInBrowser, StatesTheSeedsAndThePlanOfTheRate) {
  HEDGEHOP_NEEDS_BROWSER();
  const PlanFolder folder;
  ASSERT_EQ(folder.hedgehop("batch --plan plan.yaml --out out").status, 0);
  const auto facts = [&] {
    EXPECT_EQ(folder.hedgehop("report out").status, 0);
    const PageVisit page =
        visit(folder.path() / "out/report.html", "return document.getElementById('claims-card').textContent;");
    EXPECT_THAT(page.errors, IsEmpty());
    return page.value.get<std::string>();
  };
  const std::string as_flown = facts();
  EXPECT_THAT(as_flown, HasSubstr("10 planned, 5 counted, 5 passed, 0 failed a check, 0 with a fault or no result"));
  EXPECT_THAT(as_flown, HasSubstr("5 flights after the stop are not counted"));
  EXPECT_THAT(as_flown, HasSubstr("evaluated after every flight"));
  EXPECT_THAT(as_flown, HasSubstr("Planned: 101:110. Parameters were chosen on: 1:100, 14 settings tried."));
  EXPECT_THAT(as_flown, HasSubstr("deviationsNone."));
  folder.write("plan.yaml", folder.read("plan.yaml") + "# a word\n");
  EXPECT_THAT(facts(), HasSubstr("deviationsThe plan was changed after the flights."));
}

/// Repeating failed flights is within the plan; a repetition that would undo a stop is rejected.
TEST(Plan, StaysWithTheFlightsThatAreFlownAgain) {
  const PlanFolder folder;
  std::string text = folder.read("plan.yaml");
  text.erase(text.find("rule:"), text.find("tuned_on") - text.find("rule:"));
  folder.write("all.yaml", text);
  ASSERT_EQ(folder.hedgehop("batch --plan all.yaml --seeds 101:102 --out out").status, 0);
  ASSERT_EQ(folder.hedgehop("batch --failed-only --out out").status, 0);
  EXPECT_EQ(folder.plan().at("file"), "all.yaml");
  EXPECT_THAT(folder.plan().at("deviations"), ElementsAre("tiny.yaml: seeds 101:102, registered 101:110"));
  ASSERT_EQ(folder.hedgehop("batch --plan plan.yaml --out stopped").status, 0);
  EXPECT_THAT(folder.hedgehop("batch --failed-only --out stopped").err,
              HasSubstr("flown until 'collision < 0.5' was decided; repeat that command with --resume"));
}

TEST(Plan, ListsEveryDeviation) {
  const PlanFolder folder;
  std::string text = folder.read("plan.yaml");
  folder.write("plan.yaml", text + "build: 0123456789abcdef\n");
  folder.write("campaign.yaml",
               "tuned_on: 1:100\nplan: plan.yaml\nflights:\n"
               "  - {scenario: tiny.yaml, seeds: 101:103, set: [avoidance.speed=0.4]}\n");
  folder.hedgehop("batch campaign.yaml --until 'collision < 0.6' --limit 90 --out out");
  const Json found = folder.plan().at("deviations");
  EXPECT_THAT(
      found,
      ElementsAre("tiny.yaml: seeds 101:103, registered 101:110", HasSubstr("resolved scenario has SHA-256 "),
                  "avoidance.speed=0.4 was set", "rule 'collision < 0.6' at 0.95, registered 'collision < 0.5' at 0.95",
                  "flights over 90 s of wall time were ended", HasSubstr(", registered 0123456789abcdef")));
}

TEST(Plan, ItsRuleIsRefusedNextToChecksOverTheSeedsWithItsPlace) {
  const PlanFolder folder;
  folder.write("campaign.yaml",
               "tuned_on: 1:100\nplan: plan.yaml\nflights: [{scenario: tiny.yaml, seeds: 101:110}]\n"
               "checks: [{check: success_rate, at_least: 0.1}]\n");
  for (const char* command : {"batch campaign.yaml --out out", "validate campaign.yaml"}) {
    const CommandEnd end = folder.hedgehop(command);
    EXPECT_EQ(end.status, 2) << command;
    EXPECT_THAT(end.err, StartsWith("plan.yaml: rule: success_rate, no_worse and leaderboards are for a number"));
  }
}

TEST(Plan, RejectsBadPlansWithTheirPlace) {
  const PlanFolder folder;
  std::string text = folder.read("plan.yaml");
  text.replace(text.find("101:110"), 7, "100:110");
  folder.write("both.yaml", text);
  EXPECT_THAT(folder.hedgehop("batch --plan both.yaml --out out").err,
              HasSubstr("both.yaml:2:40: seeds '100:110' judge by seed 100, which parameters were chosen on"));
  text = folder.read("plan.yaml");
  text.replace(text.find("collision"), 9, "colision");
  folder.write("typo.yaml", text);
  EXPECT_THAT(folder.hedgehop("batch --plan typo.yaml --out out").err,
              HasSubstr("typo.yaml:3:15: 'colision < 0.5': no event 'colision'; did you mean 'collision'?"));
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --plan plan.yaml --out out").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hedgehop::sim
