#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "sim/pages/campaign_report.h"
#include "sim/pages/figure_plot.h"
#include "sim/pages/sweep_analysis.h"
#include "sim/pages/sweep_tables.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/made_up_sweep.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A grid of 3 gains and 2 ranges with two seeds each. The clearance is gain + 5 range, with seeds 0.1 apart; the
/// flights with the gain 3 collide.
std::filesystem::path write_grid(const std::filesystem::path& folder) {
  std::vector<FlightRecord> records;
  std::vector<std::string> points;
  std::vector<double> gains, ranges;
  for (const double gain : {1.0, 2.0, 3.0}) {
    for (const double range : {0.1, 0.2}) {
      for (const uint64_t seed : {1, 2}) {
        FlightRecord record{.status = FlightRecord::Status::flown};
        const std::string point = "p" + std::to_string(points.size() / 2);
        record.order = {.id = "flights/" + point + "-seed" + std::to_string(seed),
                        .group = "point " + point,
                        .scenario = "room.yaml",
                        .seed = seed,
                        .overrides = {"avoidance.gain=" + std::to_string(gain)}};
        const bool collides = gain == 3.0;
        FlightResult& result = record.result.emplace().flight;
        result.outcome = collides ? Outcome::collided : Outcome::reached;
        result.flight_time_s = 10.0 * gain;
        result.closest_obstacle.distance_m = gain + 5.0 * range + 0.1 * static_cast<double>(seed);
        result.checks = {{.name = "no_collision", .passed = !collides, .value = 1.0, .limit = 0.0, .unit = "m"}};
        records.push_back(record);
        points.push_back(point);
        gains.push_back(gain);
        ranges.push_back(range);
      }
    }
  }
  write_file_whole(folder / "sweep.csv", flight_table(records, {{.name = "point", .values = points},
                                                                {.name = "avoidance.gain", .values = gains},
                                                                {.name = "avoidance.range", .values = ranges}})
                                             .csv());
  return folder;
}

/// Writes a sweep over the gain with one flight per record, and their result.json.
void write_points(const std::filesystem::path& folder, std::vector<FlightRecord>& records,
                  const std::vector<double>& gains) {
  std::vector<std::string> points;
  for (FlightRecord& record : records) {
    points.push_back("p" + std::to_string(points.size()));
    record.status = FlightRecord::Status::flown;
    record.order = {.id = points.back(), .group = "point " + points.back(), .scenario = "room.yaml", .seed = 1};
    std::filesystem::create_directories(folder / record.order.id);
    write_file_whole(folder / record.order.id / "result.json", result_json(record.result->info, record.result->flight));
  }
  write_file_whole(
      folder / "sweep.csv",
      flight_table(records, {{.name = "point", .values = points}, {.name = "avoidance.gain", .values = gains}}).csv());
}

TEST(SweepAnalysis, RanksTheMinimizedColumnByItsMinimum) {
  const TemporaryFolder folder;
  const FlightList flights = read_flights(write_grid(folder.path()));
  write_file_whole(folder.path() / "sweep.json", R"({"design": "optimize", "minimize": "min_obstacle_clearance_m"})");
  EXPECT_THAT(analyze_sweep(folder.path(), flights, "").ranking, ::testing::ElementsAre(0, 1, 2, 3, 4, 5));
}

/// A robustness must be at least 0, a speed at most 3 m/s.
TEST(SweepAnalysis, RanksChecksByTheRelationThatTheyRequire) {
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(2);
  for (size_t i = 0; i < 2; ++i) {
    const double value = 1.0 + static_cast<double>(i);
    FlightResult& flight = records[i].result.emplace().flight;
    flight.outcome = Outcome::reached;
    flight.checks = {{.name = "near_goal", .passed = true, .value = value, .limit = 0.0, .unit = "", .must = ">="},
                     {.name = "max_speed", .passed = true, .value = value, .limit = 3.0, .unit = "m/s"}};
  }
  write_points(folder.path(), records, {1.0, 2.0});
  const FlightList flights = read_flights(folder.path());
  EXPECT_THAT(analyze_sweep(folder.path(), flights, "check.near_goal").ranking, ::testing::ElementsAre(1, 0));
  EXPECT_THAT(analyze_sweep(folder.path(), flights, "check.max_speed").ranking, ::testing::ElementsAre(0, 1));
  const auto data = sweep_data(folder.path(), flights);
  EXPECT_THAT(data.at("more_is_better").get<std::vector<std::string>>(), ::testing::Contains("check.near_goal"));
}

