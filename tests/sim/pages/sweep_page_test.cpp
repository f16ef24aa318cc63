#include <gmock/gmock.h>

#include "sim/pages/campaign_report.h"
#include "sim/pages/sweep_analysis.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

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

TEST(RunsPage, ListsAllResultsOfAFolderTreeSorted) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-video --no-report --renderer tiles ";
  const std::string words = " --set 'tags=[wind, first]' --set 'notes=gain < 2'";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --seed 3 --out all/b/run" + quick + words).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --seed 1 --out all/a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("batch tiny.yaml --seeds 5 --out all/batch").status, 1);
  std::filesystem::create_directories(folder.path() / "all/search");
  write_file_whole(folder.path() / "all/search/falsify.csv", folder.read("all/batch/batch.csv"));
  ASSERT_EQ(folder.hedgehop("runs all").status, 0);
  const PageVisit page = visit(folder.path() / "all/index.html", R"js(
    const rows = () => [...document.querySelectorAll('#runs tbody tr')].map((tr) => tr.children[3].textContent);
    document.querySelector('#runs th[data-column="seed"]').click();
    const search = [...document.querySelectorAll('#campaigns tbody tr')].find((tr) => tr.children[1].textContent === 'search');
    const seen = {search: search.children[5].textContent, rising: rows(), campaigns: document.querySelectorAll('#campaigns tbody tr').length,
                  module: document.querySelector('#runs tbody tr').children[2].textContent};
    document.querySelector('#inside input').click();
    seen.all = rows();
    document.getElementById('filter').value = 'b/run';
    document.getElementById('filter').dispatchEvent(new Event('input'));
    seen.filtered = rows();
    seen.text = document.querySelector('#runs tbody tr').textContent;
    return seen;)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_THAT(page.value.at("text").get<std::string>(), AllOf(HasSubstr("wind"), HasSubstr("gain < 2")));
  EXPECT_EQ(page.value.at("rising"), (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(page.value.at("all"), (std::vector<std::string>{"1", "3", "5"}));
  EXPECT_EQ(page.value.at("filtered"), (std::vector<std::string>{"3"}));
  EXPECT_EQ(page.value.at("campaigns"), 2);
  EXPECT_THAT(page.value.at("search").get<std::string>(), ::testing::StartsWith("20")) << "the year of its date";
  EXPECT_EQ(page.value.at("module"), "go_to_goal");
  EXPECT_EQ(folder.hedgehop("runs configs").status, 2);
}

TEST(RunAgainst, ShowsBothFilmsWithTheControlsBelow) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-report --renderer tiles ";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out b" + quick).status, 1);
  if (!std::filesystem::exists(folder.path() / "a/video.webm")) GTEST_SKIP() << "this build writes no films";
  ASSERT_EQ(folder.hedgehop("report b --against a").status, 0);
  const PageVisit page = visit(folder.path() / "b/report.html", R"js(
    const films = [...document.querySelectorAll('#against video')];
    return [films.length, films.filter((film) => film.controls).length, document.querySelectorAll('#against .film-bar').length];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::array({2, 0, 2}));
}

TEST(RunAgainst, NamesTheFirstDifferenceAndTheSettings) {
  HEDGEHOP_NEEDS_BROWSER();
  const CampaignFolder folder;
  const std::string quick = " --no-video --no-report --renderer tiles --set duration=1 ";
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out a" + quick).status, 1);
  ASSERT_LE(folder.hedgehop("run tiny.yaml --out b --set avoidance.speed=1" + quick).status, 1);
  ASSERT_EQ(folder.hedgehop("report b --against a").status, 0);
  const PageVisit page = visit(folder.path() / "b/report.html", R"js(
    const host = document.getElementById('against');
    return {lines: [...host.querySelectorAll('.first-difference')].map((p) => p.textContent), text: host.textContent,
            plots: host.querySelectorAll('.u-wrap').length};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  ASSERT_FALSE(page.value.at("lines").empty());
  EXPECT_THAT(
      page.value.at("lines")[0].get<std::string>(),
      ::testing::MatchesRegex("First decision that differs at 0.0[0-9]* s: column [a-z_]+ is [-0-9.]{1,7} here, .*"));
  EXPECT_THAT(page.value.at("text").get<std::string>(), HasSubstr("avoidance.speed"));
  EXPECT_GT(page.value.at("plots"), 2);
  ASSERT_EQ(folder.hedgehop("report a --against a").status, 0);
  EXPECT_THAT(folder.read("a/report.html"), HasSubstr("The trajectories are equal, bit for bit."));
}

}  // namespace
}  // namespace hedgehop::sim
