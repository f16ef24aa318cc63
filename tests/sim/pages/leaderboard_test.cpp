#include "sim/pages/leaderboard_page.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "avoidance/registry.h"
#include "sim/batch/campaign_file.h"
#include "sim/batch/flight_table.h"
#include "sim/config/whole_file.h"
#include "sim/fields/field_types.h"
#include "sim/pages/campaign_report.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

/// Two worlds: fast modules reach the near goal; no module reaches the far goal in time. One module cannot fly in one
/// world.
class LeaderboardFolder : public CampaignFolder {
 public:
  LeaderboardFolder() {
    for (const std::string name : {"far", "near"}) {
      write(name + ".yaml", "use: tiny.yaml\nname: " + name +
                                "\nduration: 2.5\nstart: {spread: 0}\ngoal: {north: " + (name == "far" ? "7" : "2.5") +
                                "}\nchecks: [{check: reached_goal}, {check: no_collision}]\n");
    }
    write("board.yaml",
          "description: three speeds\ntuned_on: none\nleaderboard:\n  seeds: 1:2\n  worlds: [{name: far, scenario: "
          "far.yaml}, {name: near, "
          "scenario: near.yaml}]\n"
          "  modules:\n    - {name: still, control: true, set: [avoidance.speed=0.01]}\n"
          "    - {name: fast, set: [avoidance.speed=2]}\n    - {name: slow, set: [avoidance.speed=0.1]}\n"
          "  not_flown: [{module: slow, worlds: [far], reason: too far}]\n");
  }
};

const Json& cell(const Json& data, const std::string& world, const std::string& module) {
  return *std::ranges::find_if(data.at("cells"),
                               [&](const Json& c) { return c.at("world") == world && c.at("module") == module; });
}

TEST(Leaderboard, OrdersWorldsByTheFailuresOfTheModulesWithoutTheControl) {
  const LeaderboardFolder folder;
  const CommandEnd end = folder.hedgehop("batch board.yaml --out out");
  ASSERT_EQ(end.status, 1) << end.err;
  const Json data = leaderboard_data(folder.path() / "out", read_flights(folder.path() / "out"));
  EXPECT_EQ(data.at("worlds").at(0).at("name"), "near");
  EXPECT_EQ(data.at("worlds").at(0).at("difficulty"), 0.5);  // fast 2 of 2, slow 0 of 2
  EXPECT_EQ(data.at("worlds").at(1).at("difficulty"), 1.0);  // fast 0 of 2
  EXPECT_EQ(cell(data, "near", "fast").at("passed"), 2);
  EXPECT_EQ(cell(data, "near", "fast").at("flights"), 2);
  EXPECT_EQ(cell(data, "far", "slow").at("reason"), "too far");
  EXPECT_FALSE(cell(data, "far", "slow").contains("passed"));
  // Wilson interval by hand: for 2 of 2 with z = 1.96, the lower end is 2 / (2 + z^2).
  EXPECT_NEAR(cell(data, "near", "fast").at("low").get<double>(), 2.0 / (2.0 + 1.959964 * 1.959964), 1e-6);
  EXPECT_THAT(end.out, HasSubstr("| near | 0.50 | 0 of 2 (0.00 to 0.66) | 2 of 2 (0.34 to 1.00) | 0 of 2"));
  EXPECT_THAT(end.out, HasSubstr("Not flown: slow in far: too far.\n"));
  EXPECT_THAT(end.out, HasSubstr("| fast | 2 | 4 | 2 | 0 | 0.000 to 0.490 |"));
  EXPECT_THAT(end.out, HasSubstr("| slow | 1 | 2 | 0 | 0 | 0.000 to 0.658 |"));
  // 0 of 4 by hand: the upper end is z^2 / (4 + z^2).
  EXPECT_NEAR(data.at("totals").at(1).at("collided_high").get<double>(), 3.841459 / (4.0 + 3.841459), 1e-6);
  EXPECT_THAT(folder.json("out/batch.json").at("flights"), testing::SizeIs(10));
}

