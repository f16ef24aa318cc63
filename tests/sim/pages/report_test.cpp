#include "sim/pages/report.h"
#include "sim/pages/replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>

#include "sim/config/whole_file.h"
#include "sim/pages/panels.h"
#include "sim/pages/report_page.h"
#include "sim/record/flight_columns.h"
#include "sim/record/result_files.h"
#include "sim/scenario/flight_parts.h"
#include "tests/sim/pages/page_data.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// --- Panels

/// Tables of a synthetic flight.
class Tables {
 public:
  explicit Tables(const Flight& flight)
      : trajectory_(trajectory_columns(flight)),
        decisions_(decision_columns(flight)),
        result_{.info = {.scenario = "name"}, .flight = flight.result} {}
  const Table& trajectory() const { return trajectory_; }
  const Table& decisions() const { return decisions_; }
  const RunResult& result() const { return result_; }

 private:
  Table trajectory_, decisions_;
  RunResult result_;
};

const Panel& panel(const std::vector<Panel>& panels, std::string_view title) {
  const auto found = std::ranges::find_if(panels, [&](const Panel& p) { return p.title.starts_with(title); });
  if (found == panels.end()) throw std::runtime_error("no panel " + std::string(title));
  return *found;
}

TEST(Panels, VelocityAlongTheHeadingIsForwardOnly) {
  Flight flight = fake_flight(0.5, 1);
  for (TrajectoryRow& row : flight.trajectory) {
    row.rpy_true.z() = 0.7;
    row.v_WB_W_true = {3.0 * std::cos(0.7), 3.0 * std::sin(0.7), 0.4};
  }
  const auto panels = trajectory_panels(Tables(flight).trajectory(), {});
  for (const double v : panel(panels, "Forward").series[2].values) EXPECT_NEAR(v, 3.0, 1e-12);
  for (const double v : panel(panels, "Sideways").series[2].values) EXPECT_NEAR(v, 0.0, 1e-12);
}

TEST(Panels, ClearancesAboveTheLimitOfThePlotRemainVisible) {
  Flight flight = fake_flight(0.5, 1);
  const auto highest = [&](double clearance_m) {
    for (TrajectoryRow& row : flight.trajectory) row.obstacle_clearance_m = row.ground_clearance_m = clearance_m;
    flight.trajectory.back().obstacle_clearance_m = 30.0;
    return panel(trajectory_panels(Tables(flight).trajectory(), {}), "Clearance").highest;
  };
  EXPECT_EQ(highest(5.0), 20.0);
  EXPECT_EQ(highest(25.0), std::nullopt);
}

TEST(Panels, HeadingThroughSouthDoesNotJump) {
  Flight flight = fake_flight(2.0, 1);
  double yaw_rad = 3.0;
  for (TrajectoryRow& row : flight.trajectory) {
    yaw_rad += 0.01;
    row.rpy_true.z() = std::remainder(yaw_rad, 2.0 * M_PI);
    row.heading_cmd_rad = M_PI;
  }
  const auto panels = trajectory_panels(Tables(flight).trajectory(), {});
  for (const Series& series : panel(panels, "Heading").series) {
    if (series.role == "est") continue;
    for (size_t i = 1; i < series.values.size(); ++i) {
      ASSERT_NEAR(series.values[i], series.values[i - 1], 1.0) << series.role << " " << i;
    }
  }
}

TEST(Panels, SignalsAreGroupedByNameAndUnit) {
  const auto panels = signal_panels(Tables(fake_flight(1.0, 1)).decisions());
  ASSERT_EQ(panels.size(), 3u);
  EXPECT_EQ(panels[0].unit, "rad/s");
  EXPECT_EQ(panels[1].unit, "1/s");
  ASSERT_EQ(panels[0].series.size(), 4u);
  EXPECT_EQ(panels[0].series[0].role, "left");
  EXPECT_EQ(panels[0].series[3].role, "rear");
  EXPECT_EQ(panels[2].title, "Goal distance");
  EXPECT_EQ(panels[2].unit, "m");
}

