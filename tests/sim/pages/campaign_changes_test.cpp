#include "sim/pages/campaign_changes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "sim/pages/campaign_report.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/made_up_sweep.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CampaignInBrowser, ListsFlightsWithADifferentOutcome) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(20, 6);
  write_sweep(folder.path() / "before", records);
  records[4].result->flight.outcome = Outcome::collided;
  records[4].result->flight.checks[0].passed = false;
  records[4].result->flight.closest_obstacle.distance_m = -0.25;
  records[9].order.id = "flights/other";  // its scenario and seed are not unique
  records[10].order.id = "flights/new";
  records[10].order.seed = 77;
  write_sweep(folder.path() / "now", records);
  write_campaign_report(folder.path() / "now", folder.path() / "before");
  const PageVisit page = visit(folder.path() / "now" / "report.html", R"js(
    const words = (tr) => [...tr.children].map((td) => td.textContent);
    return {said: document.querySelector('#against-card p').textContent,
            changed: [...document.querySelectorAll('#changed tr')].slice(1).map(words)};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(
      page.value.at("said").get<std::string>(),
      HasSubstr("18 flights in both, 1 with a different outcome; 2 only in this campaign, 2 only in the other."));
  ASSERT_EQ(page.value.at("changed").size(), 1u);
  EXPECT_EQ(page.value.at("changed")[0][0], "flights/4");
  EXPECT_EQ(page.value.at("changed")[0][1], "reached");
  EXPECT_EQ(page.value.at("changed")[0][2], "collided");
  EXPECT_EQ(page.value.at("changed")[0][4], "\u22120.25");
}

TEST(SettingChanges, NameTheItemOfAListThatDiffers) {
  const std::string before = "rig: {cameras: [{role: front, width: 80}, {role: down, width: 16}]}\nlist: [1, 2]\n";
  const std::string now = "rig: {cameras: [{role: front, width: 80}, {role: down, width: 32}]}\nlist: [1, 3]\nnew: 1\n";
  EXPECT_EQ(setting_changes(now, before).dump(),
            R"([["list","[1, 2]","[1, 3]",""],["new","","1",""],["rig.cameras.1.width","16","32","px"]])");
}

/// Two of the four earlier flights collided; the two in both campaigns passed before and now.
TEST(AgainstData, TotalIsOfTheFlightsInBoth) {
  const TemporaryFolder folder;
  const auto records = made_up(4, 12);
  write_sweep(folder.path() / "before", records);
  write_sweep(folder.path() / "now", {records[0], records[2]});
  const auto total =
      against_data(read_flights(folder.path() / "now"), read_flights(folder.path() / "before")).at("groups").at(0);
  EXPECT_EQ(total.at("group"), "flights in both");
  EXPECT_EQ(total.at("before").at("passed"), 2);
  EXPECT_EQ(total.at("before").at("ended"), 2);
  EXPECT_EQ(total.at("change").at(0), 0.0);
}

TEST(CampaignInBrowser, ListsChangedSettingsAndValuesOfChecksWithEqualOutcomes) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  for (const char* more : {"--out before", "--out now --set avoidance.speed=0.5"}) {
    ASSERT_LE(folder.hedgehop(std::string("batch tiny.yaml --set duration=1 ") + more).status, 1);
  }
  ASSERT_EQ(folder.hedgehop("report now --against before").status, 0);
  const PageVisit page = visit(folder.path() / "now/report.html", R"js(
    const words = (table) => [...table.querySelectorAll('tr')].slice(1).map((tr) => [...tr.children].map((td) => td.textContent));
    return {settings: words(document.querySelector('#against-card .settings')), checks: words(document.querySelector('#changed-checks'))};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("settings")[0][0], "avoidance.speed, m/s");
  EXPECT_EQ(page.value.at("settings")[0][2], "0.5");
  EXPECT_THAT(page.value.at("checks")[0][0].get<std::string>(), testing::EndsWith("/seed1 no collision"));
}

TEST(AgainstData, MatchesFlightsWithOtherSettingsByScenarioAndSeed) {
  const TemporaryFolder folder;
  auto records = made_up(4, 10);  // four seeds of one scenario
  write_sweep(folder.path() / "before", records);
  std::ranges::reverse(records);
  for (FlightRecord& record : records) record.order.id += "_set";
  write_sweep(folder.path() / "now", records);
  const auto data = against_data(read_flights(folder.path() / "now"), read_flights(folder.path() / "before"));
  EXPECT_THAT(data.at("gone"), IsEmpty());
  for (size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(data.at("flights")[i].at("time_s"), records[i].result->flight.flight_time_s) << i;
  }
}

/// With 1 of 2 passed, the Wilson interval is 0.5 -+ 0.5 z / sqrt(2 + z^2).
TEST(AgainstData, HasNoChangeIfABatchWasStoppedDependingOnItsResults) {
  const TemporaryFolder folder;
  write_sweep(folder.path(), made_up(2, 11));
  const FlightList flights = read_flights(folder.path());
  EXPECT_FALSE(against_data(flights, flights).at("groups")[0].at("change").is_null());
  EXPECT_TRUE(against_data(flights, flights).at("no_change").is_null());
  const auto data = against_data(flights, flights, {.before = true});
  EXPECT_THAT(data.at("no_change").get<std::string>(), HasSubstr("--until"));
  for (const auto& group : data.at("groups")) EXPECT_TRUE(group.at("change").is_null());
  const double before = data.at("groups")[0].at("before").at("low"), now = data.at("groups")[0].at("now").at("low");
  constexpr double kZ = 1.959964;
  EXPECT_NEAR(now, 0.5 - 0.5 * kZ / std::sqrt(2.0 + kZ * kZ), 1e-6);
  EXPECT_LT(before, now) << "valid at any time, so wider";
}

}  // namespace
}  // namespace hedgehop::sim
