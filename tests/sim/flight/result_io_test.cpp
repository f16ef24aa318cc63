#include "sim/flight/result_io.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "tests/sim/record/error_of.h"
#include "tests/sim/record/fake_flight.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const RunInfo kInfo{.scenario = "city",
                    .seed = 18446744073709551615u,
                    .version = "0.1.0",
                    .build = "0123456789abcdef",
                    .inputs = {{"configs/city.yaml", "sha"}, {"rig.yaml", "other"}},
                    .scenario_file = "configs/city.yaml",
                    .command_line = "hedgehop run",
                    .scenario_yaml = {}};

/// Counts of a link that differ from their defaults and from each other.
LinkFigures distinct_link() {
  return {"ardupilot_json", "127.0.0.1:9002", 101, 102, 103, 104, 105, 106, 107, 108, 109, 110.5};
}

/// A result in which every field differs from its default and from every other field.
FlightResult distinct_result() {
  FlightResult r;
  r.outcome = Outcome::collided;
  r.cause = "hit tower";
  r.goal_missed_unchecked = true;
  r.truth_used = {"camera 'front': depth", "sensor 'gps': exact"};
  r.failures = {"2 s to 4 s: gps off"};
  r.physics_rate_hz = 36;
  r.flight_time_s = 1.0 / 3.0;
  r.path_length_m = 2.1;
  r.mean_speed_mps = 3.2;
  r.closest_obstacle = {.distance_m = -0.25, .t_s = 4.3, .what = "tower", .p_WB_true = {5.4, 6.5, -7.6}};
  r.closest_ground = {.distance_m = 0.125, .t_s = 8.7, .what = "ground", .p_WB_true = {9.8, 10.9, -11.1}};
  r.goal_distance_m = 12.2;
  r.decisions = 13;
  r.decision_ms = {14.4, 15.5};
  r.render_ms = {16.6, 17.7};
  r.velocimeter_ms = {18.8, 19.9};
  r.physics_ms = {20.1, 21.2};
  r.realtime_factor = 22.3;
  r.wall_s = 23.4;
  r.checks = {{"no_collision", false, -0.25, 0.0, "m", ">", 4.3, "to the tower"},
              {"reached_goal", true, 24.5, 30.0, "s", "<=", {}},
              {"clearance", true, 25.5, 1.5, "m", ">=", 26.5}};
  r.trajectory_hash = "fedcba9876543210";
  r.libraries = {.images = "OpenCV", .functions = "SLEEF", .others = "Eigen", .renderer = "tiles"};
  r.metrics = {{"path_excess", 27.5, "m", FigureKind::judged},
               {"module.corners", 28.5, "", FigureKind::module},
               {"filter_ms", 29.5, "ms", FigureKind::wall_time}};
  r.scene = {.solids = 31, .smallest_gap_m = 32.5, .median_gap_m = 33.5, .covered_share = 0.34, .density_pm2 = 0.35};
  r.link = distinct_link();
  return r;
}

void expect_equal(const ClosestApproach& a, const ClosestApproach& b) {
  EXPECT_EQ(a.distance_m, b.distance_m);
  EXPECT_EQ(a.t_s, b.t_s);
  EXPECT_EQ(a.what, b.what);
  EXPECT_EQ(a.p_WB_true, b.p_WB_true);
}

void expect_equal(const StageTime& a, const StageTime& b) {
  EXPECT_EQ(a.median_ms, b.median_ms);
  EXPECT_EQ(a.p95_ms, b.p95_ms);
}

void expect_equal(const LinkFigures& a, const LinkFigures& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.peer, b.peer);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.repeated, b.repeated);
  EXPECT_EQ(a.old, b.old);
  EXPECT_EQ(a.resent, b.resent);
  EXPECT_EQ(a.missed, b.missed);
  EXPECT_EQ(a.unanswered, b.unanswered);
  EXPECT_EQ(a.malformed, b.malformed);
  EXPECT_EQ(a.strangers, b.strangers);
  EXPECT_EQ(a.start_tick, b.start_tick);
  EXPECT_EQ(a.waited_s, b.waited_s);
}

