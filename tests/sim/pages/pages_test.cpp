#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "sim/config/whole_file.h"
#include "sim/pages/report.h"
#include "sim/record/result_files.h"
#include "sim/record/table.h"
#include "sim/scenario/reference_path.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/run_folder.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReportInBrowser, OpensAsOneFileAndFollowsThePointer) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const canvas = document.querySelector('#plan canvas'), box = canvas.getBoundingClientRect();
    canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: box.x + box.width / 2, clientY: box.y + box.height / 2}));
    return [document.querySelector('h1').textContent, document.querySelector('#plan .tip').hidden];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_THAT(page.value, ElementsAre("city </script> flow_balance", false));
}

TEST(ReportInBrowser, SupportsKeysAndTextAlternatives) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const canvas = document.querySelector('#plan canvas'), drawn = [];
    canvas.focus();
    for (const key of ['0', '+', 'ArrowUp', '0']) {
      canvas.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
      drawn.push(canvas.toDataURL());
    }
    const nameless = [...document.querySelectorAll('canvas, video, .plot')].filter((e) => !e.ariaLabel && !e.closest('.plot[aria-label]'));
    return [document.activeElement === canvas, drawn[1] !== drawn[0], drawn[2] !== drawn[1],
            drawn[3] === drawn[0], nameless.length];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value, ElementsAre(true, true, true, true, 0));
}

// Moves the pointer over the whole map and collects the texts.
TEST(ReportInBrowser, ShowsTheMapOfAModuleWithTheTruth) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  const Eigen::Matrix3d covariance = Eigen::Vector3d(4.0, 1.0, 1.0).asDiagonal();
  flight.map.points = {{{40, 10, -20}, covariance, true}, {{60, -30, -5}, covariance, false}};
  flight.map.corners = {{{41, 10, -20}, true, true}, {{20, 40, -20}, true, false}};
  flight.map.course_NE = {{0, 0}, {100, 0}};
  flight.map.paths = {{2.0, {{30, 20}, {100, 0}}}};
  write_result_files(run.path(), {.scenario = "map", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const canvas = document.querySelector('#landmarks canvas'), box = canvas.getBoundingClientRect();
    const tip = document.querySelector('#landmarks .tip'), met = {};
    for (let x = 0; x < box.width; x += 12) {  // a text is shown within 9 px
      for (let y = 0; y < box.height; y += 12) {
        canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: box.x + x, clientY: box.y + y}));
        met[tip.children[0].textContent] = tip.children[1]?.textContent;
      }
    }
    return [met['landmark'], met['false landmark'], document.querySelector('#landmarks .plan-key').textContent];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "north 40.0 m, east 10.0 m, 20.0 m high");
  EXPECT_EQ(page.value[1], "north 60.0 m, east −30.0 m, 5.0 m high");
  EXPECT_THAT(page.value[2].get<std::string>(), ::testing::HasSubstr("1 false"));
}

TEST(ReportInBrowser, StartsWithASummaryOfACollisionAndReplacesConstantPlotsByText) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  for (TrajectoryRow& row : flight.trajectory) row.wind_W.setZero();
  flight.result.outcome = Outcome::collided;
  flight.result.closest_obstacle = {.distance_m = 0.0, .t_s = 10.0, .what = "tower"};
  flight.result.checks = {{"no_collision", false, 0.0, 0.0, "m", ">"}};
  write_result_files(run.path(), {.scenario = "collided", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const TrajectoryRow& end = flight.trajectory.back();
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const text = (e) => e.textContent;
    const flat = [...document.querySelectorAll('.chart.flat')].map((e) => e.querySelector('h3').textContent);
    return [text(document.querySelector('#story li')), text(document.querySelector('#checks')), flat,
            document.querySelectorAll('.chart.flat .uplot').length];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], fmt::format("Hit tower at 10.0 s, flying {:.1f} m/s at {:.1f} m altitude.",
                                       end.v_WB_W_true.norm(), -end.p_WB_true.z()));
  EXPECT_THAT(page.value[1].get<std::string>(), ::testing::HasSubstr("> 0 m"));
  EXPECT_THAT(page.value[2], ElementsAre("Wind"));
  EXPECT_EQ(page.value[3], 0);
}

