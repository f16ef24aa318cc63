#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "sim/fields/field.h"

/// The checks of a flight in its scenario.
namespace hedgehop::sim {

struct ReachedGoalCheck {
  static constexpr std::string_view kName = "reached_goal";
  static constexpr std::string_view kMeaning = "the flight ends at the goal, in the plan and in height";
  std::optional<double> within_m;  ///< horizontal; default: the goal's radius
  std::optional<double> before_s;  ///< default: the scenario's duration
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ReachedGoalCheck> auto& c) {
  v("within", c.within_m, {.unit = "m", .above = 0.0, .meaning = "distance to the goal; default: the goal's radius"});
  v("before", c.before_s, {.unit = "s", .above = 0.0, .meaning = "latest time; default: the scenario's duration"});
}

struct NoCollisionCheck {
  static constexpr std::string_view kName = "no_collision";
  static constexpr std::string_view kMeaning =
      "the hull has no contact; implied unless the scenario has may_collide: true";
};
template <class Visitor>
void describe(Visitor&, const NoCollisionCheck&) {}

struct MinClearanceCheck {
  static constexpr std::string_view kName = "min_clearance";
  static constexpr std::string_view kMeaning = "the hull keeps a minimum clearance";
  enum class To { anything, obstacles, ground };
  double at_least_m = 1.0;
  To to = To::obstacles;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MinClearanceCheck> auto& c) {
  v("at_least", c.at_least_m, {.unit = "m", .at_least = 0.0, .required = true, .meaning = "minimum clearance"});
  v("to", c.to,
    {.choices = {"anything", "obstacles", "ground"}, .meaning = "objects to which the clearance is measured"});
}

struct AltitudeBandCheck {
  static constexpr std::string_view kName = "altitude_band";
  static constexpr std::string_view kMeaning = "the altitude stays in a band";
  double min_m = 0.0, max_m = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AltitudeBandCheck> auto& c) {
  v("min", c.min_m, {.unit = "m", .required = true, .meaning = "minimum altitude"});
  v("max", c.max_m, {.unit = "m", .required = true, .meaning = "maximum altitude"});
}

struct InsideBoxCheck {
  static constexpr std::string_view kName = "inside_box";
  static constexpr std::string_view kMeaning = "the position stays in a box of the plan";
  double north_min_m = 0.0, north_max_m = 0.0, east_min_m = 0.0, east_max_m = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<InsideBoxCheck> auto& c) {
  v("north_min", c.north_min_m, {.unit = "m", .required = true, .meaning = "southern edge"});
  v("north_max", c.north_max_m, {.unit = "m", .required = true, .meaning = "northern edge"});
  v("east_min", c.east_min_m, {.unit = "m", .required = true, .meaning = "western edge"});
  v("east_max", c.east_max_m, {.unit = "m", .required = true, .meaning = "eastern edge"});
}

struct MaxSpeedCheck {
  static constexpr std::string_view kName = "max_speed";
  static constexpr std::string_view kMeaning = "the speed in three dimensions over ground stays below a limit";
  double at_most_mps = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MaxSpeedCheck> auto& c) {
  v("at_most", c.at_most_mps, {.unit = "m/s", .above = 0.0, .required = true, .meaning = "maximum speed"});
}

struct MaxTiltCheck {
  static constexpr std::string_view kName = "max_tilt";
  static constexpr std::string_view kMeaning = "the body's down axis stays close to the vertical";
  double at_most_rad = 0.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MaxTiltCheck> auto& c) {
  v("at_most", c.at_most_rad,
    {.unit = "deg", .above = 0.0, .at_most = 180.0, .required = true, .meaning = "maximum angle to the vertical"});
}

/// The judge's own figures, docs/metrics.md; those that a flight lacks fail their checks.
inline constexpr auto kJudgesMetrics = std::to_array<std::string_view>({"success",
                                                                        "collision",
                                                                        "center_collision",
                                                                        "hull_collision",
                                                                        "mission_progress",
                                                                        "goal_velocity",
                                                                        "shortest_path",
                                                                        "path_excess",
                                                                        "off_course_at_end_m",
                                                                        "time_to_collision_at_reaction_s",
                                                                        "jerk_rms",
                                                                        "actuator_effort",
                                                                        "off_middle_mean_m",
                                                                        "off_middle_max_m",
                                                                        "off_middle_after_15m_m",
                                                                        "centering_error_mean",
                                                                        "centering_error_median",
                                                                        "centering_error_max",
                                                                        "centering_known_share",
                                                                        "map_tolerance_m",
                                                                        "corners_seen",
                                                                        "corners_found",
                                                                        "map_precision",
                                                                        "map_complete_s",
                                                                        "map_error_percent",
                                                                        "converged_s",
                                                                        "false_landmarks",
                                                                        "false_on_ground"});

struct MetricCheck {
  static constexpr std::string_view kName = "metric";
  static constexpr std::string_view kMeaning =
      "a metric of the flight (docs/metrics.md), or a metric module.NAME of the module, is within bounds";
  std::string name;
  std::optional<double> at_least, at_most;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MetricCheck> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name of the metric, as in result.json"});
  v("at_least", c.at_least, {.meaning = "minimum, in the metric's unit"});
  v("at_most", c.at_most, {.meaning = "maximum, in the metric's unit"});
}

struct FloorVisitedCheck {
  static constexpr std::string_view kName = "floor_visited";
  static constexpr std::string_view kMeaning =
      "enough of the scene's plan is flown over: a cell counts when the rotor "
      "disc has covered its center";
  double cell_m = 1.0;
  double at_least = 0.7;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FloorVisitedCheck> auto& c) {
  v("cell", c.cell_m, {.unit = "m", .above = 0.0, .meaning = "side of a square cell"});
  v("at_least", c.at_least, {.above = 0.0, .at_most = 1.0, .meaning = "share of the cells, 0 to 1"});
}

struct PathToleranceCheck {
  static constexpr std::string_view kName = "path_tolerance";
  static constexpr std::string_view kMeaning =
      "the path follows a reference of `hedgehop bless` within a tolerance and to its end";
  enum class Measure { band, frechet, dtw };
  std::string reference;  ///< file; absolute once a scenario is loaded
  double at_most_m = 0.0;
  Measure measure = Measure::band;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PathToleranceCheck> auto& c) {
  v("reference", c.reference,
    {.required = true, .meaning = "CSV file of the reference, relative to the file with this key"});
  v("at_most", c.at_most_m, {.unit = "m", .above = 0.0, .required = true, .meaning = "maximum deviation"});
  v("measure", c.measure,
    {.choices = {"band", "frechet", "dtw"},
     .meaning = "distance at equal times, or independent of speed: discrete Frechet distance or mean of dynamic time "
                "warping"});
}

struct FormulaCheck {
  static constexpr std::string_view kName = "formula";
  static constexpr std::string_view kMeaning =
      "a formula of temporal logic holds from the flight's start (docs/falsify.md); its value is the robustness";
  std::string name;
  std::string formula;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FormulaCheck> auto& c) {
  v("name", c.name, {.required = true, .meaning = "name of the check in results; must be unique"});
  v("formula", c.formula,
    {.required = true, .meaning = "formula, such as 'always[2,end] (clearance >= 0.5)'; times in s"});
}

struct NoTruthUsedCheck {
  static constexpr std::string_view kName = "no_truth_used";
  static constexpr std::string_view kMeaning = "the avoidance module receives no ground truth: truth_used is empty";
};
template <class Visitor>
void describe(Visitor&, const NoTruthUsedCheck&) {}

struct RealtimeFactorCheck {
  static constexpr std::string_view kName = "realtime_factor";
  static constexpr std::string_view kMeaning =
      "the simulation is fast enough; for benchmarks, because it depends on the machine and its load";
  double at_least = 1.0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RealtimeFactorCheck> auto& c) {
  v("at_least", c.at_least, {.above = 0.0, .required = true, .meaning = "flight time over wall time"});
}

using CheckConfig = std::variant<ReachedGoalCheck, NoCollisionCheck, MinClearanceCheck, AltitudeBandCheck,
                                 InsideBoxCheck, MaxSpeedCheck, MaxTiltCheck, MetricCheck, FloorVisitedCheck,
                                 PathToleranceCheck, FormulaCheck, NoTruthUsedCheck, RealtimeFactorCheck>;

}  // namespace hedgehop::sim
