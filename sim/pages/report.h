#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/pages/plan.h"
#include "sim/record/column_table.h"
#include "sim/record/run_record.h"

namespace hedgehop::sim {

/// A goal on the plan.
struct PlanGoal {
  Eigen::Vector2d p_NE_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// What the report shows of the scenario.
struct ReportScenario {
  std::string description, module, scene, vehicle;  ///< names of the parts that were chosen
  std::string yaml;                                 ///< the resolved scenario
  ScenePlan plan;
  std::optional<PlanGoal> goal;
};

/// All that the report's script draws: the verdict as in result.json, the plan, the path and the time plots, each
/// decimated to about `max_points`. Throws std::runtime_error when a table lacks a column.
nlohmann::ordered_json report_data(const ReportScenario& scenario, const nlohmann::ordered_json& result,
                                   const ColumnTable& trajectory, const ColumnTable& decisions,
                                   size_t max_points = 4000);

/// Writes a run's `report.html` into its folder. One file, no network; a film (`video.webm` in the folder) below 40 MB
/// is inside it, a larger one is linked beside it. The page links `replay.html` where the folder has one.
/// Throws std::runtime_error naming the file and the cause when a film cannot be read or the page not be written.
void write_report(const std::filesystem::path& run_folder, const RunRecord& run);

/// Writes a run's `replay.html` into its folder: the flight in three dimensions, to be played in a browser without
/// network. Throws as write_report().
void write_replay(const std::filesystem::path& run_folder, const RunRecord& run);

}  // namespace hedgehop::sim
