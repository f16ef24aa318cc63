#include "sim/batch/earlier_batch.h"

#include <gmock/gmock.h>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::HasSubstr;

TEST(FailedOnly, KeepsTheFoldersOfScenariosWithOneName) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.shell("mkdir s && cp tiny.yaml s/a.yaml && cp tiny.yaml s/b.yaml").status, 0);
  ASSERT_EQ(folder.hedgehop("batch s --out out").status, 0);
  const auto flights = [&] {
    std::vector<std::string> all;
    const Json batch = folder.json("out/batch.json");
    for (const Json& flight : batch.at("flights")) {
      all.push_back(flight.at("id").get<std::string>() + " of " + flight.at("group").get<std::string>());
    }
    return all;
  };
  const std::vector<std::string> first = flights();
  const std::string worker = folder.worker("echo $seed >> flown.txt; fly \"$@\"");
  EXPECT_EQ(folder.hedgehop("batch --failed-only --out out --program " + worker).status, 0);
  EXPECT_EQ(flights(), first);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "flown.txt")) << "both had passed";
}

TEST(FailedOnly, RepeatsTheChecksOfItsCampaign) {
  const CampaignFolder folder;
  folder.write("campaign.yaml",
               "tuned_on: none\nflights: [{scenario: tiny.yaml, seeds: 1:3}]\n"
               "checks: [{check: success_rate, at_least: 0.4}]\n");
  const std::string worker = folder.worker("exit 3");
  ASSERT_EQ(folder.hedgehop("batch campaign.yaml --out out --program " + worker).status, 1);
  ASSERT_EQ(folder.hedgehop("batch --failed-only --out out --program " + worker).status, 1);
  EXPECT_EQ(folder.json("out/batch.json").at("verdicts").size(), 1u);
  EXPECT_EQ(folder.hedgehop("batch --failed-only --out out --min-success 0.4").status, 0);
  EXPECT_EQ(folder.json("out/batch.json").at("verdicts").size(), 1u) << "an equal check is the same check";
  Json earlier = folder.json("out/batch.json");
  earlier.at("conduct").erase("checks");  // as 0.2 wrote it
  folder.write("out/batch.json", earlier.dump());
  EXPECT_EQ(folder.hedgehop("batch --failed-only --out out").status, 0);
  EXPECT_TRUE(folder.json("out/batch.json").at("verdicts").empty());
  EXPECT_THAT(folder.hedgehop("batch --failed-only --out out --seeds 7").err, HasSubstr("no --seeds, --set"));
}

TEST(FailedOnly, StaysInsideItsFolder) {
  const CampaignFolder folder;
  ASSERT_EQ(folder.hedgehop("batch tiny.yaml --out out").status, 0);
  Json batch = folder.json("out/batch.json");
  batch.at("flights").at(0).at("id") = "../elsewhere/seed1";
  folder.write("out/batch.json", batch.dump());
  const CommandEnd end = folder.hedgehop("batch --failed-only --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("'../elsewhere/seed1' is not a folder inside the batch's"));
}

}  // namespace
}  // namespace hedgehop::sim
