#include "sim/pages/campaign_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "sim/pages/campaign_data.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/pages/made_up_sweep.h"
#include "tests/sim/pages/page_data.h"

namespace hedgehop::sim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CampaignInBrowser, OpensAsOneFileAndSortsFiltersAndSelects) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(120, 4);
  records[7].order.scenario = "</script><b>.yaml";
  write_sweep(folder.path(), records);
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const rows = () => [...document.querySelectorAll('#flights tbody tr')].map((tr) => Number(tr.dataset.row));
    const head = (name) => document.querySelector(`#flights th[data-column="${name}"]`);
    const filter = (text) => {
      document.getElementById('filter').value = text;
      document.getElementById('filter').dispatchEvent(new Event('input'));
    };
    const seen = {first: rows().length};
    document.querySelector('#flights .more').click();
    seen.all = rows().length;
    head('flight_time_s').click();
    seen.rising = rows();
    head('flight_time_s').click();
    seen.falling = rows();
    filter('outcome=collided seed=1');
    seen.filtered = rows().sort((a, b) => a - b);
    filter('no_such_column>3');
    seen.fault = document.getElementById('filter-note').textContent;
    filter('');
    document.querySelector('#flights tbody tr[data-row="100"]').click();
    seen.command = document.querySelector('#selected code').textContent;
    seen.worst = document.querySelector('#worst button.name').textContent;
    return seen;)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_EQ(page.value.at("first"), 100);
  EXPECT_EQ(page.value.at("all"), 120);
  std::vector<int> by_time(120), collided;
  for (int i = 0; i < 120; ++i) {
    by_time[static_cast<size_t>(i)] = i;
    if (i % 2 == 1 && i % 4 == 1) collided.push_back(i);
  }
  const auto time = [&](int i) { return records[static_cast<size_t>(i)].result->flight.flight_time_s; };
  std::ranges::sort(by_time, {}, time);
  EXPECT_EQ(page.value.at("rising"), by_time);
  std::ranges::reverse(by_time);
  EXPECT_EQ(page.value.at("falling"), by_time);
  EXPECT_EQ(page.value.at("filtered"), collided);
  EXPECT_EQ(page.value.at("fault"), "no column 'no_such_column'");
  EXPECT_EQ(page.value.at("command"), rerun_command(records[100].order));
  const auto earliest = *std::ranges::find_if(by_time.rbegin(), by_time.rend(), [](int i) { return i % 2 == 1; });
  EXPECT_EQ(page.value.at("worst"), records[static_cast<size_t>(earliest)].order.id);
}

TEST(CampaignInBrowser, ListsAllGroupsFailuresFirstAndCountsByTheFirstFailedCheck) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(60, 5);
  for (size_t i = 0; i < 20; i += 2) {  // ends at its duration; has no goal
    FlightResult& result = records[i].result->flight;
    result.outcome = Outcome::timeout;
    result.checks.push_back({.name = "max_tilt", .passed = i >= 6, .value = 31.0, .limit = 30.0, .unit = "deg"});
  }
  write_sweep(folder.path(), records);
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const text = (e) => e.textContent, groups = document.getElementById('groups');
    const rows = [...groups.querySelectorAll('tbody tr')].map((tr) => [...tr.children].map(text));
    return {rows: rows.length, hidden: groups.scrollHeight - groups.clientHeight, rates: rows.slice(1).map((row) => Number(row[2])),
            ends: [6, 8].map((column) => rows.slice(1).reduce((sum, row) => sum + Number(row[column]), 0)),
            badge: text(document.querySelector('#head .badge')), tile: text(document.querySelectorAll('.tiles .tile')[2]),
            outcomes: [...new Set([...document.querySelectorAll('#flights tbody tr')].map((tr) => text(tr.children[3])))].sort()};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value.at("rows"), 61);
  EXPECT_EQ(page.value.at("hidden"), 0);
  const auto rates = page.value.at("rates").get<std::vector<int>>();
  EXPECT_TRUE(std::ranges::is_sorted(rates));
  EXPECT_EQ(std::ranges::count(rates, 0), 33);
  EXPECT_EQ(page.value.at("ends"), nlohmann::json::array({10, 0})) << "completed flights and timeouts of all points";
  EXPECT_THAT(page.value.at("badge").get<std::string>(),
              HasSubstr("33 of 60 did not passby collision or first failed check: collision: 30, unknown check: 3"));
  EXPECT_THAT(page.value.at("tile").get<std::string>(),
              HasSubstr("20 reached + 10 completed + 30 collided = 60 flights"));
  EXPECT_EQ(page.value.at("outcomes"), nlohmann::json::array({"collided", "completed", "reached"}));
}