TEST(SweepTables, DoNotCountFlightsWithoutChecksAsPassed) {
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(2);
  for (FlightRecord& record : records) record.result.emplace().flight.outcome = Outcome::reached;
  records[1].result->flight.checks = {{.name = "no_collision", .passed = true, .unit = "m"}};
  write_points(folder.path(), records, {-0.5, 2.0});
  const FlightList flights = read_flights(folder.path());
  const SweepAnalysis analysis = analyze_sweep(folder.path(), flights, "flight_time_s");
  EXPECT_EQ(analysis.figures[0].passed, 0u);
  write_file_whole(folder.path() / "ranking.csv", ranking_csv(flights, analysis));
  EXPECT_THAT(Table(folder.path() / "ranking.csv").words("no_checks"), ::testing::ElementsAre("1", "0"));
  EXPECT_THAT(ranking_latex(analysis), AllOf(HasSubstr("1 & $-$0.5 & 0 & -- & no checks"), HasSubstr("1 of 1")));
}

TEST(SweepTables, WriteIndicesWithAMinusAndWithoutANegativeZero) {
  SweepAnalysis analysis{.points = {.paths = {"gain"}}, .column = "passed"};
  const auto effects = nlohmann::ordered_json::parse(
      R"({"method": "sobol", "columns": {"passed": [[-0.03, -0.001, 0.2, 1, 0.9, 1.1]]}})");
  EXPECT_THAT(indices_latex(analysis, effects), HasSubstr("& $-$0.03 & 0.00 to 0.20 & 1.00 & 0.90 to 1.10"));
}

TEST(SweepFigures, DrawParametersOfALogarithmicRangeOnALogarithmicAxis) {
  const FigureAxis axis = FigureAxis::of_logarithms("gain", {1.0, 0.01, 0.1, 1.0});
  ASSERT_EQ(axis.ticks.size(), 3u);
  EXPECT_EQ(axis.ticks[0].words, "0.01");
  EXPECT_NEAR(axis.ticks[1].value, -1.0, 1e-12);
  EXPECT_GT(axis.high, 0.0);
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(4);
  for (FlightRecord& record : records) record.result.emplace().flight.outcome = Outcome::reached;
  write_points(folder.path(), records, {0.001, 0.01, 0.1, 1.0});
  const auto drawn = [&] {
    write_sweep_figures(folder.path(), folder.path() / "figures", "flight_time_s");
    return read_file_whole(folder.path() / "figures/main_effects.svg");
  };
  const std::string linear = drawn();
  write_file_whole(folder.path() / "sweep.json", R"({"parameters": [{"path": "avoidance.gain", "log": true}]})");
  EXPECT_THAT(drawn(), AllOf(HasSubstr(">0.001<"), ::testing::Ne(linear)));
  EXPECT_THAT(linear, ::testing::Not(HasSubstr(">0.001<")));
}

TEST(SweepAnalysis, RanksPassedPointsByTheMeanWithStudentsInterval) {
  const TemporaryFolder folder;
  const FlightList flights = read_flights(write_grid(folder.path()));
  const SweepAnalysis analysis = analyze_sweep(folder.path(), flights, "min_obstacle_clearance_m");
  EXPECT_THAT(analysis.ranking, ::testing::ElementsAre(3, 2, 1, 0, 5, 4));
  EXPECT_NEAR(analysis.figures[3].mean, 3.15, 1e-12);
  EXPECT_NEAR(analysis.figures[3].high - 3.15, 12.706 * 0.05, 1e-3);
  EXPECT_THROW(analyze_sweep(folder.path(), flights, "min_clearence_m"), InputError);
}

