#include <gmock/gmock.h>

#include "sim/falsify/box_constraints.h"
#include "sim/falsify/counterexample.h"
#include "sim/record/table.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Lt;

/// A vehicle without a camera that flies straight north, and boxes that may block its path.
class Falsify : public ::testing::Test {
 protected:
  Falsify() {
    folder.write(
        "straight.yaml",
        "name: straight\nduration: 12\nscene: {type: park, extent: 60, trees: 0, bushes: 0, rocks: 0, vehicles: "
        "0, texture_size: 64}\n"
        "vehicle: {use: " HEDGEHOP_SOURCE_DIR
        "/configs/vehicles/s900.yaml}\nvelocimeter: {enabled: false}\n"
        "start: {north: 0, east: 0, altitude: 5}\ngoal: {north: 20, east: 0, altitude: 5, radius: 1}\n"
        "avoidance: {module: go_to_goal, speed: 3}\nfilm: {enabled: false}\ndrawing: {renderer: tiles}\n"
        "checks: [{check: formula, name: keeps_clear, formula: 'always (obstacle_clearance >= 0.5)'}]\n");
    folder.write("search.yaml", search(""));
  }
  static std::string search(const std::string& design) {
    return "scenario: straight.yaml\nseeds: 1101:1101\nrobustness: [keeps_clear]\n"
           "design: {budget: 60, failures: 2" +
           design +
           "}\n"
           "boxes: {count: 2, north: [4, 16], east: [-14, 14], length: [1, 3], width: [1, 3], heading: [0, 90]}\n"
           "constraints: [boxes_inside, boxes_apart, way_exists]\n"
           "parameters: [{path: wind.speed, from: 0, to: 4, neutral: 0}]\n";
  }
  CampaignFolder folder;
};

/// A check that is not searched fails in every flight.
TEST_F(Falsify, PageCountsAndNamesTheSearchedChecks) {
  HEDGEHOP_NEEDS_BROWSER();
  folder.write("search.yaml",
               search("") +
                   "description: purpose of the search\nset: ['checks=[{check: formula, name: keeps_clear, formula: "
                   "\"always (obstacle_clearance >= 0.5)\"}, {check: max_speed, at_most: 0.1}]']\n");
  const CommandEnd end = folder.hedgehop("falsify search.yaml --out out -j 2 --set design.budget=3");
  ASSERT_LE(end.status, 1) << end.err;
  EXPECT_EQ(folder.json("out/falsify.json").at("checks"), nlohmann::ordered_json::array({"keeps_clear"}));
  const PageVisit page = visit(folder.path() / "out/report.html", R"js(
    const data = JSON.parse(document.getElementById('data').textContent);
    const holds = data.columns.find(({name}) => name === 'robustness').values.filter((v) => v >= 0).length;
    return [document.querySelector('.tile').textContent, holds, document.getElementById('search-card').textContent, data.groups[0].passed,
      document.querySelector('h1').nextSibling.textContent];)js");
  EXPECT_THAT(page.errors, ::testing::IsEmpty());
  EXPECT_EQ(page.value[3], 0) << "flights in which all checks hold";
  EXPECT_EQ(page.value[4], "purpose of the search");
  EXPECT_GT(page.value[1], 0);
  EXPECT_THAT(page.value[0].get<std::string>(),
              HasSubstr("searched checks hold" + std::to_string(page.value[1].get<int>()) + " of "));
  EXPECT_THAT(page.value[2].get<std::string>(), HasSubstr("minimum over keeps_clear; "));
}

TEST_F(Falsify, FindsConfirmsShrinksAndStoresFailures) {
  const CommandEnd end = folder.hedgehop("falsify search.yaml --out out -j 2");
  ASSERT_EQ(end.status, 1) << end.out << end.err;
  const auto json = folder.json("out/falsify.json");
  ASSERT_EQ(json["counterexamples"].size(), 2u);
  EXPECT_THAT(end.out, HasSubstr("confirmed: 2 of 2, flown again alone"));
  for (const auto& one : json["counterexamples"]) {
    EXPECT_TRUE(one["repeats"].get<bool>());
    EXPECT_TRUE(one["confirmed"].get<bool>());
    EXPECT_EQ(one["items"], 1);  // one box on the path is enough
    EXPECT_EQ(one["items_before"], 2);
    EXPECT_LE(one["shrinking_flights"].get<int>(), 60);
    // Flown as a test, the stored scenario fails with the trajectory that its origin states.
    const std::string file = "out/" + one["file"].get<std::string>();
    EXPECT_EQ(folder.hedgehop("run " + file + " --out kept").status, 1);
    const auto kept = folder.json("kept/result.json");
    EXPECT_EQ(kept["trajectory_hash"], one["trajectory_hash"]);
    const auto hash = one["trajectory_hash"].get<std::string>();  // quoted if it could be read as a number
    EXPECT_THAT(folder.read(file),
                AnyOf(HasSubstr("trajectory_hash: " + hash), HasSubstr("trajectory_hash: \"" + hash + "\"")));
    EXPECT_THAT(folder.read(file), HasSubstr("  speed: 0\n"));  // wind is not needed
  }
}