TEST(CampaignInBrowser, DistinguishesModulesNotFlownFromThoseWithoutChecks) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_sweep(folder.path(), made_up(4, 4));
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const seen = [], cell = (module, more) => ({module, world: 'park', ...more});
    fillModuleTiles((...words) => seen.push(words), {modules: [{name: 'a'}, {name: 'b'}], totals: [],
      cells: [cell('a', {reason: 'it has no goal'}), cell('b', {no_checks: true})]});
    return seen;)js");
  EXPECT_EQ(page.value, nlohmann::json::parse(R"([["a", "–", "not flown"], ["b", "–", "no flight with checks"]])"));
}

TEST(CampaignInBrowser, GivesNoVerdictWhileFlightsAreMissing) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(4, 8);
  records[1].status = FlightRecord::Status::missing;
  records[1].result.reset();
  records[3].status = FlightRecord::Status::failed;
  records[3].result.reset();
  write_sweep(folder.path(), records);
  EXPECT_THAT(Table(folder.path() / "sweep.csv").words("passed"), ElementsAre("1", "", "1", "0"));
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const badge = document.querySelector('#head .badge'), column = [...document.querySelectorAll('#flights th')].findIndex((th) => th.dataset.column === 'passed');
    return [badge.className.trim(), badge.textContent, document.querySelector('#flights tbody tr[data-row="1"]').children[column].textContent];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], "badge");
  EXPECT_THAT(page.value[1].get<std::string>(), HasSubstr("1 of 4 flights is missing: no verdict"));
  EXPECT_EQ(page.value[2], "\u2013");
}

TEST(CampaignInBrowser, ShowsTheNamesOfTheWorstFlightsNextToLongCauses) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  auto records = made_up(4, 7);
  FlightResult& result = records[0].result->flight;
  result.checks = {{.name = "max_tilt", .passed = false, .value = 31.0, .limit = 30.0, .unit = "deg"}};
  result.cause = "max_tilt 31 deg at 4.00 s, must be <= 30 deg, in the turn at the end of the street";
  write_sweep(folder.path(), records);
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const names = [...document.querySelectorAll('#worst button.name')], labels = [{name: 'flight_time_s', unit: 's'}, {name: 'gain', unit: 'm'}];
    return [Math.max(...names.map((e) => e.offsetHeight)), document.getElementById('worst').textContent.includes('max_tilt 31'), ...labels.map(columnLabel)];)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_LT(page.value[0], 45) << "two lines";
  EXPECT_EQ(page.value[1], true);
  EXPECT_EQ(page.value[2], "flight_time_s");
  EXPECT_EQ(page.value[3], "gain, m");
}

TEST(CampaignInBrowser, ShowsLongNamesCompletely) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_sweep(folder.path(), made_up(4, 6));
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const drawn = [], {fillText} = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...at) { drawn.push(text); fillText.call(this, text, ...at); };
    const names = ['a_scenario_with_a_very_long_name_and_settings avoidance.gain=2', 'short'];
    const host = document.body.appendChild(make('div'));
    host.style.width = '380px';
    const axes = new Axes(host, 200, {draw: () => {}, hover: () => null, pick: () => {}});
    axes.set(wordAxis('name', names), wordAxis('name', names));
    const column = [...document.querySelectorAll('#groups td:first-child')].map((e) => getComputedStyle(e).position);
    return [drawn.includes(names[0]), drawn.join('').includes(names[0].slice(0, 30)), drawn.some((text) => text.includes('…')), [...new Set(column)]];)js",
                               400);
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value, nlohmann::json::parse(R"([true, true, false, ["sticky"]])"));
}

