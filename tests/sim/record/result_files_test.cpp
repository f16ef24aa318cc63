#include "sim/record/result_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/record/table.h"
#include "tests/sim/record/error_of.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const RunInfo kInfo{.scenario = "city",
                    .seed = 18446744073709551615u,
                    .version = "0.1.0",
                    .command_line = "hedgehop run",
                    .scenario_yaml = "name: city\n"};

/// An independent reader: lines by getline, numbers by strtod.
std::vector<std::vector<std::string>> fields_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream fields(line + ",");
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

double number(const std::string& field) { return std::strtod(field.c_str(), nullptr); }

TEST(TrajectoryCsv, ReadsBackToTheSameBits) {
  const Flight flight = fake_flight(3.0, 7);
  const auto rows = fields_of(trajectory_csv(flight));
  ASSERT_EQ(rows.size(), flight.trajectory.size() + 1);
  for (size_t i = 0; i < flight.trajectory.size(); ++i) {
    const TrajectoryRow& row = flight.trajectory[i];
    const auto& fields = rows[i + 1];
    ASSERT_EQ(fields.size(), rows[0].size());
    const std::vector<std::pair<std::string, double>> expected = {{"t_s", row.t_s},
                                                                  {"down_m", row.p_WB_true.z()},
                                                                  {"yaw_rad", row.rpy_true.z()},
                                                                  {"v_east_mps", row.v_WB_W_true.y()},
                                                                  {"r_radps", row.w_WB_B_true.z()},
                                                                  {"est_north_m", row.p_WB_est.x()},
                                                                  {"est_pitch_rad", row.rpy_est.y()},
                                                                  {"est_v_down_mps", row.v_WB_W_est.z()},
                                                                  {"cmd_v_east_mps", row.v_WB_W_cmd->y()},
                                                                  {"cmd_altitude_m", *row.altitude_cmd_m},
                                                                  {"cmd_heading_rad", *row.heading_cmd_rad},
                                                                  {"clearance_m", row.obstacle_clearance_m},
                                                                  {"ground_clearance_m", row.ground_clearance_m},
                                                                  {"collective_rad", row.controls[0]},
                                                                  {"lateral_rad", row.controls[1]},
                                                                  {"longitudinal_rad", row.controls[2]},
                                                                  {"tail_rad", row.controls[3]},
                                                                  {"wind_down_mps", row.wind_W.z()},
                                                                  {"range_m", *row.range_m}};
    for (const auto& [name, value] : expected) {
      const auto column = std::ranges::find(rows[0], name) - rows[0].begin();
      ASSERT_EQ(std::bit_cast<uint64_t>(number(fields[static_cast<size_t>(column)])), std::bit_cast<uint64_t>(value))
          << name << " at " << row.t_s;
    }
  }
}

TEST(TrajectoryCsv, HasTheDocumentedHeader) {
  Flight flight;
  flight.control_names = {"collective_rad", "lateral_rad", "longitudinal_rad", "tail_rad"};
  EXPECT_THAT(trajectory_csv(flight),
              "t_s,north_m,east_m,down_m,roll_rad,pitch_rad,yaw_rad,v_north_mps,v_east_mps,v_down_mps,p_radps,q_radps,"
              "r_radps,est_north_m,est_east_m,est_down_m,est_roll_rad,est_pitch_rad,est_yaw_rad,est_v_north_mps,"
              "est_v_east_mps,est_v_down_mps,cmd_v_north_mps,cmd_v_east_mps,cmd_altitude_m,cmd_heading_rad,clearance_m,"
              "ground_clearance_m,collective_rad,lateral_rad,longitudinal_rad,tail_rad,wind_north_mps,wind_east_mps,"
              "wind_down_mps,model_valid,range_m\n");
}

TEST(TrajectoryCsv, WritesEmptyFieldsForUnknownAndInfForInfinity) {
  Flight flight = fake_flight(0.01, 1);
  flight.trajectory[0].v_WB_W_cmd.reset();
  flight.trajectory[0].altitude_cmd_m.reset();
  flight.trajectory[0].range_m.reset();
  flight.trajectory[0].obstacle_clearance_m = kInfinity;
  flight.trajectory[0].wind_W.x() = kNaN;
  const auto rows = fields_of(trajectory_csv(flight));
  const auto field = [&](std::string_view name) {
    return rows[1][static_cast<size_t>(std::ranges::find(rows[0], name) - rows[0].begin())];
  };
  EXPECT_EQ(field("cmd_v_north_mps"), "");
  EXPECT_EQ(field("cmd_v_east_mps"), "");
  EXPECT_EQ(field("cmd_altitude_m"), "");
  EXPECT_EQ(field("wind_north_mps"), "");
  EXPECT_EQ(field("range_m"), "");
  EXPECT_EQ(field("clearance_m"), "inf");
}

TEST(DecisionsCsv, KeepsWordsWithCommasAndQuotes) {
  const TemporaryFolder folder;
  Flight flight = fake_flight(0.2, 1);
  flight.decisions[0].status = R"(stop, "now")";
  write_file_whole(folder.path() / "decisions.csv", decisions_csv(flight));
  const Table table(folder.path() / "decisions.csv");
  EXPECT_EQ(table.words("status")[0], R"(stop, "now")");
  EXPECT_EQ(table.words("status")[1], "cruise");
  EXPECT_EQ(table.numbers("t_s")[1], flight.decisions[1].t_s);
  EXPECT_EQ(table.numbers("loom_rear_per_s")[1], flight.decisions[1].signals[7]);
}

TEST(ResultFiles, AreCompleteWithoutTemporaryFiles) {
  const TemporaryFolder folder;
  const Flight flight = fake_flight(1.0, 2);
  write_result_files(folder.path() / "a" / "b", kInfo, flight);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "a" / "b")) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names,
              ::testing::UnorderedElementsAre("scenario.yaml", "result.json", "trajectory.csv", "decisions.csv"));
  EXPECT_EQ(read_file_whole(folder.path() / "a" / "b" / "scenario.yaml"), kInfo.scenario_yaml);
}

TEST(ResultFiles, RemoveThoseOfAnEarlierFlight) {
  const TemporaryFolder folder;
  for (const char* name : {"result.json", "report.html", "replay.html", "map.json", "notes.txt"}) {
    write_file_whole(folder.path() / name, "earlier");
  }
  write_result_files(folder.path(), kInfo, fake_flight(1.0, 2));
  EXPECT_NE(read_file_whole(folder.path() / "result.json"), "earlier");
  for (const char* name : {"report.html", "replay.html", "map.json"}) {
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name)) << name;
  }
  EXPECT_EQ(read_file_whole(folder.path() / "notes.txt"), "earlier");  // is a person's
}

TEST(ResultFiles, FullDiskNamesFileAndCause) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "trajectory.csv");
  EXPECT_THAT(error_of([&] { write_result_files(folder.path(), kInfo, fake_flight(1.0, 2)); }),
              AllOf(HasSubstr("trajectory.csv"), HasSubstr("No space left on device")));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "result.json"));
}

TEST(ResultFiles, NamesAFolderThatCannotBeCreatedAndTheCause) {
  const TemporaryFolder folder;
  write_file_whole(folder.path() / "file", "");
  EXPECT_THAT(error_of([&] { write_result_files(folder.path() / "file" / "run", kInfo, {}); }),
              AllOf(HasSubstr("file/run"), HasSubstr("Not a directory")));
}

}  // namespace
}  // namespace hedgehop::sim
