#include <gmock/gmock.h>

#include <set>

#include "sim/batch/flight_table.h"
#include "sim/config/whole_file.h"
#include "sim/pages/campaign_changes.h"
#include "sim/pages/campaign_data.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/figure_plot.h"
#include "sim/pages/report.h"
#include "sim/pages/report_page.h"
#include "sim/pages/runs_page.h"
#include "sim/record/result_files.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/run_folder.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// An optimizer's points over two parameters, both named speed: the first three flights collide, the last one ends by a
/// fault.
std::vector<FlightRecord> write_speeds(const std::filesystem::path& folder) {
  std::vector<FlightRecord> records(4);
  std::vector<std::string> points;
  for (size_t i = 0; i < records.size(); ++i) {
    points.push_back("p" + std::to_string(i));
    records[i].status = FlightRecord::Status::flown;
    records[i].order = {.id = "flights/" + points[i], .group = "point " + points[i], .scenario = "room.yaml"};
    FlightResult& result = records[i].result.emplace().flight;
    result.outcome = i < 3 ? Outcome::collided : Outcome::fault;
    result.flight_time_s = 0.62155 + 0.00005 * static_cast<double>(i);
    result.cause = i < 3 ? "hit tree at 0.622 s" : "the module failed in `look`";
    result.checks = {{.name = "min_clearance", .passed = false, .value = 0.1, .limit = 1.0, .unit = "m", .t_s = 0.1},
                     {.name = "no_collision", .passed = i == 3, .value = 0.0, .limit = 0.0, .unit = "m", .t_s = 0.6}};
  }
  write_file_whole(folder / "sweep.csv",
                   flight_table(records, {{.name = "point", .values = points},
                                          {.name = "avoidance.speed", .values = std::vector{1.5, 1.4997, 1.5, 1.4997}},
                                          {.name = "wind.speed", .values = std::vector{1.0, 1.0, 2.0, 2.0}}})
                       .csv());
  write_file_whole(folder / "sweep.json", R"({"design": "optimize", "minimize": "flight_time_s", "failure_cost": 1e6,
    "parameters": [{"path": "avoidance.speed", "log": false}, {"path": "wind.speed", "log": false}]})");
  return records;
}

TEST(ReadNotes, CountACollisionBeforeAClearanceThatFailedEarlier) {
  const TemporaryFolder folder;
  const auto notes = read_notes(folder.path(), write_speeds(folder.path()));
  EXPECT_EQ(notes[0].first_failed, "no_collision");
  EXPECT_EQ(notes[3].first_failed, "min_clearance");
}

