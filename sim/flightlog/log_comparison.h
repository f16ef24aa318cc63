#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "dynamics/vehicle.h"
#include "sim/flightlog/linear_predictor.h"
#include "sim/flightlog/recorded_flight.h"
#include "sim/flightlog/state_errors.h"

namespace hedgehop::sim {

/// Which samples of each log count.
enum class LogShare { all, first, second };

struct ComparisonPlan {
  std::vector<double> horizons_s{0.1, 0.5, 1.0, 2.0};  ///< rising
  double every_s = 0.1;                                ///< time between the starts of windows
  LogShare share = LogShare::all;
  double split = 0.5;  ///< share of the time of each log that is its first part
};

/// RMSE over all windows of one horizon, of the model and of the simple predictions that it must beat.
struct HorizonErrors {
  double horizon_s = 0.0;
  size_t windows = 0;
  StateError model, held, constant_velocity, linear;
};

struct LogComparison {
  LogColumnsConfig::Inputs inputs = LogColumnsConfig::Inputs::motor_speeds;
  std::vector<HorizonErrors> rows;
  bool has_position = false;
  std::optional<double> force_rmse_n;  ///< at the measured states, norm of the vector error; if the logs have the force
  size_t force_samples = 0;
};

/// Returns the part of a log. @param split  share of the time of the log that is its first part, 0 to 1.
LogPart part_of(const RecordedFlight& flight, LogShare share, double split);

/// Throws InputError if a log has no two samples within a horizon, as with times in ms.
void require_samples_within(const RecordedFlight& flight, double horizon_s);

/// Compares a vehicle with logs of its flights. A window lies in one part of its log. The linear model of a window is
/// fitted to the other part of all logs.
/// Throws std::invalid_argument if the vehicle cannot fly, InputError if no window fits into the logs, or if their
/// inputs or rates differ. @param flights  at least one.
LogComparison compare_logs(const dynamics::VehicleConfig& vehicle, std::span<const RecordedFlight> flights,
                           const ComparisonPlan& plan);

}  // namespace hedgehop::sim
