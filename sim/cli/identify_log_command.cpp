#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim/cli/exit_status.h"
#include "sim/cli/log_commands.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_files.h"
#include "sim/config/config_outline.h"
#include "sim/config/input_error.h"
#include "sim/config/outline_texts.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/flightlog/log_fit.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kAtBound = 1e-6;  // of the range

/// Returns "determined", "undetermined" or "at its bound".
std::string data_verdict(const LogFit& found, size_t k) {
  const double z = found.fit.z[static_cast<Eigen::Index>(k)];
  if (!found.data.determined[k]) return "undetermined";
  return z < kAtBound || z > 1.0 - kAtBound ? "at its bound" : "determined";
}

/// Returns the parameters of a direction with their shares: "mass.mass (+0.71), rotor.thrust (+0.70)".
std::string direction_text(const Eigen::VectorXd& direction, const std::vector<FitParameter>& parameters) {
  constexpr double kShown = 0.05;
  std::vector<std::string> parts;
  for (size_t k = 0; k < parameters.size(); ++k) {
    const double share = direction[static_cast<Eigen::Index>(k)];
    if (std::abs(share) >= kShown) parts.push_back(fmt::format("{} ({:+.2f})", parameters[k].name, share));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void print_fit(const LogFit& found, const std::vector<FitParameter>& parameters) {
  size_t width = 9;
  for (const FitParameter& p : parameters) width = std::max(width, p.name.size() + p.unit.size() + 3);
  fmt::print("{:>{}}{:>14}{:>14}{:>16}{:>12}{:>12}  {}\n", "parameter", width, "start", "fitted", "standard error",
             "low", "high", "data");
  for (size_t k = 0; k < parameters.size(); ++k) {
    const FitParameter& p = parameters[k];
    const std::string name = p.unit.empty() ? p.name : fmt::format("{} [{}]", p.name, p.unit);
    fmt::print("{:>{}}{:>14.6g}{:>14.6g}{:>16.2g}{:>12.4g}{:>12.4g}  {}\n", name, width, found.start[k],
               found.values[k], found.standard_error[k], p.low, p.high, data_verdict(found, k));
  }
  fmt::print("RMS of {} residuals: {:.5g} at the start, {:.5g} after {} steps\n", found.residuals,
             std::sqrt(found.fit.start_cost), std::sqrt(found.fit.cost), found.fit.steps);
  for (const Eigen::VectorXd& direction : found.data.silent) {
    fmt::print("the data do not change along: {}\n", direction_text(direction, parameters));
  }
}

Json fit_json(const LogFit& found, const std::vector<FitParameter>& parameters) {
  Json rows = Json::array();
  for (size_t k = 0; k < parameters.size(); ++k) {
    const FitParameter& p = parameters[k];
    const double error = found.standard_error[k];
    rows.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"low", p.low},
                    {"high", p.high},
                    {"start", found.start[k]},
                    {"fitted", found.values[k]},
                    {"standard_error", std::isfinite(error) ? Json(error) : Json(nullptr)},
                    {"data", data_verdict(found, k)}});
  }
  const Eigen::VectorXd& s = found.data.singular_values;
  return {{"parameters", rows},
          {"singular_values", std::vector<double>(s.begin(), s.end())},
          {"residuals", found.residuals},
          {"rms_start", std::sqrt(found.fit.start_cost)},
          {"rms", std::sqrt(found.fit.cost)},
          {"steps", found.fit.steps}};
}

std::string vehicle_yaml(const dynamics::VehicleConfig& vehicle) {
  return std::visit(
      [](const auto& config) { return fmt::format("type: {}\n{}", config.kName, yaml_text(outline_fields(config))); },
      vehicle);
}

}  // namespace

int identify_log(const IdentifyLogOptions& options) {
  if (options.fit.empty()) {
    throw InputError("--fit is missing: name at least one number to fit, such as --fit rotor.drag=0:1e-3");
  }
  for (const auto& file : {options.out, options.out_columns}) {
    if (!file.empty()) require_writable_file(file);
  }
  return about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) {
    const FittedModel model{vehicle, options.columns.empty() ? LogColumnsConfig{} : read_log_columns(options.columns)};
    std::vector<FitParameter> parameters;
    for (const std::string& text : options.fit) parameters.push_back(fit_parameter(model, text));
    const FitPlan plan{.horizon_s = options.horizon_s, .every_s = options.every_s, .split = options.split};
    const LogFit found = fit_logs(model, options.logs, parameters, plan);
    options.json ? fmt::print("{}\n", json_text(fit_json(found, parameters), 2)) : print_fit(found, parameters);
    if (!options.out.empty()) write_named_file(options.out, vehicle_yaml(found.model.vehicle));
    if (!options.out_columns.empty()) {
      write_named_file(options.out_columns, yaml_text(outline_fields(found.model.columns)));
    }
    return 0;
  });
}

}  // namespace hedgehop::sim::cli
