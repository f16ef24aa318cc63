#include <gmock/gmock.h>

#include "sim/record/table.h"
#include "tests/sim/batch/campaign_folder.h"
#include "tests/sim/pages/browser.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class Reproduce : public ::testing::Test {
 protected:
  Reproduce() {
    folder.write("small.yaml", R"(
title: "Nobody 1900: a small paper"
source: Garratt2009
tuned_on: 11:20
deviations: [it flies faster]
flights:
  - {scenario: tiny.yaml, seeds: 1:3, quick: 1:2, published: [avoidance.speed=3]}
  - {name: fast, scenario: tiny.yaml, seeds: 1:2, set: [avoidance.speed=2]}
rows:
  - {claim: length, unit: m, flights: [tiny], column: path_length_m, statistic: max}
  - {claim: collided, paper: none, at_most: 0, flights: [tiny, fast], column: outcome, is: collided, statistic: count}
  - {claim: longest path, unit: m, at_least: 1000, flights: [fast], column: path_length_m, statistic: max}
charts:
  - {title: paths, series: [{from: paths, label: slow, flights: tiny}, {from: paths, label: fast, flights: fast}]}
  - {title: height, x: "time, s", y: "down, m", series: [
      {from: log, label: ours, flights: tiny, file: trajectory, y: down_m, seed: 2},
      {from: points, label: paper, x: [0, 0.1], y: [-1, -1]}]}
  - {title: ways, x: "speed, m/s", y: "way, m", x_scale: log, series: [
      {from: groups, label: ours, x: [1, 2], flights: [tiny, fast], column: path_length_m, statistic: mean}]}
)");
  }
  CampaignFolder folder;
};

TEST_F(Reproduce, PrintsEachFigureAndFailsIfOneDoesNotHold) {
  const CommandEnd end = folder.hedgehop("reproduce small.yaml --out out");
  EXPECT_EQ(end.status, 1) << end.err;
  // No flight reaches the goal in a tenth of a second: "no contact" is not enough.
  EXPECT_THAT(end.out, HasSubstr("| collided | none | at most 0 | - | - | 0 of 5 | - | 5, 5, 0, 5; 5 not finished |"));
  EXPECT_THAT(end.out, HasSubstr("- it flies faster\n"));
  const Table rows(folder.path() / "out/reproduction.csv");
  EXPECT_THAT(rows.words("holds"), ElementsAre("", "no", "no"));
  EXPECT_THAT(rows.numbers("required"), ElementsAre(3, 5, 2));
  EXPECT_THAT(rows.numbers("with_figure"), ElementsAre(3, 5, 2));
  EXPECT_NE(rows.words("as_published")[0], rows.words("day")[0]);
  EXPECT_EQ(rows.words("as_published")[1], "");  // `fast` has no law of a paper
  EXPECT_EQ(rows.words("command")[2], "hedgehop batch tiny.yaml --seeds 1:2 --set avoidance.speed=2");
}

TEST_F(Reproduce, ARowWithoutAMeasurementSetsTheExitStatus) {
  const auto paper = [&](const std::string& column) {
    return "title: t\nsource: s\ntuned_on: none\nflights: [{scenario: tiny.yaml, seeds: 1}]\n"
           "rows: [{claim: w, flights: [tiny], column: " +
           column + ", statistic: mean}]\n";
  };
  folder.write("known.yaml", paper("path_length_m"));
  folder.write("unknown.yaml", paper("metric.no_such_figure"));
  EXPECT_EQ(folder.hedgehop("reproduce known.yaml --out out").status, 0);
  const CommandEnd unknown = folder.hedgehop("reproduce unknown.yaml --out out");
  EXPECT_EQ(unknown.status, 1);
  EXPECT_THAT(unknown.out, HasSubstr("| not measured |"));
}

TEST_F(Reproduce, WritesAPageExceptForAQuickRun) {
  EXPECT_EQ(folder.hedgehop("reproduce small.yaml --quick --out out --write r.md").status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "r.md"));
  folder.hedgehop("reproduce small.yaml --out out --write r.md");
  EXPECT_THAT(folder.read("r.md"),
              AllOf(StartsWith("# Results\n\nBuild `"), HasSubstr("renderer tiles"), HasSubstr("OpenCV ")));
  EXPECT_EQ(folder.read("r.md"), folder.read("out/reproduction.md"));
}

TEST_F(Reproduce, AFullRunFliesOnlyTheRestOfAQuickRun) {
  const std::string counting = folder.worker("echo $seed >> flown.txt; fly \"$@\"");
  const std::string with = " -j 1 --out out --program " + counting;
  const CommandEnd quick = folder.hedgehop("reproduce small.yaml --quick" + with);
  EXPECT_THAT(quick.out, HasSubstr("| longest path, m | - | at least 1000 | - | - | not in the quick run |"));
  EXPECT_EQ(folder.read("flown.txt"), "1\n2\n1\n2\n");  // ours, then the published law
  EXPECT_EQ(folder.hedgehop("reproduce small.yaml" + with).status, 1);
  EXPECT_EQ(folder.read("flown.txt"), "1\n2\n1\n2\n3\n3\n1\n2\n");
}

TEST_F(Reproduce, NamesBadInputAndWritesNoFile) {
  const CommandEnd unknown = folder.hedgehop("reproduce nobody1900 --out out");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.err, HasSubstr("papers"));
  folder.write("bad.yaml", "title: a\nsource: b\nrow: []\n");
  const CommandEnd bad = folder.hedgehop("reproduce bad.yaml --out out");
  EXPECT_EQ(bad.status, 2);
  EXPECT_THAT(bad.err, HasSubstr("bad.yaml:3"));
  const CommandEnd twice = folder.hedgehop("reproduce small.yaml ./small.yaml --out out");
  EXPECT_EQ(twice.status, 2);
  EXPECT_THAT(twice.err, HasSubstr("two papers are called 'small': small.yaml, ./small.yaml"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

TEST_F(Reproduce, ItsPageDrawsEveryChartAlone) {
  HEDGEHOP_NEEDS_BROWSER();
  folder.hedgehop("reproduce small.yaml --out out");
  const PageVisit page = visit(folder.path() / "out/reproduction.html", R"js(
    const inked = (canvas) => {
      const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height), colors = new Set();
      for (let i = 0; i < data.length; i += 4) colors.add(data[i] << 16 | data[i + 1] << 8 | data[i + 2]);
      return colors.size > 5;
    };
    return {inked: [...document.querySelectorAll('.chart canvas')].map(inked),
            verdicts: [...document.querySelectorAll('td.pass, td.fail')].map((cell) => cell.className),
            labels: [...document.querySelectorAll('.chart .plan-key')].map((key) => key.textContent),
            head: document.getElementById('head').textContent};)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_THAT(page.requests, IsEmpty());
  EXPECT_EQ(page.value.at("inked"), nlohmann::json({true, true, true}));
  EXPECT_EQ(page.value.at("verdicts"), nlohmann::json({"fail", "fail"}));
  EXPECT_THAT(page.value.at("labels")[0].get<std::string>(), HasSubstr("slow: 3fast: 2"));
  EXPECT_THAT(page.value.at("labels")[1].get<std::string>(), HasSubstr("ours"));
  EXPECT_THAT(page.value.at("head").get<std::string>(), Not(HasSubstr("Quick run")));
}

}  // namespace
}  // namespace hedgehop::sim