TEST(CampaignInBrowser, ParetoFrontAndCellsEqualBruteForce) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_sweep(folder.path(), made_up(64, 5));
  write_campaign_report(folder.path(), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const table = new FlightTable(JSON.parse(document.getElementById('data').textContent)), faults = [];
    let bits = 12345;
    const draw = () => (bits = (bits * 1103515245 + 12345) % 2147483648) >> 16;
    for (let trial = 0; trial < 200; ++trial) {
      const n = 1 + draw() % 30, pick = () => Array.from({length: n}, () => draw() % 9 ? draw() % 7 : null);  // ties and gaps
      const x = pick(), y = pick(), less = [draw() % 2 === 0, draw() % 2 === 0], rows = [...x.keys()];
      const better = (u, v, falls) => falls ? u < v : u > v;
      const beats = (a, b) => !better(x[b], x[a], less[0]) && !better(y[b], y[a], less[1]) &&
        (better(x[a], x[b], less[0]) || better(y[a], y[b], less[1]));
      const known = rows.filter((r) => x[r] !== null && y[r] !== null);
      const brute = known.filter((r) => !known.some((other) => beats(other, r)));
      const front = paretoRows(rows, x, y, ...less).sort((a, b) => a - b);
      if (String(front) !== String(brute)) faults.push([trial, front, brute]);
    }
    const rows = [...Array(table.count).keys()], gain = table.columns.get('avoidance.gain'), seed = table.columns.get('seed');
    const cells = [...successCells(table, rows, columnBins(gain, rows), columnBins(seed, rows)).values()];
    return {faults, cells: cells.length, ended: cells.reduce((sum, c) => sum + c.ended, 0),
            right: cells.every((c) => c.passed === c.rows.filter((r) => r % 2 === 0).length)};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.value.at("faults"), IsEmpty());
  EXPECT_EQ(page.value.at("cells"), 64);  // 16 gains, 4 seeds
  EXPECT_EQ(page.value.at("ended"), 64);
  EXPECT_EQ(page.value.at("right"), true);
}

TEST(CampaignReport, OfAThousandFlightsWithLongPathsStaysBelowTenMegabytes) {
  const TemporaryFolder folder;
  const auto records = made_up(1000, 7);
  write_sweep(folder.path(), records);
  std::mt19937_64 random(8);
  std::normal_distribution<double> step(0.0, 0.3);
  for (const FlightRecord& record : records) {
    std::string rows = "north_m,east_m,down_m\n";
    for (double north = 0.0, east = 0.0, i = 0.0; i < 400.0; ++i) {
      rows += std::to_string(north += step(random)) + "," + std::to_string(east += step(random)) + ",-1\n";
    }
    write_file_whole(folder.path() / record.order.id / "trajectory.csv", rows);
  }
  write_campaign_report(folder.path(), {});
  const std::string page = read_file_whole(folder.path() / "report.html");
  EXPECT_LT(page.size(), 10'000'000u);
  const auto paths = data_of(page).at("paths").at("path");
  ASSERT_EQ(paths.size(), 1000u);
  for (size_t i = 0; i < paths.size(); ++i) EXPECT_FALSE(paths[i].empty()) << i;
}

TEST(ReportCommand, RejectsInvalidFoldersAndOptions) {
  const CampaignFolder folder;
  std::filesystem::create_directories(folder.path() / "empty");
  write_sweep(folder.path() / "sweep", made_up(4, 9));
  EXPECT_EQ(folder.hedgehop("report empty").status, 2);
  EXPECT_EQ(folder.hedgehop("report sweep --replay").status, 2);
  EXPECT_EQ(folder.hedgehop("report sweep --against empty").status, 2);
  EXPECT_EQ(folder.hedgehop("report sweep").status, 0);
}

}  // namespace
}  // namespace hedgehop::sim