/// The clearance is a sum of both parameters: variances 2/3 and 1/16.
TEST(SweepData, HasTheIndicesOfAGrid) {
  const TemporaryFolder folder;
  write_grid(folder.path());
  const auto data = sweep_data(folder.path(), read_flights(folder.path()));
  EXPECT_EQ(data.at("effects").at("method"), "grid");
  const auto& rows = data.at("effects").at("columns").at("min_obstacle_clearance_m");
  const double whole = 2.0 / 3.0 + 0.0625;
  EXPECT_NEAR(rows[0][0].get<double>(), 2.0 / 3.0 / whole, 1e-4);
  EXPECT_NEAR(rows[1][3].get<double>(), 0.0625 / whole, 1e-4);
}

TEST(SweepInBrowser, OpensWithTheBestPointAndFollowsTheColumn) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_campaign_report(write_grid(folder.path()), {});
  for (const int width_px : {1400, 400}) {
    const PageVisit page = visit(folder.path() / "report.html", R"js(
      const card = document.getElementById('answer-card'), select = card.querySelector('select');
      const seen = {first: document.querySelector('main').firstElementChild.id, best: card.querySelector('.best').textContent,
                    command: card.querySelector('code').textContent};
      select.value = 'flight_time_s';
      select.dispatchEvent(new Event('change'));
      seen.fastest = card.querySelector('.best').textContent;
      seen.rows = card.querySelectorAll('tbody tr').length;
      card.querySelector('tbody tr').click();
      seen.selected = document.querySelector('#selected h3').textContent;
      seen.wide = document.documentElement.scrollWidth;
      const points = new SweepPoints(JSON.parse(document.getElementById('data').textContent), new FlightTable(JSON.parse(document.getElementById('data').textContent)));
      const cells = heatCells(points, points.of('min_obstacle_clearance_m'), parameterBins(points, 0), parameterBins(points, 1), 0, 1);
      seen.cell = cells.get('1,1').mean;
      seen.figure = points.of('min_obstacle_clearance_m')[3];
      return seen;)js",
                                 width_px);
    EXPECT_THAT(page.errors, IsEmpty());
    EXPECT_EQ(page.value.at("first"), "answer-card");
    EXPECT_EQ(page.value.at("best"), "avoidance.gain = 2, avoidance.range = 0.2");
    EXPECT_EQ(page.value.at("command"), "hedgehop batch room.yaml --seeds 1:2 --set avoidance.gain=2.000000");
    EXPECT_EQ(page.value.at("fastest"), "avoidance.gain = 1, avoidance.range = 0.2");
    EXPECT_EQ(page.value.at("rows"), 6);
    EXPECT_EQ(page.value.at("selected"), "flights/p1-seed1");
    EXPECT_LE(page.value.at("wide"), width_px);
    EXPECT_NEAR(page.value.at("cell").get<double>(), 3.15, 1e-9);
    EXPECT_NEAR(page.value.at("figure").at("high").get<double>(), 3.15 + 12.706 * 0.05, 1e-3);
  }
}

TEST(SweepInBrowser, ShowsPointsNotFlownAsSuch) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(3, 13);
  records[2].status = FlightRecord::Status::missing;
  records[2].result.reset();
  write_sweep(folder.path(), records);
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const card = document.getElementById('answer-card'), last = [...card.querySelectorAll('tbody tr')].at(-1).lastElementChild;
    return [last.textContent, last.className, card.querySelector('.answer').textContent];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "not flown");
  EXPECT_EQ(page.value[1], "number");
  EXPECT_THAT(page.value[2].get<std::string>(), HasSubstr("best of 2 flown of 3 points"));
}