TEST(CampaignPlotsInBrowser, DistinguishesNumbersAndNamesOfAxes) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_speeds(folder.path());
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const drawn = [], {fillText} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { drawn.push(text); fillText.call(this, text, ...at); };
    const axes = new Axes(document.body.appendChild(make('div')), 400, {draw: () => {}, hover: () => null, pick: () => {}});
    axes.set(numberAxis('x', [0, 1]), numberAxis('y', [-0.0123456, -0.0123451]));
    const data = JSON.parse(document.getElementById('data').textContent), points = new SweepPoints(data, new FlightTable(data));
    const name = (id) => document.querySelector(`#${id} canvas`).ariaLabel;
    const low = new Axes(document.body.appendChild(make('div')), 230, {draw: () => {}, hover: () => null, pick: () => {}});
    low.set({...numberAxis('flight', [1, 1]), whole: true}, numberAxis('y', [-0.33, 0.86]));
    const values = (axis, pixels) => low.ticks(axis, pixels, 16).map(({value}) => value);
    return {whole: values(low.xAxis, 1200), rises: values(low.yAxis, low.frame.height).length, counts: [countOf(1, 'flight'), countOf(0, 'flight')],
            group: groupWords('point 000000 wind.speed=1.071013152100261'), ticks: new Set(drawn.filter((text) => text.startsWith('−0.0123'))).size, left: axes.frame.x,
            levels: parameterBins(points, 0).words, ends: tickTexts([0.62155, 0.6216, 0.62165]), heat: name('heat-card'), parallel: name('parallel-card'),
            convergence: document.getElementById('convergence-card').textContent, plots: document.querySelectorAll('#convergence-card canvas').length,
            ink: ['rgb(240,96,42)', 'rgb(10,95,160)'].map(inkOn), worst: document.getElementById('worst').textContent};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("whole"), nlohmann::json::array({1})) << "a flight has a whole number";
  EXPECT_GE(page.value.at("rises"), 2) << "one tick gives no scale";
  EXPECT_EQ(page.value.at("counts"), nlohmann::json::array({"1 flight", "0 flights"}));
  EXPECT_EQ(page.value.at("group"), "wind.speed=1.071");
  EXPECT_GE(page.value.at("ticks"), 2);
  EXPECT_GT(page.value.at("left"), 62) << "room for long numbers next to the name";
  EXPECT_EQ(page.value.at("levels"), nlohmann::json::parse(R"(["1.4997", "1.5"])"));
  EXPECT_EQ(page.value.at("ends"), nlohmann::json::parse(R"(["0.62155", "0.6216", "0.62165"])"));
  EXPECT_EQ(page.value.at("heat"), "Plot of wind.speed, m/s over avoidance.speed, m/s");
  EXPECT_THAT(page.value.at("parallel").get<std::string>(), HasSubstr("avoidance.speed, m/s, wind.speed, m/s"));
  EXPECT_THAT(page.value.at("convergence").get<std::string>(),
              HasSubstr("over 1 seed; 4 points tried, 4 of them with a failed flight, which costs 1,000,000."));
  EXPECT_EQ(page.value.at("plots"), 0) << "no cost to draw";
  EXPECT_EQ(page.value.at("ink"), nlohmann::json::parse(R"(["#000000", "#ffffff"])")) << "contrast above 4.5";
  EXPECT_THAT(page.value.at("worst").get<std::string>(), HasSubstr("hit tree at 0.622 s"));
  EXPECT_THAT(page.value.at("worst").get<std::string>(), HasSubstr("the module failed in “look”"));
}

TEST(CampaignPlotsInBrowser, KeepsGoalsAndTipsInsideANarrowWindow) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_speeds(folder.path());
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const data = JSON.parse(document.getElementById('data').textContent), table = new FlightTable(data), host = document.body.appendChild(make('div'));
    const none = [0, 1, 2].map(() => []), paths = {maps: [], map: [-1, -1, -1, -1], path: [[0, 0, 1000, 0], ...none], goal: [[60, 30, 4], null, null, null]};
    const {map} = new PathsView(host, make('select'), paths, table, {choose: () => {}});
    const box = map.frame, [x, y] = [map.x(34), map.y(64)];
    map.showTip(10, 10, ['a_long_name_of_a_flight'.repeat(20), 'in the whole 5.0 s the module reported cruise and commanded 3.0 m/s']);
    addFact(document.querySelector('#claims-card dl'), 'collision: better (candidate against base)', 'undecided: more seeds may be added');
    document.getElementById('head').append(make('p', 'fail', 'Failures injected by the scenario: 20 s to 22 s: camera.front black; ' + 'a'.repeat(80)));
    return {facts: document.querySelector('#claims-card dd:last-child').clientWidth > 200, inside: x <= box.x + box.width && y >= box.y, tip: map.tip.offsetWidth <= host.clientWidth, wide: document.documentElement.scrollWidth};)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse(R"({"facts": true, "inside": true, "tip": true, "wide": 400})"));
}

TEST(ReportInBrowser, NamesTheObstacleOfAPassedCheckAndMetricsOfTheModule) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  const ClosestApproach& closest = flight.result.closest_obstacle = {.distance_m = 1.5, .t_s = 3.0, .what = "tree"};
  flight.result.checks = {{"no_collision", true, closest.distance_m, 0.0, "m", ">", closest.t_s}};
  flight.result.metrics = {{.name = "module.map_margin", .value = 2.0, .unit = "m"},
                           {.name = "module.least_goal_distance_m", .value = 2.0, .unit = "m"},
                           {.name = "jerk_rms", .value = 2.0, .unit = "m/s^3"}};
  write_result_files(run.path(),
                     {.scenario = "one",
                      .command_line = "hedgehop run configs/andert2007_control.yaml --set duration=15 --renderer tiles",
                      .scenario_yaml = run.yaml()},
                     flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const words = [...document.querySelectorAll('.command .whole')].filter((span) => span.offsetHeight > 24 && span.textContent.length < 20);
    return [document.querySelector('.badge').textContent, document.querySelector('#checks').textContent, document.querySelector('#details').textContent,
            wordsOf('off_course_at_end_m', 'm'), document.querySelector('.command code').textContent, document.querySelectorAll('.command .whole').length,
            words.length, document.documentElement.scrollWidth,
            seriesLooks(['left', '', 'rear'].flatMap((role) => ['x', 'x, other run'].map((label) => ({label, role})))).map(({color}) => color)];)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value[0].get<std::string>(), HasSubstr("the check holds"));
  EXPECT_THAT(page.value[1].get<std::string>(), HasSubstr("no collision (tree)"));
  EXPECT_THAT(page.value[2].get<std::string>(), HasSubstr("map margin, reported by the module"));
  EXPECT_THAT(page.value[2].get<std::string>(), HasSubstr("minimum goal distance, reported by the module"));
  EXPECT_THAT(page.value[2].get<std::string>(), HasSubstr("2 m/s³"));
  EXPECT_EQ(page.value[3], "off course at end") << "the unit is next to the value";
  const auto command = page.value[4].get<std::string>();
  EXPECT_EQ(page.value[5], 1 + std::ranges::count(command, ' ')) << "each word of the command stays in one line";
  EXPECT_EQ(page.value[6], 0);
  EXPECT_EQ(page.value[7], 400);
  const auto colors = page.value[8].get<std::vector<std::string>>();
  for (const size_t i : {0U, 2U, 4U}) EXPECT_EQ(colors[i], colors[i + 1]) << "a signal has one color in both runs";
  EXPECT_NE(colors[0], colors[4]);
}