TEST(ReportInBrowser, StartsWithTheCauseOfATimeoutAndABarOfItsStatuses) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  for (size_t i = 0; i < flight.decisions.size(); ++i) {
    flight.decisions[i].status = 2 * i < flight.decisions.size() ? "go" : "look";
  }
  flight.result.outcome = Outcome::timeout;
  flight.result.goal_distance_m = 30.0;
  flight.result.cause = "in its last 5 s the module reported `look` and commanded 0 m/s";
  flight.result.goal_missed_unchecked = true;
  write_result_files(run.path(), {.scenario = "timeout", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const spans = [...document.querySelectorAll('#story .ribbon-bar i')].map((e) => e.title.split(':')[0]);
    return [document.querySelector('#story li').textContent, document.getElementById('story').textContent.includes('{check: reached_goal}'),
            spans.filter(Boolean), document.querySelector('#story .ribbon p').textContent];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "In its last 5 s the module reported “look” and commanded 0 m/s.");
  EXPECT_EQ(page.value[1], true);
  EXPECT_THAT(page.value[2], ElementsAre("go", "look"));
  EXPECT_EQ(page.value[3], "go look ");
}

TEST(ReportInBrowser, WritesTheNameOfAFailedCheckUnchanged) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.outcome = Outcome::timeout;
  flight.result.goal_distance_m.reset();
  flight.result.cause = "floor_visited 0.07, must be >= 0.7";
  flight.result.checks = {{"floor_visited", false, 0.07, 0.7, "", ">="}};
  write_result_files(run.path(), {.scenario = "floor", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", "return document.querySelector('#story li').textContent;");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, "floor_visited 0.07, must be >= 0.7.");
}

/// The buttons of the plan cover no name, and no cell of the checks is cut.
TEST(ReportInBrowser, FitsOnANarrowWindow) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.checks = {
      {"min_clearance", false, -0.009013, 0.5, "m", ">=", 14.14, "distance at the end; minimum 64.8 m at 14.1 s"}};
  write_result_files(run.path(), {.scenario = "narrow", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const box = (e) => e.getBoundingClientRect(), checks = document.getElementById('checks');
    const [canvas, tools] = ['canvas', '.plan-tools'].map((name) => document.querySelector('#plan ' + name));
    return [document.documentElement.scrollWidth, checks.scrollWidth - checks.clientWidth, box(tools).top >= box(canvas).bottom];)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_LE(page.value[0], 400);
  EXPECT_EQ(page.value[1], 0);
  EXPECT_EQ(page.value[2], true);
}

TEST(ReportInBrowser, StartsWithTheFailedCheckOfAFlightToItsGoal) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.outcome = Outcome::reached;
  flight.result.checks = {{"min_clearance", false, 0.6, 1.0, "m", ">=", 6.4, "to tree 8"}};
  flight.result.cause = "min_clearance 0.6 m at 6.40 s, must be >= 1 m: to tree 8";
  write_result_files(run.path(), {.scenario = "close", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    return [document.querySelector('#story li').textContent, document.querySelector('#checks').textContent.includes('to tree 8')];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "min_clearance 0.6 m at 6.40 s, must be >= 1 m: to tree 8.");
  EXPECT_EQ(page.value[1], true);
}

TEST(ReportInBrowser, ShowsTheReferenceOfAPathCheckOnThePlan) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  ReferencePath reference{.points = {{0.0, {0.0, 0.0, -10.0}}, {10.0, {50.0, 20.0, -10.0}}}};
  write_file_whole(run.path() / "path.csv", reference_text(reference));
  const auto drawn_plan = [&](const std::string& checks) {
    const std::vector<std::string> overrides = {checks};
    const std::string yaml =
        to_yaml(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml", overrides));
    write_result_files(run.path(), {.scenario = "path", .scenario_yaml = yaml}, fake_flight(10.0, 1));
    write_report(run.path(), read_run(run.path()));
    const PageVisit page =
        visit(run.path() / "report.html", "return document.querySelector('#plan canvas').toDataURL();");
    EXPECT_THAT(page.errors, IsEmpty());
    return page.value;
  };
  const std::string check =
      "checks=[{check: path_tolerance, at_most: 1, reference: " + (run.path() / "path.csv").string() + "}]";
  EXPECT_NE(drawn_plan(check), drawn_plan("checks=[]"));
}

TEST(ReportInBrowser, FillsTheWidthWithoutEmptyHalves) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const box = (e) => e.getBoundingClientRect(), [plan, stack] = document.querySelector('.pair').children;
    return [box(stack).right - box(plan).left, Math.abs(box(plan).bottom - box(stack).bottom)];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_GE(page.value[0].get<double>(), 1350.0);
  EXPECT_LE(page.value[1].get<double>(), 80.0);
}

