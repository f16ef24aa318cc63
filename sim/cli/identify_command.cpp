#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "dynamics/identification/flight_identification.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/cli/vehicle_files.h"
#include "sim/cli/vehicle_inputs.h"
#include "sim/config/utf8.h"
#include "sim/pages/report_page.h"
#include "sim/pages/response_data.h"

namespace hedgehop::sim::cli {
namespace {

namespace identification = dynamics::identification;
using Json = nlohmann::ordered_json;

/// A response of one state to one input at one frequency.
struct Point {
  double gain_db, phase_deg;
};
Point point_of(std::complex<double> value) {
  return {20.0 * std::log10(std::abs(value)), std::arg(value) * 180.0 / std::numbers::pi};
}

struct Identified {
  VehicleInput input;
  Eigen::Index output = 0;
  identification::Identification found;
};

Identified identified(const dynamics::VehicleConfig& vehicle, const IdentifyOptions& options) {
  const VehicleInput input = vehicle_input(vehicle, options.input);
  identification::SweepPlan plan{.v_air_W = {options.speed_mps, 0.0, 0.0},
                                 .sweep = {options.from_radps, options.to_radps, options.duration_s},
                                 .size = std::nullopt,
                                 .input = input.axis};
  if (!options.size.empty()) plan.size = input_size(input, "--size", options.size);
  require_within_stops(vehicle, input, plan.size.value_or(identification::default_sizes(vehicle)[input.axis]),
                       options.speed_mps);
  Identified out{input, input.main_states.front(), *identification::identify(vehicle, plan)};
  if (options.output.empty()) return out;
  const std::vector<std::string>& states = out.found.linear.states;
  const auto state = std::find(states.begin(), states.end(), options.output);
  if (state == states.end()) {
    throw InputError(fmt::format("--output {}: the outputs are {}", options.output, fmt::join(states, ", ")));
  }
  out.output = state - states.begin();
  return out;
}

void print_responses(const Identified& all, bool csv) {
  const auto& [input, output, found] = all;
  const auto state = static_cast<size_t>(output);
  const auto [unit, scale] = readable_unit(found.linear.state_units[state]);
  const double factor = csv ? 1.0 : scale / input.scale;
  if (csv) {
    fmt::print("frequency_radps,gain_db,phase_deg,coherence,linear_gain_db,linear_phase_deg\n");
  } else {
    fmt::print("{} per {}, gain in dB of {} per {}\n{:>18}{:>12}{:>14}{:>12}{:>20}{:>22}\n", found.linear.states[state],
               input.name, unit, input.unit, "frequency [rad/s]", "gain [dB]", "phase [deg]", "coherence",
               "linear: gain [dB]", "linear: phase [deg]");
  }
  for (size_t i = 0; i < found.measured.responses.size(); ++i) {
    const double w = found.measured.frequencies_radps[i];
    const double coherence = found.measured.coherence(static_cast<Eigen::Index>(i), output);
    const Point measured = point_of(found.measured.responses[i](output, input.axis) * factor);
    const Point linear = point_of(found.model.responses[i](output, input.axis) * factor);
    if (csv) {
      fmt::print("{},{},{},{},{},{}\n", w, measured.gain_db, measured.phase_deg, coherence, linear.gain_db,
                 linear.phase_deg);
    } else {
      fmt::print("{:>18.3f}{:>12.2f}{:>14.1f}{:>12.3f}{:>20.2f}{:>22.1f}\n", w, measured.gain_db, measured.phase_deg,
                 coherence, linear.gain_db, linear.phase_deg);
    }
  }
}

/// Returns the responses of all states to the input, complex numbers in the units of the linear model.
Json responses_json(const identification::FrequencyResponse& response, const dynamics::NamedLinearSystem& linear,
                    Eigen::Index input) {
  Json json = Json::object();
  for (size_t state = 0; state < linear.states.size(); ++state) {
    Json values = Json::array();
    for (const Eigen::MatrixXcd& matrix : response.responses) {
      const std::complex<double> value = matrix(static_cast<Eigen::Index>(state), input);
      values.push_back({value.real(), value.imag()});
    }
    json[linear.states[state]] = std::move(values);
  }
  return json;
}

void print_identified_json(const Identified& all, const IdentifyOptions& options) {
  const auto& [input, output, found] = all;
  Json coherence = Json::object(), mismatch = Json::object();
  for (size_t state = 0; state < found.linear.states.size(); ++state) {
    const auto i = static_cast<Eigen::Index>(state);
    const Eigen::VectorXd column = found.measured.coherence.col(i);
    coherence[found.linear.states[state]] = std::vector<double>(column.begin(), column.end());
    mismatch[found.linear.states[state]] = identification::mismatch(found.measured, found.model, i, input.axis);
  }
  const Json json = {{"input", options.input},
                     {"speed_mps", options.speed_mps},
                     {"state_units", found.linear.state_units},
                     {"input_unit", found.linear.input_units[static_cast<size_t>(input.axis)]},
                     {"frequencies_radps", found.measured.frequencies_radps},
                     {"identified", responses_json(found.measured, found.linear, input.axis)},
                     {"linear", responses_json(found.model, found.linear, input.axis)},
                     {"coherence", coherence},
                     {"mismatch", mismatch}};
  fmt::print("{}\n", json_text(json, 2));
}

}  // namespace

int identify(const IdentifyOptions& options) {
  if (options.input.empty())
    throw InputError("identify: expected --input with a control, or --log with recorded flights");
  if (!(options.to_radps > options.from_radps)) throw InputError("--to must be above --from");
  constexpr double kPeriods = 4.0;
  const double shortest_s = kPeriods * 2.0 * std::numbers::pi / options.from_radps;
  if (options.duration_s < shortest_s) {
    throw InputError(fmt::format("--duration {}: must be >= {:.0f} s, four periods of --from {} rad/s",
                                 options.duration_s, std::ceil(shortest_s), options.from_radps));
  }
  const Identified all =
      about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) { return identified(vehicle, options); });
  const double cost = identification::mismatch(all.found.measured, all.found.model, all.output, all.input.axis);
  if (options.json) {
    print_identified_json(all, options);
  } else {
    print_responses(all, options.csv);
    if (!options.csv) {
      fmt::print("mismatch of the linear model: {:.1f} (below 100: good; below 50: hardly noticeable)\n", cost);
    }
  }
  if (!options.plot.empty()) {
    const ResponsePlot plot{
        .title = fmt::format("Frequency responses of {}: {}", options.vehicle.stem().string(), options.input),
        .notes = {fmt::format("Identified by cross spectra from sweeps of all controls, {} to {} rad/s in {} s, about "
                              "the trim at {} m/s, with weak feedback.",
                              options.from_radps, options.to_radps, options.duration_s, options.speed_mps),
                  fmt::format(
                      "Mismatch of the linear model for {}: {:.1f} (below 100: good; below 50: hardly noticeable).",
                      all.found.linear.states[static_cast<size_t>(all.output)], cost)},
        .input = options.input,
        .input_unit = all.input.unit,
        .input_scale = all.input.scale,
        .axis = all.input.axis,
        .main_states = all.input.main_states};
    const Json data = identification_data(plot, all.found);
    write_plot(options.plot, trim_page(plot.title, json_text(data)));
  }
  return 0;
}

}  // namespace hedgehop::sim::cli
