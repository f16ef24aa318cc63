#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/config/whole_file.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/sweep_analysis.h"
#include "tests/sim/pages/browser.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Nine points of which no two share a wind or an altitude.
std::filesystem::path write_scattered(const std::filesystem::path& folder) {
  std::vector<FlightRecord> records(9);
  std::vector<std::string> points;
  std::vector<double> winds, altitudes;
  for (FlightRecord& record : records) {
    const auto i = static_cast<double>(points.size());
    points.push_back("p" + std::to_string(points.size()));
    winds.push_back(i);
    altitudes.push_back(std::fmod(2.0 * i, 9.0));
    record.status = FlightRecord::Status::flown;
    record.order = {.id = "flights/" + points.back(), .group = "point " + points.back(), .scenario = "room.yaml"};
    FlightResult& flight = record.result.emplace().flight;
    flight.outcome = Outcome::reached;
    flight.closest_obstacle.distance_m = i;
    flight.checks = {{.name = "no_collision", .passed = true, .value = 1.0, .limit = 0.0, .unit = "m"}};
  }
  write_file_whole(folder / "sweep.csv", flight_table(records, {{.name = "point", .values = points},
                                                                {.name = "wind.speed", .values = winds},
                                                                {.name = "start.altitude", .values = altitudes}})
                                             .csv());
  return folder;
}

/// The mean of one point is no mean over the other parameters.
TEST(SweepInBrowser, AveragesRangesIfValuesHaveASinglePointAndCountsTies) {
  HEDGEHOP_NEEDS_BROWSER();
  const TemporaryFolder folder;
  write_campaign_report(write_scattered(folder.path()), {});
  const PageVisit page = visit(folder.path() / "report.html", R"js(
    const data = JSON.parse(document.getElementById('data').textContent), points = new SweepPoints(data, new FlightTable(data));
    const {words, of} = parameterBins(points, 0), card = document.getElementById('answer-card'), best = card.querySelector('.answer').textContent;
    card.querySelector('select').value = 'passed';
    card.querySelector('select').dispatchEvent(new Event('change'));
    return [words, of(3), of(4), points.headings(), best, card.querySelector('.answer').textContent];)js");
  EXPECT_THAT(page.errors, IsEmpty());
  EXPECT_EQ(page.value[0], nlohmann::json::array({"0 to 4", "4 to 8"}));
  EXPECT_EQ(page.value[1], 0);
  EXPECT_EQ(page.value[2], 1);
  EXPECT_EQ(page.value[3], nlohmann::json::array({"wind.speed, m/s", "start.altitude, m"}));
  EXPECT_THAT(page.value[4].get<std::string>(), HasSubstr("best of 9 points."));
  EXPECT_THAT(page.value[5].get<std::string>(), HasSubstr("9 of 9 points share this best mean"));
}

TEST(SweepFigures, AverageRangesIfValuesHaveASinglePointAndStateUnits) {
  const TemporaryFolder folder;
  write_scattered(folder.path());
  write_sweep_figures(folder.path(), folder.path() / "figures", "min_obstacle_clearance_m");
  const auto read = [&](const std::string& name) { return read_file_whole(folder.path() / "figures" / name); };
  const auto count = [](const std::string& text, const std::string& part) {
    size_t found = 0;
    for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
  };
  const std::string effects = read("main_effects.svg"), heat = read("heat_map.svg");
  EXPECT_EQ(count(effects, "<circle"), 2u * (9u + 2u)) << "9 points and 2 means for each parameter";
  EXPECT_EQ(count(heat, "<rect"), 2u + 4u + 16u) << "page, frame, cells, shades of the scale";
  // Altitudes below 4 with winds below 4 and from 4 on, then altitudes from 4 on. An end belongs to the range above it.
  EXPECT_THAT(heat, AllOf(HasSubstr(">0.5<"), HasSubstr(">5.5<"), HasSubstr(">2.5<"), HasSubstr(">6.33<")));
  EXPECT_THAT(effects, AllOf(HasSubstr(">wind.speed, m/s<"), HasSubstr(">start.altitude, m<")));
  EXPECT_THAT(read("ranking.tex"), HasSubstr("\\texttt{wind.speed}, m/s & \\texttt{start.altitude}, m & "));
}

}  // namespace
}  // namespace hedgehop::sim