TEST(ReportInBrowser, StacksWideFilmsInTwoRowsWithTheControlsBelow) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const host = document.body.appendChild(make('div')), film = host.appendChild(make('video'));
    const view = new FilmView(film), bar = host.querySelector('.film-bar').getBoundingClientRect();
    return [filmRows(960, 322), film.controls, bar.top >= film.getBoundingClientRect().bottom];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  // Three images of 320 x 300 px and a caption: two of them above one.
  EXPECT_EQ(page.value[0], nlohmann::json::parse(R"({"width": 640, "height": 622, "parts": [
      [0, 0, 640, 300, 0, 0], [640, 0, 320, 300, 0, 300], [0, 300, 640, 22, 0, 600]]})"));
  EXPECT_EQ(page.value[1], false);
  EXPECT_EQ(page.value[2], true);
}

TEST(ReportInBrowser, NarrowScenesKeepNumbersOnBothAxes) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const drawn = [], {fillText} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { drawn.push([text, this.textAlign]); fillText.call(this, text, ...at); };
    const host = document.body.appendChild(make('div')), counts = [];
    for (const bounds of [[-2, 2, 0, 60], [0, 60, -2, 2]]) {
      drawn.length = 0;
      new MapView(host, {bounds, footprints: [], movers: [], goal: null}, {n: [], e: []}, {draw: () => {}, key: () => {}}).draw();
      const numbers = drawn.filter(([text]) => /^−?[\d.]+$/.test(text));
      counts.push(numbers.filter(([, align]) => align === 'center').length, numbers.filter(([, align]) => align === 'right').length);
    }
    return counts;)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  for (const auto& count : page.value) EXPECT_GE(count.get<int>(), 2) << page.value;
}

TEST(ReportInBrowser, ShowsNoNegativeZeroAndSmallTimesInTheirUnits) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    return [fixed(-0.001, 2), placeText(-0.01, -0.04), measured(0.000251, 'ms'), measured(3.5, 'ms'), measured(2e-7, 's'), measured(null, 's')];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value, ElementsAre("0.00", "north 0.0 m, east 0.0 m", "0.251 µs", "3.5 ms", "0.2 µs", "–"));
}

TEST(ReportInBrowser, ShadesTheTimesOfFailures) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  flight.result.failures = {"2 s to 4 s: camera.front black", "8 s to the end: gps bias 3",
                            "60 s to the end: link off"};
  write_result_files(run.path(), {.scenario = "failing", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const canvas = document.querySelector('.plot canvas'), {data} = canvas.getContext('2d').getImageData(0, 40, canvas.width, 1);
    const reddish = [...Array(canvas.width).keys()].map((x) => data[4 * x + 3] > 0 && data[4 * x] > data[4 * x + 1] + 8 && data[4 * x] > data[4 * x + 2] + 8);
    const share = reddish.filter(Boolean).length / canvas.width;
    const rows = [], none = () => {}, ctx = {save: none, restore: none, fillRect: none, measureText: () => ({width: 100}), fillText: (text, x, y) => rows.push(y)};
    drawFailures({ctx, bbox: {left: 0, top: 0, width: 400, height: 100}, valToPos: (t) => 40 * t},
      [{from_s: 1, to_s: 2, text: 'a'}, {from_s: 2, to_s: 3, text: 'b'}, {from_s: 6, to_s: 7, text: 'c'}]);
    return [document.getElementById('verdict').textContent.includes('Failures injected by the scenario: 2 s to 4 s: camera.front black; 8 s'),
            failuresOf({failures: ['2.5 s to 4 s: a off', '8 s to the end: b off', '60 s to the end: c off']}, 10), share, rows];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at(0), true);
  EXPECT_EQ(page.value.at(1), nlohmann::json::parse(R"([{"from_s": 2.5, "to_s": 4, "text": "a off"},
                                                        {"from_s": 8, "to_s": 10, "text": "b off"}])"));
  EXPECT_GT(page.value.at(2).get<double>(), 0.25) << "4 of 10 s are shaded; curves alone cover about 0.05";
  EXPECT_EQ(page.value.at(3), nlohmann::json::parse("[2, 15, 2]")) << "overlapping names have different rows";
}

TEST(ReportInBrowser, HasNoMapWithoutAMapAndNoSummaryOfASuccess) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  Flight flight = fake_flight(10.0, 1);
  for (CheckResult& check : flight.result.checks) check.passed = true;
  write_result_files(run.path(), {.scenario = "success", .scenario_yaml = run.yaml()}, flight);
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html",
                               "return !document.getElementById('landmarks') && !document.getElementById('story');");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_TRUE(page.value.get<bool>());
}

}  // namespace
}  // namespace hedgehop::sim
