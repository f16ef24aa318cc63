#include <gmock/gmock.h>

#include "sim/batch/flight_table.h"
#include "sim/config/whole_file.h"
#include "sim/pages/campaign_data.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/report.h"
#include "sim/pages/report_page.h"
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

TEST(CampaignInBrowser, DistinguishesNumbersAndNamesOfAxes) {
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
  EXPECT_THAT(page.value.at("parallel").get<std::string>(), HasSubstr("avoidance.speed, wind.speed"));
  EXPECT_THAT(page.value.at("convergence").get<std::string>(),
              HasSubstr("over 1 seed; 4 points tried, 4 of them with a failed flight, which costs 1,000,000."));
  EXPECT_EQ(page.value.at("plots"), 0) << "no cost to draw";
  EXPECT_EQ(page.value.at("ink"), nlohmann::json::parse(R"(["#1b2330", "#ffffff"])")) << "contrast above 4.5";
  EXPECT_THAT(page.value.at("worst").get<std::string>(), HasSubstr("hit tree at 0.622 s"));
  EXPECT_THAT(page.value.at("worst").get<std::string>(), HasSubstr("the module failed in “look”"));
}

TEST(CampaignInBrowser, KeepsGoalsAndTipsInsideANarrowWindow) {
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