/// The second point of the three that were tried is the best; the third has a failed flight.
TEST(OptimizerInBrowser, ShowsTheColumnTheOptimumAndEveryPointThatWasTried) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  std::vector<FlightRecord> records(3);
  for (size_t i = 0; i < 3; ++i) {
    records[i].status = FlightRecord::Status::flown;
    const std::string point = "p" + std::to_string(i);
    records[i].order = {.id = "flights/" + point, .group = "point " + point, .scenario = "room.yaml", .seed = 1};
    FlightResult& result = records[i].result.emplace().flight;
    result.outcome = Outcome::reached;
    result.flight_time_s = std::vector{30.0, 20.0, 10.0}[i];
    result.checks = {{.name = "no_collision", .passed = i < 2, .value = 1.0, .limit = 0.0, .unit = "m"}};
  }
  write_file_whole(folder.path() / "sweep.csv",
                   flight_table(records, {{.name = "point", .values = std::vector<std::string>{"p0", "p1", "p2"}},
                                          {.name = "avoidance.gain", .values = std::vector{1.0, 2.0, 3.0}}})
                       .csv());
  write_file_whole(folder.path() / "sweep.json",
                   R"({"design": "optimize", "parameters": [{"path": "avoidance.gain", "log": false}],
                       "minimize": "flight_time_s", "failure_cost": 1000000.0})");
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const card = document.getElementById('convergence-card'), canvas = card.querySelector('canvas'), box = canvas.getBoundingClientRect();
    const tips = new Set();
    for (let x = 0; x < box.width; x += 8) {
      canvas.dispatchEvent(new PointerEvent('pointermove', {clientX: box.x + x, clientY: box.y + box.height / 2}));
      if (!card.querySelector('.tip').hidden) tips.add(card.querySelector('.tip').children[1].textContent);
    }
    return {hidden: card.hidden, text: card.textContent, tips: [...tips], best: document.querySelector('#answer-card .best').textContent,
            column: document.querySelector('#answer-card select').value};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("hidden"), false);
  EXPECT_THAT(page.value.at("text").get<std::string>(),
              AllOf(HasSubstr("mean of flight_time_s"), HasSubstr("3 points tried, 1 of them with a failed flight")));
  EXPECT_EQ(page.value.at("tips").size(), 3u);
  EXPECT_EQ(page.value.at("best"), "avoidance.gain = 2");
  EXPECT_EQ(page.value.at("column"), "flight_time_s");
}

TEST(SweepFigures, AreTablesAndDrawingsThatOtherProgramsRead) {
  const CampaignFolder folder;
  write_grid(folder.path());
  const CommandEnd end = folder.hedgehop("report . --figures --column min_obstacle_clearance_m");
  ASSERT_EQ(end.status, 0) << end.err;
  for (const char* name : {"main_effects", "heat_map", "pareto", "indices"}) {
    const std::string file = std::string("figures/") + name;
    EXPECT_EQ(folder.shell("python3 -c 'import sys, xml.etree.ElementTree as t; t.parse(sys.argv[1])' " + file + ".svg")
                  .status,
              0)
        << name;
    const std::string pdf = folder.read(file + ".pdf");
    EXPECT_TRUE(pdf.starts_with("%PDF-1.4\n"));
    const size_t at = std::stoul(pdf.substr(pdf.rfind("startxref\n") + 10));
    EXPECT_EQ(pdf.substr(at, 5), "xref\n") << name;
  }
  EXPECT_THAT(folder.read("figures/ranking.csv"),
              HasSubstr("rank,point,avoidance.gain,avoidance.range,mean_min_obstacle_clearance_m"));
  EXPECT_THAT(folder.read("figures/ranking.tex"), HasSubstr("mean of min\\_obstacle\\_clearance, m"));
  const Table indices(folder.path() / "figures/indices.csv");
  EXPECT_EQ(indices.rows(), 2u);
  EXPECT_THAT(indices.names(), ::testing::ElementsAre("parameter", "first", "total"));  // exact, so no intervals
  EXPECT_THAT(folder.read("figures/indices.tex"), HasSubstr("parameter & $S_i$ & $S_{Ti}$ \\\\\n"));
  const CommandEnd misspelled = folder.hedgehop("report . --figures --column min_clearence_m");
  EXPECT_THAT(misspelled.err, HasSubstr("no column 'min_clearence_m'; did you mean 'min_clearance_m'?"));
  EXPECT_EQ(misspelled.out, "");
  EXPECT_THAT(folder.hedgehop("report . --figures --column no_collision").err,
              HasSubstr("no column 'no_collision'; did you mean 'check.no_collision'?"));
}

}  // namespace
}  // namespace hedgehop::sim