TEST(Leaderboard, FlightsOfABadWorldAreNeitherPlannedNorCounted) {
  const LeaderboardFolder folder;
  folder.write("far.yaml", folder.read("far.yaml") + "foo: 1\n");
  ASSERT_EQ(folder.hedgehop("batch board.yaml --no-report --out out").status, 2);
  const FlightList flights = read_flights(folder.path() / "out");
  const Json counts = claims_data(folder.path() / "out", flights.records, {"near still", "far still"}).at("counts");
  EXPECT_EQ(counts, Json::parse(R"({"planned": 4, "counted": 4, "passed": 2, "failed_a_check": 2, "broken": 0,
                                    "missing": 0, "discarded": 0, "no_checks": 0})"));
  const Json data = leaderboard_data(folder.path() / "out", flights);
  EXPECT_TRUE(data.at("worlds").at(1).at("difficulty").is_null());
  EXPECT_EQ(data.at("totals").at(1).at("broken"), 0);
  EXPECT_THAT(leaderboard_text(data), HasSubstr("| far | - | missing | missing | not flown |"));
}

/// For 4 of 4 flights that pass, the Wilson interval begins at 4 / (4 + z^2). 5 flights without an event show 0.5.
TEST(ClaimsData, RefusedFilesAreNeitherPlannedNorCounted) {
  const CampaignFolder folder;
  folder.write("bad.yaml", "use: tiny.yaml\nname: bad\nfoo: 1\n");
  const auto claims = [&](const std::string& options) {
    EXPECT_EQ(folder.hedgehop("batch bad.yaml tiny.yaml --no-report --out out " + options).status, 2);
    return claims_data(folder.path() / "out", read_flights(folder.path() / "out").records);
  };
  const Json all = claims("--seeds 5:8"), stopped = claims("--seeds 5:12 --until 'collision < 0.5'");
  EXPECT_EQ(all.at("counts"), Json::parse(R"({"planned": 4, "counted": 4, "passed": 4, "failed_a_check": 0, "broken": 0,
                                              "missing": 0, "discarded": 0, "no_checks": 0})"));
  EXPECT_NEAR(all.at("interval")[0].get<double>(), 4.0 / (4.0 + 1.959964 * 1.959964), 1e-6);
  EXPECT_EQ(stopped.at("counts"),
            Json::parse(R"({"planned": 8, "counted": 5, "passed": 5, "failed_a_check": 0, "broken": 0,
                            "missing": 0, "discarded": 3, "no_checks": 0})"));
}

TEST(LeaderboardInBrowser, ShowsEveryCellAndSelectsItsFlights) {
  HEDGEHOP_NEEDS_BROWSER();
  const LeaderboardFolder folder;
  ASSERT_EQ(folder.hedgehop("batch board.yaml --out out").status, 1);
  ASSERT_EQ(folder.hedgehop("report out").status, 0);
  const PageVisit page = visit(folder.path() / "out/report.html", R"js(
    const rows = [...document.querySelectorAll('.board tbody tr')].map((tr) => [...tr.children].map((td) => td.textContent));
    document.querySelectorAll('.board tbody tr')[0].children[3].click();
    const plots = [...document.querySelectorAll('#collisions-card figcaption')].map((e) => e.textContent);
    const canvas = document.querySelector('#collisions-card figure canvas'), box = canvas.getBoundingClientRect();
    const tips = new Set();
    for (let x = 0; x < box.width; x += 15) {  // a text is shown within 12 px
      for (let y = 0; y < box.height; y += 15) {
        canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: box.left + x, clientY: box.top + y}));
        const tip = canvas.nextSibling;
        if (!tip.hidden) tips.add(tip.textContent);
      }
    }
    const key = [...document.querySelectorAll('#collisions-card .plan-key span')].map((e) => e.textContent);
    const head = [...document.querySelectorAll('#head .tile .name, #head strong')].map((e) => e.textContent);
    const paths = [...document.querySelectorAll('#paths .plan-key span')].map((e) => e.textContent);
    const scene = document.querySelector('#scene').selectedOptions[0].textContent;
    const claims = document.getElementById('claims-card').textContent, text = document.getElementById('head').textContent;
    return {head, claims, text, paths, scene, plots, key, tips: [...tips].join(), rows, why: document.querySelector('#board-card > p:last-child').textContent, shown: [...document.querySelectorAll('#flights tbody td:first-child')].map((e) => e.textContent)};)js");
  EXPECT_THAT(page.errors, testing::IsEmpty());
  EXPECT_EQ(page.value.at("head"), Json::array({"4 of 6 did not pass", "fast", "slow", "still (control)"}));
  EXPECT_THAT(page.value.at("text").get<std::string>(),
              AllOf(HasSubstr("three speeds"), HasSubstr("; without the control"),
                    HasSubstr("10 flights, 4 of them of the control")));
  EXPECT_THAT(page.value.at("claims").get<std::string>(),
              HasSubstr("Without the control: 6 planned, 6 counted, 2 passed, 4 failed a check"));
  ASSERT_EQ(page.value.at("rows").size(), 2u);
  EXPECT_EQ(page.value.at("rows")[0][0], "near");
  EXPECT_THAT(page.value.at("rows")[0][3].get<std::string>(), HasSubstr("2 of 2 0.34 to 1.00"));
  EXPECT_EQ(page.value.at("rows")[1][4], "not flown");
  EXPECT_EQ(page.value.at("why"), "Not flown in far: slow: too far.");
  EXPECT_EQ(page.value.at("plots"), Json::array({"all worlds", "near", "far"}));
  EXPECT_EQ(page.value.at("key"), Json::array({"still (control)", "fast", "slow, flies in 1 of 2 worlds"}));
  EXPECT_THAT(page.value.at("tips").get<std::string>(), HasSubstr("0 of 4 collided, 95 % interval 0.000 to 0.490"));
  EXPECT_EQ(page.value.at("shown"), Json::array({"near_fast/seed1", "near_fast/seed2"}));
  EXPECT_EQ(page.value.at("paths")[0], "fast") << "the module, of the flights that the filter leaves";
  EXPECT_EQ(page.value.at("scene"), "1 of 1: far, near, seeds 1:2, 2 flights");
}

