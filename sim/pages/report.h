#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/pages/plan.h"
#include "sim/record/run_record.h"
#include "sim/record/table.h"

namespace hedgehop::sim {

/// A goal or a waypoint on the plan.
struct PlanGoal {
  Eigen::Vector2d p_NE_m = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// The part of the scenario that the report shows.
struct ReportScenario {
  std::string description, module, scene, vehicle;  ///< names of the selected parts
  std::string yaml;                                 ///< the resolved scenario
  ScenePlan plan;
  std::vector<PlanGoal> route;  ///< waypoints before the goal
  std::optional<PlanGoal> goal;
};

/// Returns the contents of result.json for a page, in which the seed is a text, because a number of a page is exact up
/// to 2^53 only.
nlohmann::ordered_json page_result(const RunResult& result);

/// Returns the data of the report: the verdict as in result.json, the plan, the path and the time plots, each decimated
/// to about `max_points`. Throws std::runtime_error if a table lacks a column.
nlohmann::ordered_json report_data(const ReportScenario& scenario, const RunResult& result, const Table& trajectory,
                                   const Table& decisions, size_t max_points = 4000);

/// Returns the time plots of a flight, each decimated to about `max_points`. Throws as report_data().
nlohmann::ordered_json panels_data(const FlightResult& result, const Table& trajectory, const Table& decisions,
                                   size_t max_points);

/// Writes `report.html` into the folder of a run. The page needs no network. It embeds the film (`video.webm` in the
/// folder) if the film is smaller than 40 MB, else it links the film. It links `replay.html` if the folder has one.
/// Throws PagesAbsent, and std::runtime_error with the file and the cause if the film cannot be read or the page cannot
/// be written.
/// @param against  folder of another run to compare with.
void write_report(const std::filesystem::path& run_folder, const RunRecord& run,
                  const std::optional<std::filesystem::path>& against = {});

}  // namespace hedgehop::sim