TEST(ResultIo, RoundTripKeepsEveryFieldBitForBit) {
  const FlightResult r = distinct_result();
  const RunResult read = result_from_json(Json::parse(result_json(kInfo, r)));
  EXPECT_EQ(read.info.scenario, kInfo.scenario);
  EXPECT_EQ(read.info.seed, kInfo.seed);
  EXPECT_EQ(read.info.version, kInfo.version);
  EXPECT_EQ(read.info.build, kInfo.build);
  EXPECT_EQ(read.info.inputs, kInfo.inputs);
  EXPECT_EQ(read.info.scenario_file, kInfo.scenario_file);
  EXPECT_EQ(read.info.command_line, kInfo.command_line);
  const FlightResult& f = read.flight;
  EXPECT_EQ(f.outcome, r.outcome);
  EXPECT_EQ(f.cause, r.cause);
  EXPECT_EQ(f.goal_missed_unchecked, r.goal_missed_unchecked);
  EXPECT_EQ(f.truth_used, r.truth_used);
  EXPECT_EQ(f.failures, r.failures);
  EXPECT_EQ(f.physics_rate_hz, r.physics_rate_hz);
  EXPECT_EQ(f.flight_time_s, r.flight_time_s);
  EXPECT_EQ(f.path_length_m, r.path_length_m);
  EXPECT_EQ(f.mean_speed_mps, r.mean_speed_mps);
  expect_equal(f.closest_obstacle, r.closest_obstacle);
  expect_equal(f.closest_ground, r.closest_ground);
  EXPECT_EQ(f.goal_distance_m, r.goal_distance_m);
  EXPECT_EQ(f.decisions, r.decisions);
  expect_equal(f.decision_ms, r.decision_ms);
  expect_equal(f.render_ms, r.render_ms);
  expect_equal(f.velocimeter_ms, r.velocimeter_ms);
  expect_equal(f.physics_ms, r.physics_ms);
  EXPECT_EQ(f.realtime_factor, r.realtime_factor);
  EXPECT_EQ(f.wall_s, r.wall_s);
  ASSERT_EQ(f.checks.size(), r.checks.size());
  for (size_t i = 0; i < r.checks.size(); ++i) {
    EXPECT_EQ(f.checks[i].name, r.checks[i].name);
    EXPECT_EQ(f.checks[i].cause, r.checks[i].cause);
    EXPECT_EQ(f.checks[i].passed, r.checks[i].passed);
    EXPECT_EQ(f.checks[i].value, r.checks[i].value);
    EXPECT_EQ(f.checks[i].limit, r.checks[i].limit);
    EXPECT_EQ(f.checks[i].unit, r.checks[i].unit);
    EXPECT_EQ(f.checks[i].must, r.checks[i].must);
    EXPECT_EQ(f.checks[i].t_s, r.checks[i].t_s);
  }
  EXPECT_EQ(f.trajectory_hash, r.trajectory_hash);
  EXPECT_EQ(f.libraries.images, r.libraries.images);
  EXPECT_EQ(f.libraries.functions, r.libraries.functions);
  EXPECT_EQ(f.libraries.others, r.libraries.others);
  EXPECT_EQ(f.libraries.renderer, r.libraries.renderer);
  ASSERT_EQ(f.metrics.size(), r.metrics.size());
  for (size_t i = 0; i < r.metrics.size(); ++i) {
    EXPECT_EQ(f.metrics[i].name, r.metrics[i].name);
    EXPECT_EQ(f.metrics[i].value, r.metrics[i].value);
    EXPECT_EQ(f.metrics[i].unit, r.metrics[i].unit);
    EXPECT_EQ(f.metrics[i].kind, r.metrics[i].kind);
  }
  EXPECT_EQ(f.scene.solids, r.scene.solids);
  EXPECT_EQ(f.scene.smallest_gap_m, r.scene.smallest_gap_m);
  EXPECT_EQ(f.scene.median_gap_m, r.scene.median_gap_m);
  EXPECT_EQ(f.scene.covered_share, r.scene.covered_share);
  EXPECT_EQ(f.scene.density_pm2, r.scene.density_pm2);
  ASSERT_TRUE(f.link);
  expect_equal(*f.link, *r.link);
}

TEST(ResultIo, RoundTripKeepsAbsentAndNonFiniteValues) {
  FlightResult r;
  r.outcome = Outcome::timeout;
  r.closest_obstacle.distance_m = r.closest_ground.distance_m = kInfinity;
  r.mean_speed_mps = kNaN;
  r.scene.smallest_gap_m = r.scene.median_gap_m = kInfinity;
  r.checks = {{"metric", false, kNaN, kInfinity, ""}};
  r.metrics = {{"m", kNaN, ""}};
  r.link = distinct_link();
  r.link->start_tick = std::nullopt;
  const FlightResult f = result_from_json(Json::parse(result_json(kInfo, r))).flight;
  EXPECT_EQ(f.closest_obstacle.distance_m, kInfinity);
  EXPECT_EQ(f.closest_ground.distance_m, kInfinity);
  EXPECT_TRUE(std::isnan(f.mean_speed_mps));
  EXPECT_EQ(f.goal_distance_m, std::nullopt);
  EXPECT_EQ(f.checks[0].t_s, std::nullopt);
  ASSERT_TRUE(f.link);
  expect_equal(*f.link, *r.link);
  EXPECT_TRUE(std::isnan(f.checks[0].value));
  EXPECT_TRUE(std::isnan(f.checks[0].limit));
  EXPECT_TRUE(std::isnan(f.metrics[0].value));
  EXPECT_EQ(f.scene.smallest_gap_m, kInfinity);
  EXPECT_EQ(f.scene.median_gap_m, kInfinity);
}

