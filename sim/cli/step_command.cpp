#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "dynamics/identification/test_inputs.h"
#include "dynamics/identification/trimmed_flight.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/cli/vehicle_files.h"
#include "sim/cli/vehicle_inputs.h"
#include "sim/config/utf8.h"
#include "sim/flight/words.h"
#include "sim/pages/report_page.h"
#include "sim/pages/response_data.h"

namespace hedgehop::sim::cli {
namespace {

namespace identification = dynamics::identification;
using Json = nlohmann::ordered_json;

constexpr double kStartS = 0.5;  // chosen: time before the input, which shows the trim

/// The flight of a test input, and the linear model with the same inputs.
struct StepResponse {
  VehicleInput input;
  dynamics::NamedLinearSystem linear;
  identification::Record record;
  Eigen::MatrixXd linear_states;
};

StepResponse step_response(const dynamics::VehicleConfig& vehicle, const StepOptions& options) {
  const VehicleInput input = vehicle_input(vehicle, options.input);
  const double size = input_size(input, "--size", options.size);
  require_within_stops(vehicle, input, size, options.speed_mps);
  const Eigen::Vector3d v_air_W{options.speed_mps, 0.0, 0.0};
  const bool doublet = options.shape == "doublet";
  const identification::TestFlight test{.v_air_W = v_air_W,
                                        .input =
                                            [=, &options](double t_s) {
                                              const double u = doublet ? identification::doublet_input(
                                                                             size, kStartS, options.width_s, t_s)
                                                                       : identification::step_input(size, kStartS, t_s);
                                              return dynamics::Controls(u * dynamics::Controls::Unit(input.axis));
                                            },
                                        .duration_s = options.duration_s,
                                        .gain = {},
                                        .steps_per_sample = 5};
  StepResponse out{input, *dynamics::linear_system(vehicle, v_air_W), *identification::fly_test(vehicle, test), {}};
  out.linear_states = identification::linear_states(out.linear.system, out.record);
  return out;
}

/// Prints every sample in the units of the linear model.
void print_step_csv(const StepResponse& step) {
  std::vector<std::string> heads{"t_s"};
  for (const std::string& input : step.linear.inputs) heads.push_back(input);
  for (const std::string& state : step.linear.states) heads.push_back(state);
  for (const std::string& state : step.linear.states) heads.push_back(state + "_linear");
  fmt::print("{}\n", fmt::join(heads, ","));
  for (Eigen::Index i = 0; i < step.record.states.rows(); ++i) {
    fmt::print("{:.10g}", static_cast<double>(i) * step.record.step_s);
    for (const double value : step.record.inputs.row(i)) fmt::print(",{}", value);
    for (const double value : step.record.states.row(i)) fmt::print(",{}", value);
    for (const double value : step.linear_states.row(i)) fmt::print(",{}", value);
    fmt::print("\n");
  }
}

Json columns_json(const Eigen::MatrixXd& values, const std::vector<std::string>& names) {
  Json json = Json::object();
  for (Eigen::Index j = 0; j < values.cols(); ++j) {
    const Eigen::VectorXd column = values.col(j);
    json[names[static_cast<size_t>(j)]] = std::vector<double>(column.begin(), column.end());
  }
  return json;
}

void print_step_json(const StepResponse& step, const StepOptions& options) {
  std::vector<double> times;
  for (Eigen::Index i = 0; i < step.record.states.rows(); ++i)
    times.push_back(static_cast<double>(i) * step.record.step_s);
  const Json json = {{"input", options.input},
                     {"shape", options.shape},
                     {"size", options.size},
                     {"speed_mps", options.speed_mps},
                     {"state_units", step.linear.state_units},
                     {"input_units", step.linear.input_units},
                     {"t_s", times},
                     {"inputs", columns_json(step.record.inputs, step.linear.inputs)},
                     {"states", columns_json(step.record.states, step.linear.states)},
                     {"linear_states", columns_json(step.linear_states, step.linear.states)}};
  fmt::print("{}\n", json_text(json, 2));
}

/// Prints about 25 rows, and the peak of each state that the control commands.
void print_step_table(const StepResponse& step) {
  constexpr Eigen::Index kRows = 25;
  fmt::print("{:>8}{:>20}", "t [s]", fmt::format("{} [{}]", step.input.name, step.input.unit));
  for (const Eigen::Index state : step.input.main_states) {
    const auto index = static_cast<size_t>(state);
    const std::string unit = readable_unit(step.linear.state_units[index]).first;
    fmt::print("{:>16}{:>12}", fmt::format("{} [{}]", step.linear.states[index], unit), "linear");
  }
  fmt::print("\n");
  const Eigen::Index rows = step.record.states.rows(), every = std::max<Eigen::Index>(rows / kRows, 1);
  for (Eigen::Index i = 0; i < rows; i += every) {
    fmt::print("{:>8.2f}{:>20}", static_cast<double>(i) * step.record.step_s,
               decimals(step.record.inputs(i, step.input.axis) * step.input.scale, 3));
    for (const Eigen::Index state : step.input.main_states) {
      const double scale = readable_unit(step.linear.state_units[static_cast<size_t>(state)]).second;
      fmt::print("{:>16}{:>12}", decimals(step.record.states(i, state) * scale, 3),
                 decimals(step.linear_states(i, state) * scale, 3));
    }
    fmt::print("\n");
  }
  for (const Eigen::Index state : step.input.main_states) {
    const auto index = static_cast<size_t>(state);
    const auto [unit, scale] = readable_unit(step.linear.state_units[index]);
    Eigen::Index at = 0;
    const Eigen::VectorXd full = step.record.states.col(state) * scale;
    full.cwiseAbs().maxCoeff(&at);
    const double apart = (full - step.linear_states.col(state) * scale).cwiseAbs().maxCoeff();
    fmt::print("{}: peak {:.4g} {} at {:.2f} s; the linear model differs by at most {:.3g} {}\n",
               step.linear.states[index], full[at], unit, static_cast<double>(at) * step.record.step_s, apart, unit);
  }
}

}  // namespace

int step(const StepOptions& options) {
  const StepResponse response =
      about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) { return step_response(vehicle, options); });
  if (options.json) {
    print_step_json(response, options);
  } else if (options.csv) {
    print_step_csv(response);
  } else {
    print_step_table(response);
  }
  if (!options.plot.empty()) {
    const ResponsePlot plot{
        .title =
            fmt::format("Response of {} to a {}: {}", options.vehicle.stem().string(), options.shape, options.input),
        .notes = {fmt::format("A {} of {} from the trim at {} m/s, without feedback.", options.shape, options.size,
                              options.speed_mps),
                  "The full model has servos and motors; the linear model gets the positions that they reach."},
        .input = options.input,
        .input_unit = response.input.unit,
        .input_scale = response.input.scale,
        .axis = response.input.axis,
        .main_states = response.input.main_states};
    const Json data = step_data(plot, response.linear, response.record, response.linear_states);
    write_plot(options.plot, trim_page(plot.title, json_text(data)));
  }
  return 0;
}

}  // namespace hedgehop::sim::cli
