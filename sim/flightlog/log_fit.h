#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "sim/flightlog/bounded_fit.h"
#include "sim/flightlog/named_parameters.h"

namespace hedgehop::sim {

struct FitPlan {
  double horizon_s = 0.5;  ///< of the fitted windows; 0: specific forces at the measured states
  double every_s = 0.5;    ///< time between the starts of windows
  double split = 0.5;      ///< share of the time of each log that is fitted, its first part
  int max_steps = 30;
};

struct LogFit {
  FittedModel model;
  BoundedFit fit;
  Determination data;
  std::vector<double> start, values;  ///< of each parameter, in the unit of its key
  std::vector<double> standard_error;
  size_t residuals = 0;
};

/// Fits parameters of a model to the first part of logs. The residuals are the errors of position, velocity, attitude
/// and rates at half and at the end of each window, each group divided by the RMSE of a state that does not change, at
/// least 0.001 m, m/s, rad or rad/s. With a horizon of 0 they are the errors of the specific force, m/s2. Throws
/// InputError if a log cannot be read, if no window fits, or if the vehicle cannot fly at its start values.
LogFit fit_logs(const FittedModel& model, std::span<const std::filesystem::path> logs,
                std::span<const FitParameter> parameters, const FitPlan& plan);

}  // namespace hedgehop::sim
