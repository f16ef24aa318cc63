#include "sim/evidence/conduct.h"

#include <gmock/gmock.h>

#include <utility>

#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Conduct, BadFileDoesNotCountForTheRateOrThePlannedFlights) {
  const CampaignFolder folder;
  folder.write("bad.yaml", "use: tiny.yaml\nname: bad\nfoo: 1\n");
  const CommandEnd end = folder.hedgehop("batch bad.yaml tiny.yaml --seeds 5:8 --min-success 0.4 --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("bad.yaml:3:1: unknown key 'foo'"));
  const Json batch = folder.json("out/batch.json");
  EXPECT_EQ(batch.at("conduct").at("planned"), 4);
  EXPECT_EQ(batch.at("conduct").at("seeds"), "5:8");
  EXPECT_TRUE(batch.at("flights").back().at("passed"));
  ASSERT_EQ(batch.at("verdicts").size(), 1u);
  EXPECT_EQ(batch.at("verdicts").at(0).at("group"), "tiny");
  EXPECT_EQ(batch.at("groups").at(0).at("ended"), 0);
  EXPECT_THAT(end.out, HasSubstr("| bad | 1 | 0 | - | 0 | 0 | 0 | 0 | 1 | 0 |"));
  EXPECT_THAT(folder.hedgehop("batch bad.yaml tiny.yaml --seeds 5:8 --min-success 0.9 --out out").err,
              AllOf(HasSubstr("unknown key 'foo'"), HasSubstr("4 of 4 flights that pass cannot show")));
}

/// 5 flights without an event show 0.5 at 95 %.
TEST(Conduct, BadFileHasNoClaimUnderAStoppingRule) {
  const CampaignFolder folder;
  folder.write("bad.yaml", "use: tiny.yaml\nname: bad\nfoo: 1\n");
  const CommandEnd end = folder.hedgehop("batch bad.yaml tiny.yaml --seeds 5:12 --until 'collision < 0.5' --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.out, Not(HasSubstr("collision < 0.5 bad")));
  const Json batch = folder.json("out/batch.json");
  ASSERT_EQ(batch.at("sequential").size(), 1u);
  EXPECT_EQ(batch.at("sequential").at(0).at("group"), "tiny");
  EXPECT_EQ(batch.at("sequential").at(0).at("planned"), 8);
  EXPECT_EQ(batch.at("sequential").at(0).at("discarded"), 3);
  ASSERT_EQ(batch.at("flights").size(), 6u);
  EXPECT_EQ(batch.at("flights").at(0).at("status"), "failed");
  EXPECT_THAT(folder.read("out/batch.csv"), HasSubstr("bad.yaml,0,0,failed,"));
}

TEST(Conduct, PrintingJsonAlsoWritesThePageWithTheVerdicts) {
  const CampaignFolder folder;
  const CommandEnd end = folder.hedgehop("batch tiny.yaml --seeds 1:2 --min-success 0.1 --json --out out");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(Json::parse(end.out), folder.json("out/batch.json"));
  EXPECT_THAT(folder.read("out/report.html"), HasSubstr("\"check\":\"success_rate\""));
}

TEST(BatchInBrowser, ItsBadgeIsTheVerdictOverTheSeeds) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string worker = folder.worker("[ $seed = 2 ] && exit 3; fly \"$@\"");
  for (const auto& [rate, look] : {std::pair("0.4", "good"), std::pair("0.5", "bad")}) {  // 5 of 6: 0.436 to 0.970
    folder.hedgehop(std::string("batch tiny.yaml --seeds 1:6 --out out --min-success ") + rate + " --program " +
                    worker);
    const PageVisit page = visit(folder.path() / "out/report.html", R"js(
      return [document.querySelector('#head .badge').className, document.querySelector('#claims-card').textContent];)js");
    EXPECT_THAT(page.errors, IsEmpty());
    EXPECT_EQ(page.value[0], std::string("badge ") + look) << rate;
    EXPECT_THAT(page.value[1].get<std::string>(), HasSubstr("success_rate (tiny)"));
  }
}

}  // namespace
}  // namespace hedgehop::sim