TEST(ResultIo, RefusesKeysOfEarlierVersionsWithTheNewName) {
  struct Row {
    std::string object, before, now;
  };
  for (const Row& row : {Row{"scene", "least_gap_m", "min_gap_m"}, Row{"libraries", "drawn_by", "renderer"}}) {
    Json json = to_json(kInfo, distinct_result());
    Json& object = json[row.object];
    object[row.before] = object[row.now];
    object.erase(row.now);
    EXPECT_THAT(error_of([&] { result_from_json(json); }),
                AllOf(HasSubstr(row.object + "." + row.before), HasSubstr(row.object + "." + row.now)));
  }
}

// Readers rely on the types in a result. A result changed by hand must not end a campaign.
TEST(ResultJson, IsRejectedIfATypeDiffersFromTheWriters) {
  const TemporaryFolder folder;
  const auto read = [&](const Json& json) {
    write_file_whole(folder.path() / "result.json", json.dump());
    return read_result(folder.path() / "result.json");
  };
  const Json whole = Json::parse(result_json(kInfo, fake_flight(1.0, 1).result));
  const RunResult run = read(whole);
  ASSERT_EQ(to_json(run.info, run.flight), whole);
  for (const auto& [key, value] : whole.items()) {
    for (const Json& other : {Json("word"), Json(-1.5), Json::array({3}), Json{{"a", 3}}, Json(true)}) {
      if (value.is_null() || other.type() == value.type() || (other.is_number() && value.is_number())) continue;
      Json changed = whole;
      changed[key] = other;
      EXPECT_THROW(read(changed), InputError) << key << ": " << other;
    }
    if (value.is_number() || value.is_null() || key.starts_with("closest_")) continue;  // null is not finite
    Json changed = whole;
    changed[key] = nullptr;
    EXPECT_THROW(read(changed), InputError) << key;
  }
  Json changed = whole;
  changed["metrics"]["a"] = "word";
  EXPECT_THROW(read(changed), InputError);
  changed = whole;
  changed["checks"][0]["passed"] = 1;
  EXPECT_THROW(read(changed), InputError);
  changed = whole;
  Json* inner = &changed["unknown"];
  for (int i = 0; i < 100; ++i) inner = &(*inner)["a"];
  EXPECT_THROW(read(changed), InputError);
}

TEST(ResultJson, HasTheDocumentedKeysInOrder) {
  const auto json = nlohmann::ordered_json::parse(result_json(kInfo, fake_flight(1.0, 1).result));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  EXPECT_THAT(keys, IsSupersetOf({"scenario",
                                  "seed",
                                  "version",
                                  "outcome",
                                  "truth_used",
                                  "flight_time_s",
                                  "path_length_m",
                                  "min_clearance_m",
                                  "min_clearance_time_s",
                                  "mean_speed_mps",
                                  "goal_distance_m",
                                  "decisions",
                                  "decision_ms",
                                  "render_ms",
                                  "realtime_factor",
                                  "wall_s",
                                  "checks",
                                  "trajectory_hash",
                                  "metrics",
                                  "min_obstacle_clearance_m",
                                  "min_ground_clearance_m",
                                  "command_line"}));
  EXPECT_EQ(keys.front(), "scenario");
  EXPECT_EQ(json.at("seed").get<uint64_t>(), kInfo.seed);
  EXPECT_EQ(json.at("outcome"), "reached");
  EXPECT_EQ(json.at("decision_ms").at("p95"), 7.9);
  EXPECT_EQ(json.at("metrics").at("largest_flow"), 1.234);
}

TEST(ResultJson, MinimumClearanceIsThatOfObstaclesAndGround) {
  FlightResult result;
  result.closest_obstacle = {.distance_m = 2.5, .t_s = 4.0, .what = "wall"};
  result.closest_ground = {.distance_m = 0.5, .t_s = 9.0, .what = "ground"};
  const auto json = nlohmann::ordered_json::parse(result_json(kInfo, result));
  EXPECT_EQ(json.at("min_clearance_m"), 0.5);
  EXPECT_EQ(json.at("min_clearance_time_s"), 9.0);
  EXPECT_EQ(json.at("min_obstacle_clearance_m"), 2.5);
}

TEST(ResultJson, WritesNullForNumbersThatAreNotFinite) {
  FlightResult result;
  result.closest_obstacle.distance_m = result.closest_ground.distance_m = kInfinity;
  result.mean_speed_mps = kNaN;
  result.checks = {{"min_clearance", false, kNaN, kInfinity, "m"}};
  const auto json = nlohmann::ordered_json::parse(result_json(kInfo, result));
  for (const char* key :
       {"min_clearance_m", "min_clearance_time_s", "closest_obstacle", "mean_speed_mps", "goal_distance_m"}) {
    EXPECT_TRUE(json.at(key).is_null()) << key;
  }
  EXPECT_TRUE(json.at("checks")[0].at("value").is_null());
}

}  // namespace
}  // namespace hedgehop::sim