TEST(ReportInBrowser, ShowsAFaultAsBadAlthoughItsChecksHold) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.outcome = Outcome::link_lost;
  flight.result.checks = {{"no_collision", true, 1.5, 0.0, "m", ">"}};
  write_result_files(run.path(), {.scenario = "fault", .seed = 18446744073709551615U, .scenario_yaml = run.yaml()},
                     flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const words = (outcome, goal_distance_m) => judge({outcome, goal_distance_m}).words;
    return [document.querySelector('.badge').className, document.getElementById('verdict').textContent.includes('seed 18446744073709551615,'),
            words('timeout', null), words('timeout', 12), measured(2.0400001, 'm', checkFigures(2.0400001, 2.04, 'm'))];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value,
            nlohmann::json::array({"badge bad", true, "Completed", "Timeout before the goal", "2.0400001 m"}));
}

TEST(ReportInBrowser, NamesTheGroundIfTheFlightHitIt) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  for (TrajectoryRow& row : flight.trajectory) row.ground_clearance_m = 1.5;
  flight.result.outcome = Outcome::collided;
  flight.result.cause = "hit the ground at 10.000 s";
  flight.result.closest_obstacle = {.distance_m = 8.0, .t_s = 2.0, .what = "wall"};
  flight.result.closest_ground = {.distance_m = -0.01, .t_s = 10.0, .what = "ground"};
  write_result_files(run.path(), {.scenario = "low", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const near = {distance_m: 0, what: 'wall'}, far = {distance_m: 8, what: 'wall'}, ground = {distance_m: -0.01, what: 'ground'};
    return [document.getElementById('story').textContent, hitWords({closest_obstacle: far, closest_ground: ground}),
            hitWords({closest_obstacle: near, closest_ground: null}), hitWords({cause: 'hit tree 8 at 3.250 s', closest_obstacle: near, closest_ground: ground})];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value[0].get<std::string>(), HasSubstr("Hit the ground at 10.0 s"));
  EXPECT_THAT(page.value[0].get<std::string>(), HasSubstr("2 s before: clearance to the ground 1.5 m"));
  EXPECT_EQ(page.value[1], "the ground");
  EXPECT_EQ(page.value[2], "wall");
  EXPECT_EQ(page.value[3], "tree 8");
}

/// The page must not hang.
TEST(CampaignPlotsInBrowser, HasFewTicksForEqualNumbersAndDeepZoom) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_speeds(folder.path());
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const ticks = [Array(10).fill(1e17), [12.3, 12.3 + 2e-15], [1e-9, 2e-9], [0, 0]].map((values) => {
      const {low, high} = numberAxis('x', values), {values: marks} = niceTicks(low, high, 6);
      return marks.length >= 2 && marks.length <= 7 && new Set(marks).size === marks.length;
    });
    const map = new MapView(document.body.appendChild(make('div')), {bounds: [1e5, 1e5 + 50, 0, 50], footprints: [{corners: [[0, 0], [1, 1]], level: 'at_altitude'}],
      movers: [], goal: null}, {n: [1e5], e: [0]}, {draw: () => {}, key: () => {}});
    for (let i = 0; i < 60; ++i) map.zoom(1.6);
    return {ticks, zoomed: Math.abs(Math.min(map.view.width, map.view.height) - 0.01) < 1e-9, solid: map.solidAt(5, 7) ?? null};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse(R"({"ticks": [true, true, true, true], "zoomed": true, "solid": null})"));
}