TEST_F(Falsify, TableIsTheSameForAnyNumberOfWorkersAndAfterAKill) {
  const std::string search_only =
      "falsify search.yaml --set design.shrinking=1";  // shrinking does not change the table
  ASSERT_EQ(folder.hedgehop(search_only + " --out one -j 1").status, 1);
  ASSERT_EQ(folder.hedgehop(search_only + " --out four -j 4").status, 1);
  const std::string whole = lasting_columns(folder.read("one/falsify.csv"));
  EXPECT_EQ(lasting_columns(folder.read("four/falsify.csv")), whole);
  const std::string worker = folder.worker(
      "n=1; while ! mkdir flown$n 2>/dev/null; do n=$((n + 1)); done\n"
      "[ $n = 3 -o $n = 9 ] && kill -KILL $PPID; fly \"$@\"");
  const std::string command = search_only + " --out torn -j 2 --program " + worker;
  for (int i = 0; i < 2; ++i) EXPECT_NE(folder.hedgehop(command).status, 1);
  EXPECT_EQ(folder.hedgehop(command).status, 1);
  EXPECT_EQ(lasting_columns(folder.read("torn/falsify.csv")), whole);
}

TEST_F(Falsify, WithoutAFailureExitsWithZeroAndClaimsNoProof) {
  const CommandEnd end = folder.hedgehop(
      "falsify search.yaml --out out --set 'boxes.east=[8,14]' --set parameters=[] --set design.budget=6");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("no failure in 6 flights, which is no proof of safety"));
  const Table table(folder.path() / "out/falsify.csv");
  EXPECT_EQ(table.rows(), 6u);
  EXPECT_THAT(table.numbers("robustness"), Each(::testing::Ge(0.0)));
}

TEST_F(Falsify, EveryMethodKeepsItsBudgetAndIsRepeatable) {
  for (const std::string method : {"random", "direct"}) {
    const std::string set = " --set design.shrinking=1 --set design.method=" + method +
                            " --set 'constraints=[]' --set 'boxes={count: 1, north: [10, 10], east: [-14, 14]}'";
    EXPECT_EQ(folder.hedgehop("falsify search.yaml --out " + method + set).status, 1) << method;
    const Table table(folder.path() / (method + "/falsify.csv"));
    EXPECT_LE(table.rows(), 60u);
    EXPECT_EQ(folder.hedgehop("falsify search.yaml --out again-" + method + set).status, 1);
    EXPECT_EQ(lasting_columns(folder.read("again-" + method + "/falsify.csv")),
              lasting_columns(folder.read(method + "/falsify.csv")));
  }
}

TEST_F(Falsify, RejectsBadInputInOneLineBeforeAnyFlight) {
  const auto fault = [&](const std::string& set) {
    const CommandEnd end = folder.hedgehop("falsify search.yaml --out none --set '" + set + "'");
    EXPECT_EQ(end.status, 2) << set;
    EXPECT_EQ(std::ranges::count(end.err, '\n'), 1) << end.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "none"));
    return end.err;
  };
  EXPECT_THAT(fault("design.budget=0"), HasSubstr("'design.budget': must be >= 1, got 0"));
  EXPECT_THAT(fault("seeds=1:100"), HasSubstr("60 flights are fewer than the 100 seeds of one point"));
  EXPECT_THAT(fault("robustness=[keep_clear]"), HasSubstr("has no check 'keep_clear'; did you mean 'keeps_clear'?"));
  EXPECT_THAT(fault("boxes.east=[14,-14]"), HasSubstr("'boxes.east': the lower end must come first"));
  EXPECT_THAT(fault("parameters=[{path: wind.speed, from: 3, to: 1}]"), HasSubstr("'from' must be less than 'to'"));
  EXPECT_THAT(fault("parameters=[{path: wind.sped, from: 0, to: 1}]"), HasSubstr("did you mean 'speed'?"));
  EXPECT_THAT(fault("score=sbt"),
              HasSubstr("unknown choice 'sbt' for 'score'; did you mean 'sbft'? allowed: robustness, sbft"));
  EXPECT_THAT(fault("design.method=direct"), HasSubstr("'direct' supports up to 5 unknowns; there are 11"));
  EXPECT_THAT(fault("set=[\"checks.0.formula=always (clearence > 1)\"]"), HasSubstr("did you mean 'clearance'?"));
  EXPECT_THAT(fault("set=[\"checks.0.formula=always[0,20] (clearance > 1)\"]"),
              HasSubstr("looks 20 s ahead, which is longer than the flight (12 s)"));
}

TEST_F(Falsify, TheCompetitionsScoreFixesSeedsChecksAndConstraints) {
  const CommandEnd end = folder.hedgehop("falsify search.yaml --out none --set score=sbft --set constraints=[]");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("search.yaml:2:8: 'seeds': 'score: sbft' flies the scenario's seed"));
  EXPECT_THAT(end.err, HasSubstr("search.yaml:3:13: 'robustness' has no effect with 'score: sbft'"));
  EXPECT_THAT(end.err, HasSubstr("'score: sbft' requires the constraint 'boxes_apart'"));
}