TEST(LeaderboardInBrowser, FiltersByExactGroupsAndSeeds) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  std::vector<FlightRecord> records{{.status = FlightRecord::Status::flown}};
  records[0].order = {.id = "a", .group = "a", .scenario = "a.yaml"};
  records[0].result.emplace().flight.flight_time_s = 3.0;
  write_file_whole(folder.path() / "batch.csv", flight_table(records).csv());
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const column = (name, is_text, values) => ({name, unit: '', is_text, values}), words = ['', '', ''];
    const table = new FlightTable({why: words, failed: words, columns: [column('id', true, ['so_far_a/seed1', 'far_a/seed1', 'b']),
      column('group', true, ['so_far_a', 'far_a', 'two words']), column('outcome', true, ['reached', 'reached', 'reached']),
      column('seed', false, ['18446744073709551615', '18446744073709551614', '7'])]});
    const rows = (text) => filteredRows(table, parseFilter(table, text).terms), shown = [];
    for (const [world, group] of [['far', 'far_a'], ['two', 'two words']]) {
      boardCell({world, module: 'a', group, passed: 1, flights: 1, flown: 1, collided: 0, low: 0, high: 1, broken: 0, median_clearance_m: 1, path_excess: 0,
        mean_speed_mps: 1, decision_ms: 1}, {filter: (text) => shown.push(rows(text))}).click();
    }
    return {shown, seed: rows('seed=18446744073709551615'), less: rows('seed<18446744073709551615'), seven: rows('seed=7.0'),
            sorted: sortedRows([0, 1, 2], table.columns.get('seed'), false), list: seedList([0, 1, 2].map((row) => table.seed(row)))};)js");
  EXPECT_THAT(page.errors, testing::IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse(
                            R"({"shown": [[1], [2]], "seed": [0], "less": [1, 2], "seven": [2], "sorted": [2, 1, 0],
                                "list": "7,18446744073709551614:18446744073709551615"})"));
}

