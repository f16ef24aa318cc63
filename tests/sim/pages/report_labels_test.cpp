#include <gmock/gmock.h>

#include "sim/pages/report.h"
#include "sim/record/result_files.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/run_folder.h"
#include "tests/sim/record/fake_flight.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ReportInBrowser, OmitsTheTimeOfADisabledVelocimeter) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  const auto details = [&](StageTime times) {
    Flight flight = fake_flight(10.0, 1);
    flight.result.velocimeter_ms = times;
    write_result_files(run.path(), {.scenario = "city", .scenario_yaml = run.yaml()}, flight);
    write_report(run.path(), read_run(run.path()));
    return visit(run.path() / "report.html", "return document.getElementById('details').textContent;").value.dump();
  };
  EXPECT_THAT(details({}), ::testing::Not(HasSubstr("velocity from flow")));
  EXPECT_THAT(details({1.5, 1.9}), HasSubstr("velocity from flow1.5 ms, 95 % below 1.9 ms"));
}

TEST(ReportInBrowser, OmitsUnitsFromNamesAndGivesPairsOfTimesTheSameUnit) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    return [measured(0.0104, 'ms', 3, 0.00178), wordsOf('decision_hz', 'Hz'), wordsOf('braking_mps2', 'm/s^2')];)js");
  EXPECT_THAT(page.value, ::testing::ElementsAre("10.4 µs", "decision", "braking"));
}

TEST(ReportInBrowser, NamesAxesWithoutAUnitAndKeepsLabelsOfThePlanApart) {
  HEDGEHOP_NEEDS_BROWSER();
  const RunFolder run;
  write_report(run.path(), read_run(run.path()));
  const PageVisit page = visit(run.path() / "report.html", R"js(
    const panel = {section: '', title: 'Known share', note: '', unit: '', t_s: [0, 1], lowest: null, highest: null, limits: [],
                   series: [{label: 'share', role: '', values: [0, 1]}]};
    const charts = new Charts(document.body.appendChild(make('div')), [panel, {...panel, unit: 'm/s^2'}], {}, {hover() {}, pick() {}});
    const labels = {};
    const map = {x: (v) => v, y: (v) => -v, dot() {}, cross() {}, label: (c, text, x, y) => { labels[text.slice(0, 5)] = y; }};
    const closest = {east_m: 0, north_m: 33, distance_m: 1};  // its label would be on that of the start
    PlanView.prototype.drawMarks.call({path: {n: [0], e: [0]}, result: {outcome: 'timeout', closest_obstacle: closest}, map, row: null},
                                      document.createElement('canvas').getContext('2d'));
    return [...charts.plots.map(({u}) => u.axes[1].label), Math.abs(labels.start - labels.close)];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "share");
  EXPECT_EQ(page.value[1], "m/s²");
  EXPECT_GE(page.value[2], 16) << "px";
}

}  // namespace
}  // namespace hedgehop::sim