TEST(Panels, CommonFirstWordsOfSignalsAreTheTitle) {
  Flight flight = fake_flight(0.1, 1);
  flight.signals = {{"valid_share_left", ""},
                    {"valid_share_right", ""},
                    {"speed_mps", ""},
                    {"target_v_north_mps", ""},
                    {"target_v_east_mps", ""}};
  for (DecisionRow& row : flight.decisions) row.signals.assign(5, 1.0);
  const auto panels = signal_panels(Tables(flight).decisions());
  ASSERT_EQ(panels.size(), 3u);
  EXPECT_EQ(panels[0].title, "Valid share");
  EXPECT_EQ(panels[0].series[1].label, "right");
  EXPECT_EQ(panels[1].title, "Speed");
  EXPECT_EQ(panels[1].series[0].label, "speed");
  EXPECT_EQ(panels[2].title, "Target velocity");
  EXPECT_EQ(panels[2].series[0].label, "north");
}

TEST(ReportData, WritesNullForUnknownValues) {
  Flight flight = fake_flight(1.0, 1);
  for (TrajectoryRow& row : flight.trajectory) row.obstacle_clearance_m = std::numeric_limits<double>::infinity();
  const Tables tables(flight);
  const auto json = report_data({}, tables.result(), tables.trajectory(), tables.decisions());
  EXPECT_TRUE(json.at("path").at("clearance")[0].is_null());
}

TEST(ReportData, StatusIsThatOfTheLastDecision) {
  Flight flight = fake_flight(1.0, 1);
  flight.decisions = {{.t_s = 0.2, .status = "first", .signals = std::vector<double>(9, 0.0)},
                      {.t_s = 0.5, .status = "second", .signals = std::vector<double>(9, 0.0)}};
  const Tables tables(flight);
  const auto path = report_data({}, tables.result(), tables.trajectory(), tables.decisions()).at("path");
  EXPECT_EQ(path.at("statuses"), (std::vector<std::string>{"first", "second"}));
  EXPECT_EQ(path.at("status")[19], -1);
  EXPECT_EQ(path.at("status")[20], 0);
  EXPECT_EQ(path.at("status")[50], 1);
}

TEST(ReportData, HasAtMostTheGivenNumberOfPoints) {
  const Tables tables(fake_flight(100.0, 1));
  const auto json = report_data({}, tables.result(), tables.trajectory(), tables.decisions(), 500);
  EXPECT_LE(json.at("path").at("t").size(), 500u);
  for (const auto& panel : json.at("panels")) EXPECT_LE(panel.at("t_s").size(), 500u) << panel.at("title");
}

TEST(ReportData, AcceptsAFlightWithoutRowsAndDecisions) {
  Flight flight = fake_flight(0.1, 1);
  flight.trajectory.clear();
  flight.decisions.clear();
  const Tables tables(flight);
  EXPECT_NO_THROW(report_data({}, tables.result(), tables.trajectory(), tables.decisions()));
}

// --- Page