TEST(FigureAxis, HasFewTicksForEqualNumbers) {
  const std::vector<double> equal(10, 1e17);
  for (const auto& values : std::vector<std::vector<double>>{equal, {12.3, 12.3 + 2e-15}, {0.0, 0.0}}) {
    const FigureAxis axis = FigureAxis::of_numbers("x", values);
    EXPECT_LT(axis.low, axis.high);
    EXPECT_GE(axis.ticks.size(), 2U);
    EXPECT_LE(axis.ticks.size(), 6U);
    std::set<std::string> words;
    for (const FigureAxis::Tick& tick : axis.ticks) words.insert(tick.words);
    EXPECT_EQ(words.size(), axis.ticks.size());
  }
  EXPECT_EQ(FigureAxis::of_logarithms("x", {1.001, 1.002, 1.003}).ticks[1].words, "1.002");
}

TEST(ColumnsData, HasSeedsAsTexts) {
  std::vector<FlightRecord> records(1);
  records[0].order = {.id = "a", .group = "a", .scenario = "a.yaml", .seed = 18446744073709551615U};
  const auto columns = columns_data(flight_table(records), std::vector<FlightNotes>(1));
  const auto seeds = std::ranges::find_if(columns, [](const auto& column) { return column.at("name") == "seed"; });
  ASSERT_NE(seeds, columns.end());
  EXPECT_EQ(seeds->at("values"), nlohmann::ordered_json::array({"18446744073709551615"}));
  EXPECT_EQ(seeds->at("is_text"), false);
}

TEST(AgainstOutcome, OfATimeoutWithoutAGoalIsCompleted) {
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(2);
  for (size_t i = 0; i < records.size(); ++i) {
    records[i].status = FlightRecord::Status::flown;
    records[i].order = {.id = "f" + std::to_string(i), .group = "f", .scenario = "room.yaml", .seed = i};
    records[i].result.emplace().flight.outcome = Outcome::timeout;
  }
  records[1].result->flight.goal_distance_m = 12.0;
  write_file_whole(folder.path() / "batch.csv", flight_table(records).csv());
  const FlightList flights = read_flights(folder.path());
  const auto data = against_data(flights, flights);
  EXPECT_EQ(data.at("flights").at(0).at("outcome"), "completed");
  EXPECT_EQ(data.at("flights").at(1).at("outcome"), "timeout");
}

TEST(RunsData, FlightsAfterANestedCampaignBelongToTheOuterOne) {
  const TemporaryFolder folder;
  for (const char* const campaign : {"outer", "outer/inner"}) {
    std::filesystem::create_directories(folder.path() / campaign);
    write_speeds(folder.path() / campaign);
  }
  for (const char* const run : {"outer/inner/a", "outer/z", "z"}) {
    write_result_files(folder.path() / run, {.scenario = run, .scenario_yaml = "name: a\n"}, fake_flight(0.1, 1));
  }
  const auto runs = runs_data(folder.path()).at("runs");
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].at("campaign"), "outer/inner");
  EXPECT_EQ(runs[1].at("campaign"), "outer");
  EXPECT_EQ(runs[2].at("campaign"), "");
}

TEST(TrimInBrowser, SurroundsASingleSpeedAndIgnoresRoundingErrors) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "trim.html", trim_page("trim", R"({"title": "trim", "notes": [], "panels": [
    {"section": "s", "title": "roll", "unit": "deg", "note": "", "lowest": null, "highest": null, "speed_mps": [10],
     "limits": [{"label": "upper limit", "value": 212.9553}], "series": [{"label": "roll", "role": "", "values": [-5e-16]}]}]})"));
  const PageVisit page = visit(folder.path() / "trim.html", R"js(
    const drawn = [], {fillText} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { drawn.push(text); fillText.call(this, text, ...at); };
    const panel = JSON.parse(document.getElementById('data').textContent).panels[0];
    const charts = new Charts(document.body.appendChild(make('div')), [panel], {}, {hover: () => {}, pick: () => {}}, [], speedAxis);
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const {min, max} = charts.plots[0].u.scales.x;
    return {x: [min, max], value: short(-5e-16), drawn: drawn.join('|')};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("x"), nlohmann::json::array({9, 11}));
  EXPECT_EQ(page.value.at("value"), "0");
  EXPECT_THAT(page.value.at("drawn").get<std::string>(), HasSubstr("|upper limit 213"));
  EXPECT_THAT(page.value.at("drawn").get<std::string>(), Not(HasSubstr("e−")));
}

}  // namespace
}  // namespace hedgehop::sim