TEST(Leaderboard, IsEqualAfterFailedFlightsAreFlownAgain) {
  const LeaderboardFolder folder;
  ASSERT_EQ(folder.hedgehop("batch board.yaml --out out").status, 1);
  const std::string whole = lasting_columns(folder.read("out/batch.csv")), matrix = folder.read("out/leaderboard.md");
  EXPECT_EQ(folder.hedgehop("batch --failed-only --out out").status, 1);
  EXPECT_EQ(lasting_columns(folder.read("out/batch.csv")), whole);
  // Only the last value of a row, a time, may differ.
  EXPECT_EQ(folder.read("out/leaderboard.md").substr(0, matrix.find("path excess")),
            matrix.substr(0, matrix.find("path excess")));
  EXPECT_EQ(folder.hedgehop("batch tiny.yaml --out out").status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/leaderboard.json"));
}

/// Cells of an interrupted batch are missing instead of 0 of 0, and do not make a world difficult.
TEST(Leaderboard, CellsNotFlownYetAreMissingAndDoNotCountForDifficulty) {
  const TemporaryFolder folder;
  const LeaderboardConfig config{
      .seeds = "1", .worlds = {{"later", "a.yaml"}, {"lost", "b.yaml"}}, .modules = {{.name = "m"}}};
  Leaderboard board = leaderboard_of(config);
  std::vector<FlightRecord> records(2);
  for (size_t i = 0; i < 2; ++i) {
    board.cells[i].group = records[i].order.group = records[i].order.id = board.cells[i].world;
  }
  records[1].status = FlightRecord::Status::failed;
  write_leaderboard(folder.path(), board);
  write_file_whole(folder.path() / "batch.csv", flight_table(records).csv());
  Json data = leaderboard_data(folder.path(), read_flights(folder.path()));
  EXPECT_FALSE(cell(data, "later", "m").contains("passed"));
  EXPECT_EQ(cell(data, "lost", "m").at("broken"), 1);
  EXPECT_EQ(data.at("worlds").at(0).at("name"), "lost");
  EXPECT_TRUE(data.at("worlds").at(1).at("difficulty").is_null());
  EXPECT_THAT(leaderboard_text(data), HasSubstr("| later | - | missing |"));
  EXPECT_THAT(leaderboard_text(data), HasSubstr("| m | 2 | 1 | 0 | 0 of 0 | - | - |"));
  for (Json& one : data.at("cells")) one["min_clearance_m"] = -0.002;
  EXPECT_THAT(leaderboard_text(data), AllOf(HasSubstr(" 0.00 |"), Not(HasSubstr("-0.00"))));
}

/// Three flights without checks collide, one with checks passes, one ends by a fault: Wilson interval of 3 of 4 by
/// hand.
TEST(Leaderboard, CollisionsReferToAllFlightsWithoutAFault) {
  const TemporaryFolder folder;
  Leaderboard board = leaderboard_of({.seeds = "1", .worlds = {{"w", "a.yaml"}}, .modules = {{.name = "m"}}});
  board.cells[0].group = "w_m";
  std::vector<FlightRecord> records(5);
  for (size_t i = 0; i < 5; ++i) {
    records[i].order.id = "f" + std::to_string(i);
    records[i].order.group = "w_m";
    records[i].status = FlightRecord::Status::flown;
    FlightResult& flight = records[i].result.emplace().flight;
    flight.outcome = i < 3 ? Outcome::collided : i == 3 ? Outcome::reached : Outcome::fault;
    if (i == 3) flight.checks = {{.name = "reached_goal", .passed = true, .unit = "m"}};
  }
  write_leaderboard(folder.path(), board);
  write_file_whole(folder.path() / "batch.csv", flight_table(records).csv());
  const std::string text = leaderboard_text(leaderboard_data(folder.path(), read_flights(folder.path())));
  EXPECT_THAT(text, HasSubstr("| m | 1 | 2 | 1 | 3 of 4 | 0.301 to 0.954 |"));
  EXPECT_THAT(text, HasSubstr("| w | m | 2 | 1 | 3 of 4 | 0 | 1 |"));
  EXPECT_THAT(text,
              HasSubstr("Collisions of m: among its 4 flights without a fault, with or without checks; fault or no "
                        "result: 1.\n"));
}

TEST(Leaderboard, RejectsUnknownAndRepeatedNames) {
  LeaderboardConfig config{.seeds = "1",
                           .worlds = {{"a", "a.yaml"}, {"a", "b.yaml"}},
                           .modules = {{.name = "m"}},
                           .not_flown = {{"other", "", {"c"}}}};
  try {
    leaderboard_of(config);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.errors(),
                ElementsAre("leaderboard: 'a' occurs twice", "leaderboard: no module 'other'",
                            "leaderboard: 'other' is not flown without a reason", "leaderboard: no world 'c'"));
  }
}

TEST(Leaderboard, ShippedFileHasEveryModuleAndAFlightOrReasonForEachCell) {
  const BatchOrders batch = read_batch({HEDGEHOP_SOURCE_DIR "/configs/campaigns/leaderboard.yaml"}, {}, {});
  EXPECT_THAT(batch.faults, testing::IsEmpty());
  ASSERT_TRUE(batch.leaderboard);
  for (const LeaderboardCell& c : batch.leaderboard->cells) {
    EXPECT_NE(c.group.empty(), c.reason.empty()) << c.world << ", " << c.module;
  }
  std::vector<std::string> flown;
  for (const LeaderboardModule& module : batch.leaderboard->modules) flown.push_back(module.name);
  std::vector<std::string> all;
  fields::for_each_alternative<avoidance::ModuleConfig>([&]<class A>() { all.emplace_back(A::kName); });
  std::ranges::replace(all, std::string("onnx_policy"),
                       std::string("cloned_policy"));  // listed under the name of the network
  EXPECT_THAT(flown, testing::UnorderedElementsAreArray(all));
}

}  // namespace
}  // namespace hedgehop::sim