TEST(ReportPage, Base64FollowsTheTestVectorsOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(ReportPage, DataCannotEndItsScriptAndIsReadUnchanged) {
  const nlohmann::json nasty = {{"a", "</script><script>alert(1)</script>"}, {"b", "<!-- \\u003c \" \\"}};
  const std::string safe = script_safe(nasty.dump());
  EXPECT_THAT(safe, Not(HasSubstr("<")));
  EXPECT_EQ(nlohmann::json::parse(safe), nasty);
}

TEST(ReportPage, TitleIsEscaped) {
  const std::string page = report_page("a<b> & \"c\"", "{}", {});
  EXPECT_THAT(page, HasSubstr("<title>a&lt;b&gt; &amp; &quot;c&quot; - Hedgehop</title>"));
}

TEST(ReportPage, PlaceholdersInValuesAreNotReplaced) {
  EXPECT_THAT(report_page("{{data}} {{nonsense}}", "{}", {}), HasSubstr("<title>{{data}} {{nonsense}} - Hedgehop"));
}

TEST(ReportPage, ClosesEveryScriptOnce) {
  const std::string page = report_page("t", R"({"a":"</script>"})", {.bytes = "film"});
  const auto count = [&](const std::string& text) {
    size_t n = 0;
    for (size_t at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<script"), 4u);
  EXPECT_EQ(count("</script"), 4u);
}

TEST(ReportPage, LoadsNoExternalResources) {
  const std::string page = report_page("t", "{}", {.bytes = "film"});
  for (const char* way : {R"((src|href)\s*=\s*["']?\s*(https?:)?//)", R"(url\()", "@import", R"(\bfetch\()",
                          "XMLHttpRequest", R"(\bimport\()", "sendBeacon", "WebSocket", R"(<link)", R"(<iframe)"}) {
    EXPECT_FALSE(std::regex_search(page, std::regex(way))) << way;
  }
}

TEST(ReportPage, FilmIsEmbeddedOrLinkedOrAbsent) {
  EXPECT_THAT(report_page("t", "{}", {.bytes = "film"}), HasSubstr(base64("film")));
  EXPECT_THAT(report_page("t", "{}", {.link = "video.webm"}), HasSubstr("src=\"video.webm\""));
  EXPECT_THAT(report_page("t", "{}", {}), Not(HasSubstr("<video")));
}

TEST(Report, DrawsTheSceneThatWasFlown) {
  const TemporaryFolder folder;
  const Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml");
  constexpr uint64_t kSeed = 9;  // of the run; the file has another one
  write_result_files(folder.path(), {.scenario = "city </script>", .seed = kSeed, .scenario_yaml = to_yaml(scenario)},
                     fake_flight(2.0, 1));
  write_report(folder.path(), read_run(folder.path()));
  const nlohmann::json data = data_of(read_file_whole(folder.path() / "report.html"));
  const scenes::Scene scene = build_scene(scenario.scene, kSeed);
  ASSERT_EQ(data.at("plan").at("footprints").size(), scene.solids.size());
  EXPECT_EQ(data.at("plan").at("footprints")[3].at("name"), scene.solids[3].name);
  EXPECT_EQ(data.at("plan").at("goal").at("n"), scenario.goal->north_m);
  EXPECT_EQ(data.at("result").at("scenario"), "city </script>");
  EXPECT_EQ(data.at("module"), "flow_balance");
  EXPECT_EQ(data.at("scenario_yaml"), to_yaml(scenario));
}

TEST(Report, AndReplayShowTheWaypointsOfTheRoute) {
  const TemporaryFolder folder;
  const std::vector<std::string> overrides = {"route=[{north: 40, east: 5, altitude: 15, radius: 3}]",
                                              "drawing.renderer=tiles"};
  const Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml", overrides);
  const RunInfo info{.scenario = "route", .seed = 9, .scenario_yaml = to_yaml(scenario)};
  write_result_files(folder.path(), info, fake_flight(2.0, 1));
  write_report(folder.path(), read_run(folder.path()));
  write_replay(folder.path(), read_run(folder.path()));
  const auto data = [&](const char* page) { return data_of(read_file_whole(folder.path() / page)); };
  EXPECT_EQ(data("report.html").at("plan").at("route"), nlohmann::json::parse(R"([{"n": 40, "e": 5, "radius": 3}])"));
  EXPECT_EQ(data("replay.html").at("route"), nlohmann::json::parse("[[40, 5, -15, 3]]"));
}

TEST(Report, OfAFlightInMemoryEqualsThatFromItsFiles) {
  const TemporaryFolder folder;
  const Scenario scenario = load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_city_0_light.yaml");
  const RunInfo info{.scenario = "city", .seed = 9, .scenario_yaml = to_yaml(scenario)};
  Flight flight = fake_flight(2.0, 1);
  flight.trajectory[3].v_WB_W_cmd.reset();
  flight.trajectory[4].obstacle_clearance_m = std::numeric_limits<double>::infinity();
  flight.map.points = {{{40, 10, -20}, Eigen::Matrix3d::Identity(), true}};
  write_result_files(folder.path(), info, flight);
  using Write = void (*)(const std::filesystem::path&, const RunRecord&);
  const Write report = [](const std::filesystem::path& to, const RunRecord& run) { write_report(to, run); };
  const Write replay = [](const std::filesystem::path& to, const RunRecord& run) { write_replay(to, run); };
  for (const auto& [write, page] : {std::pair(report, "report.html"), std::pair(replay, "replay.html")}) {
    write(folder.path(), run_record(scenario, info, flight));
    const std::string in_memory = read_file_whole(folder.path() / page);
    std::filesystem::remove(folder.path() / page);
    write(folder.path(), read_run(folder.path()));
    const std::string from_files = read_file_whole(folder.path() / page);
    const auto differs = static_cast<size_t>(std::ranges::mismatch(from_files, in_memory).in1 - from_files.begin());
    EXPECT_EQ(from_files == in_memory, true) << page << ": " << from_files.substr(differs, 80) << "\n"
                                             << in_memory.substr(differs, 80);
  }
}

TEST(Report, NamesAMissingFile) {
  const TemporaryFolder folder;
  try {
    read_run(folder.path());
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("result.json: there is no such file"));
  }
}

}  // namespace
}  // namespace hedgehop::sim
