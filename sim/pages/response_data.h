#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "dynamics/identification/flight_identification.h"

namespace hedgehop::sim {

/// Response of a vehicle to one input.
struct ResponsePlot {
  std::string title;
  std::vector<std::string> notes;
  std::string input, input_unit;               ///< "longitudinal", "deg"
  double input_scale = 1.0;                    ///< from the unit of the linear model to input_unit
  Eigen::Index axis = 0;                       ///< of the input
  std::vector<Eigen::Index> main_states = {};  ///< shown first
};

/// Returns the data of a page with the input and all states over time; for trim_page().
/// @param linear_states  those of the linear model, samples x states.
nlohmann::ordered_json step_data(const ResponsePlot& plot, const dynamics::NamedLinearSystem& linear,
                                 const dynamics::identification::Record& record, const Eigen::MatrixXd& linear_states);

/// Returns the data of a page with gain, phase and coherence of the body's states over frequency; for trim_page().
nlohmann::ordered_json identification_data(const ResponsePlot& plot,
                                           const dynamics::identification::Identification& found);

/// Returns the unit that people read for a unit of a linear model, and the factor to it: ("deg/s", 57.3) for "rad/s".
std::pair<std::string, double> readable_unit(const std::string& unit);

}  // namespace hedgehop::sim
