#include "sim/pages/response_data.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr Eigen::Index kBodyStates = 9;  // velocity, rates, attitude

Json response_panel(const std::string& section, const std::string& title, const std::string& unit, const char* axis_key,
                    Json axis) {
  return {{"section", section},
          {"title", title},
          {"unit", unit},
          {"note", ""},
          {"lowest", nullptr},
          {"highest", nullptr},
          {"limits", Json::array()},
          {axis_key, std::move(axis)},
          {"series", Json::array()}};
}

void add_series(Json& panel, const std::string& label, const char* role, Json values) {
  panel["series"].push_back({{"label", label}, {"role", role}, {"values", std::move(values)}});
}

Json scaled(const Eigen::Ref<const Eigen::VectorXd>& values, double scale) {
  Json out = Json::array();
  for (const double value : values) out.push_back(value * scale);
  return out;
}

/// Returns the phases in degrees without jumps of a turn.
std::vector<double> unwrapped_deg(const std::vector<std::complex<double>>& values) {
  std::vector<double> phases;
  for (const std::complex<double>& value : values) {
    double phase = std::arg(value) * kDegPerRad;
    if (!phases.empty()) phase += 360.0 * std::round((phases.back() - phase) / 360.0);
    phases.push_back(phase);
  }
  return phases;
}

/// Returns the name of a state with its meaning: "pitch rate, q".
std::string state_words(const std::string& name) {
  static const std::map<std::string_view, std::string_view> kMeanings = {{"u", "forward velocity"},
                                                                         {"v", "velocity to the right"},
                                                                         {"w", "downward velocity"},
                                                                         {"p", "roll rate"},
                                                                         {"q", "pitch rate"},
                                                                         {"r", "yaw rate"},
                                                                         {"phi", "roll"},
                                                                         {"theta", "pitch"},
                                                                         {"psi", "yaw"}};
  const auto found = kMeanings.find(name);
  return found == kMeanings.end() ? name : std::string(found->second) + ", " + name;
}

/// Returns the body's states, the main ones first.
std::vector<Eigen::Index> states_in_order(const ResponsePlot& plot) {
  std::vector<Eigen::Index> order = plot.main_states;
  for (Eigen::Index i = 0; i < kBodyStates; ++i) {
    if (std::find(order.begin(), order.end(), i) == order.end()) order.push_back(i);
  }
  return order;
}

/// Gain and phase of one response.
struct Bode {
  Json gain_db = Json::array();
  std::vector<double> phase_deg;
};
Bode bode(const dynamics::identification::FrequencyResponse& response, Eigen::Index state, Eigen::Index input,
          double scale) {
  std::vector<std::complex<double>> values;
  for (const Eigen::MatrixXcd& matrix : response.responses) values.push_back(matrix(state, input) * scale);
  Bode out;
  for (const std::complex<double>& value : values) out.gain_db.push_back(20.0 * std::log10(std::abs(value)));
  out.phase_deg = unwrapped_deg(values);
  return out;
}

}  // namespace

std::pair<std::string, double> readable_unit(const std::string& unit) {
  if (unit == "rad") return {"deg", kDegPerRad};
  if (unit == "rad/s") return {"deg/s", kDegPerRad};
  return {unit, 1.0};
}

Json step_data(const ResponsePlot& plot, const dynamics::NamedLinearSystem& linear,
               const dynamics::identification::Record& record, const Eigen::MatrixXd& linear_states) {
  Json times = Json::array();
  for (Eigen::Index i = 0; i < record.states.rows(); ++i) times.push_back(static_cast<double>(i) * record.step_s);
  Json input = response_panel("Input", plot.input, plot.input_unit, "t_s", times);
  add_series(input, plot.input + ", from trim", "true", scaled(record.inputs.col(plot.axis), plot.input_scale));
  Json panels = Json::array({input});
  for (const Eigen::Index i : states_in_order(plot)) {
    const std::string& name = linear.states[static_cast<size_t>(i)];
    const auto [unit, scale] = readable_unit(linear.state_units[static_cast<size_t>(i)]);
    Json panel = response_panel("Response, from trim", state_words(name), unit, "t_s", times);
    add_series(panel, "full model", "true", scaled(record.states.col(i), scale));
    add_series(panel, "linear model", "est", scaled(linear_states.col(i), scale));
    panels.push_back(std::move(panel));
  }
  const Json axis = {{"key", "t_s"}, {"label", "time, s"}, {"symbol", "t"}, {"unit", "s"}, {"points", false}};
  return {{"title", plot.title}, {"notes", plot.notes}, {"axis", axis}, {"panels", panels}};
}

Json identification_data(const ResponsePlot& plot, const dynamics::identification::Identification& found) {
  const Json frequencies = found.measured.frequencies_radps;
  Json panels = Json::array();
  for (const Eigen::Index i : states_in_order(plot)) {
    const auto index = static_cast<size_t>(i);
    const auto [unit, scale] = readable_unit(found.linear.state_units[index]);
    const double factor = scale / plot.input_scale;
    const Bode measured = bode(found.measured, i, plot.axis, factor);
    Bode model = bode(found.model, i, plot.axis, factor);
    const size_t middle = model.phase_deg.size() / 2;
    const double turns = std::round((measured.phase_deg[middle] - model.phase_deg[middle]) / 360.0);
    for (double& phase : model.phase_deg) phase += 360.0 * turns;
    const std::string section = state_words(found.linear.states[index]) + " per " + plot.input;
    Json gain = response_panel(section, "Gain", "dB of " + unit + " per " + plot.input_unit, "w_radps", frequencies);
    add_series(gain, "identified", "true", measured.gain_db);
    add_series(gain, "linear model", "est", model.gain_db);
    Json phase = response_panel(section, "Phase", "deg", "w_radps", frequencies);
    add_series(phase, "identified", "true", measured.phase_deg);
    add_series(phase, "linear model", "est", model.phase_deg);
    Json coherence = response_panel(section, "Coherence", "", "w_radps", frequencies);
    coherence["lowest"] = 0.0;
    coherence["highest"] = 1.0;
    coherence["limits"] = {{{"label", "required"}, {"value", 0.6}}};
    add_series(coherence, "coherence", "true", scaled(found.measured.coherence.col(i), 1.0));
    for (Json* panel : {&gain, &phase, &coherence}) panels.push_back(std::move(*panel));
  }
  const Json axis = {{"key", "w_radps"},      {"label", "frequency, rad/s"},
                     {"symbol", "frequency"}, {"unit", "rad/s"},
                     {"points", true},        {"log", true}};
  return {{"title", plot.title}, {"notes", plot.notes}, {"axis", axis}, {"panels", panels}};
}

}  // namespace hedgehop::sim