TEST_F(Falsify, FlightsThatAreNotFlownLeaveTheSearchUndecided) {
  const std::string clear = "falsify search.yaml --set 'boxes.east=[8,14]' --set parameters=[] --set design.budget=6";
  const std::string worker = folder.worker("mkdir first 2>/dev/null && exit 2; fly \"$@\"");
  const CommandEnd end = folder.hedgehop(clear + " --out some -j 1 --program " + worker);
  EXPECT_EQ(end.status, 4) << end.out;
  EXPECT_THAT(end.out, HasSubstr("1 of 6 flights were not flown"));
  EXPECT_THAT(end.out, HasSubstr("no failure in 5 flights"));
  EXPECT_EQ(folder.json("some/falsify.json")["flights_not_flown"], 1);
  // Flights without results confirm no failure.
  const std::string dead = folder.worker("kill -KILL $$");
  const CommandEnd none = folder.hedgehop("falsify search.yaml --set design.budget=4 --out none --program " + dead);
  EXPECT_EQ(none.status, 4) << none.out;
  EXPECT_EQ(folder.json("none/falsify.json")["failures"], 0);
}

TEST_F(Falsify, RejectsTheFolderOfAnotherSearch) {
  ASSERT_EQ(folder.hedgehop("falsify search.yaml --out out --set design.budget=3 --set boxes.east=[8,14]").status, 0);
  folder.write("search.yaml", search(", seed: 2"));
  const CommandEnd end = folder.hedgehop("falsify search.yaml --out out");
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.err, HasSubstr("out: holds a search of another file, or of this one before it or a --set was"));
  folder.write("out/falsify.json", "{\n");
  EXPECT_EQ(folder.hedgehop("falsify search.yaml --out out").err,
            "out/falsify.json:2:1: is not complete JSON; choose another --out, or remove the file\n");
}

TEST_F(Falsify, CountsOnlyPointsThatViolateAConstraintAsInfeasible) {
  const CommandEnd end = folder.hedgehop(
      "falsify search.yaml --out out --set constraints=[] --set 'boxes.east=[8,14]' --set parameters=[]");
  EXPECT_EQ(end.status, 0) << end.err;
  EXPECT_EQ(folder.json("out/falsify.json")["infeasible_points"], 0);
}

TEST_F(Falsify, ReductionKeepsRangesAndConstraints) {
  const std::vector<std::string> set = {"constraints=[box_on_route]", "boxes.north=[4.3,16]", "boxes.heading=[0,0]"};
  const FalsifySearch search = read_falsify(folder.path() / "search.yaml", set);
  // North, east, length and width of each box, then the wind: the first box is on the route.
  const FalsifyTrial trial{.coordinates = {},
                           .values = {"4.4", "0.2", "2.5", "2.5", "12.3", "12.4", "2.5", "2.5", "3.3"},
                           .flown = true,
                           .weakest = {"keeps_clear", -1.0}};
  FlightRecord failing{.status = FlightRecord::Status::flown};
  failing.order.seed = 1101;
  failing.result.emplace().flight.outcome = Outcome::timeout;
  failing.result->flight.checks = {
      {.name = "keeps_clear", .passed = false, .value = -1.0, .limit = 0.0, .must = ">=", .t_s = 3.0}};
  const FlyOne every_flight_fails = [&](const Order& order) {
    FlightRecord record = failing;
    record.order = order;
    return std::optional(record);
  };
  const Shrunk shrunk = shrink(search, trial, failing, folder.path() / "shrink", 60, every_flight_fails);
  const auto boxes = std::visit([](const auto& scene) { return scene.added.boxes; }, shrunk.scenario.scene);
  ASSERT_EQ(boxes.size(), 1u) << "without a box, none is on the route";
  EXPECT_EQ(violation(search, boxes), 0.0);
  EXPECT_DOUBLE_EQ(boxes[0].north_m, 4.4) << "4 is outside the range";
}

TEST_F(Falsify, ARepeatThatWasNotFlownIsNull) {
  const FalsifySearch search = read_falsify(folder.path() / "search.yaml");
  FalsifyResult result;
  result.trials.resize(1);
  result.trials[0].weakest = {"keeps_clear", -1.0};
  result.records.resize(1);
  const auto repeat = [&](Repeat repeats) {
    Counterexample found;
    found.repeats = repeats;
    return nlohmann::json::parse(falsify_json(search, result, {found}))["counterexamples"][0]["repeats"];
  };
  EXPECT_EQ(repeat(Repeat::equal), true);
  EXPECT_EQ(repeat(Repeat::differs), false);
  EXPECT_TRUE(repeat(Repeat::not_flown).is_null());
}

}  // namespace
}  // namespace hedgehop::sim
