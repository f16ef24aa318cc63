#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

/// A folder with a second system whose flights all fail.
class TwoSystems : public CampaignFolder {
 public:
  TwoSystems() {
    write("other.yaml", "use: tiny.yaml\nname: other\nchecks: [{check: altitude_band, min: 50, max: 60}]\n");
  }
  Json found() const { return json("out/batch.json").at("sequential").at(0); }
};

TEST(Compare, ShowsOrRefutesThatTheCandidateIsBetter) {
  const TwoSystems folder;
  const std::string common = " --seeds 101:108 --until 'success: better' --junit j.xml -j 2 --out ";
  const CommandEnd better = folder.hedgehop("compare other.yaml tiny.yaml" + common + "out");
  EXPECT_EQ(better.status, 0) << better.err;
  // Five discordant pairs in the same direction decide at 95 %.
  EXPECT_EQ(folder.found().at("n"), 5);
  EXPECT_EQ(folder.found().at("candidate_better"), 5);
  EXPECT_EQ(folder.found().at("stopped_at"), 105);
  EXPECT_EQ(folder.json("out/batch.json").at("flights").size(), 10u);
  EXPECT_THAT(better.out, HasSubstr("pass  success: better candidate against base: shown: of 5 pairs, the candidate "));
  const CommandEnd worse = folder.hedgehop("compare tiny.yaml other.yaml" + common + "worse");
  EXPECT_EQ(worse.status, 1);
  EXPECT_THAT(junit_cases(folder, "j.xml"), HasSubstr("failure refuted: of 5 pairs"));
  const CommandEnd equal = folder.hedgehop(
      "compare tiny.yaml other.yaml --seeds 101:103 --until 'min_clearance_m: better' --range 3 --out equal");
  EXPECT_EQ(equal.status, 4) << equal.err;
  EXPECT_EQ(folder.json("equal/batch.json").at("sequential").at(0).at("mean_difference"), 0.0);
}

TEST(CompareInBrowser, NamesBaseAndCandidateAndDoesNotPoolTheirRates) {
  HEDGEHOP_NEEDS_BROWSER();
  const TwoSystems folder;
  ASSERT_EQ(folder.hedgehop("compare other.yaml tiny.yaml --seeds 101:108 --until 'success: better' --out out").status,
            0);
  const PageVisit page = visit(folder.path() / "out/report.html", R"js(
    const text = (selector) => document.querySelector(selector).textContent;
    return [text('#claims-card'), text('#groups'), text('.tile')];)js");
  EXPECT_THAT(page.errors, ::testing::IsEmpty());
  const auto facts = page.value[0].get<std::string>(), groups = page.value[1].get<std::string>();
  EXPECT_THAT(facts, HasSubstr("baseother: 0 of 5 passed, 95 % interval 0 % to"));
  EXPECT_THAT(facts, HasSubstr("candidatetiny: 5 of 5 passed, 95 % interval"));
  EXPECT_THAT(facts, ::testing::Not(HasSubstr("Success rate")));
  EXPECT_LT(groups.find("base: other"), groups.find("candidate: tiny"));
  EXPECT_THAT(groups, ::testing::Not(HasSubstr("all flights")));
  EXPECT_EQ(page.value[2], "all checks hold5 of 5candidate; base: 0 of 5");
}

TEST(Compare, SameAnswerForAnyNumberOfWorkersAndResumed) {
  const TwoSystems folder;
  const std::string common = "compare other.yaml tiny.yaml --seeds 101:108 --until 'success: better' --out ";
  ASSERT_EQ(folder.hedgehop(common + "one -j 1").status, 0);
  ASSERT_EQ(folder.hedgehop(common + "six -j 6").status, 0);
  ASSERT_EQ(folder.hedgehop(common + "six -j 2 --resume").status, 0);
  const auto answer = [&](const std::string& out) { return folder.json(out + "/batch.json").at("sequential"); };
  EXPECT_EQ(answer("one"), answer("six"));
  EXPECT_EQ(answer("one").at(0).at("n"), 5);
  EXPECT_EQ(lasting_columns(folder.read("one/batch.csv")), lasting_columns(folder.read("six/batch.csv")));
}

/// A missing flight of either system is no evidence for the candidate.
TEST(Compare, FlightsWithoutAResultCountAgainstTheCandidate) {
  const TwoSystems folder;
  const std::string worker = folder.worker("case \"$*\" in *other.yaml*) exit 3 ;; esac; fly \"$@\"");
  const CommandEnd end = folder.hedgehop(
      "compare other.yaml tiny.yaml --seeds 101:103 --until 'success: better' --out out --program " + worker);
  EXPECT_EQ(end.status, 4);
  EXPECT_EQ(folder.found().at("candidate_better"), 0);
}

TEST(Compare, RequiresTwoDifferentScenarios) {
  const TwoSystems folder;
  const auto refused = [&](const std::string& files) {
    const CommandEnd end = folder.hedgehop("compare " + files + " --seeds 1:2 --until 'collision: better' --out out");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
    return end.status == 2 ? end.err : "accepted";
  };
  EXPECT_THAT(refused("tiny.yaml tiny.yaml"), HasSubstr("BASE and CANDIDATE are the same file 'tiny.yaml'"));
  EXPECT_THAT(refused("tiny.yaml missing.yaml"), HasSubstr("missing.yaml"));
}

}  // namespace
}  // namespace hedgehop::sim
