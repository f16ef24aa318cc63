#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "dynamics/modes.h"
#include "dynamics/steady_flight.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/cli/vehicle_files.h"
#include "sim/config/utf8.h"
#include "sim/fields/quantities.h"
#include "sim/flight/words.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;
using dynamics::Mode;
using dynamics::NamedLinearSystem;
using Texts = std::vector<std::string>;

Json matrix_json(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Returns the unit of a state's rate: "m/s2", "rad/s", "N m/s".
std::string rate_unit(const std::string& unit) { return unit.ends_with("/s") ? unit + "2" : unit + "/s"; }

/// Returns the units of a matrix, row by row: that of the row's rate per that of the column.
Json units_json(const Texts& rows, const Texts& columns) {
  Json units = Json::array();
  for (const std::string& row : rows) {
    Json line = Json::array();
    for (const std::string& column : columns) line.push_back(fmt::format("({})/({})", rate_unit(row), column));
    units.push_back(std::move(line));
  }
  return units;
}

/// Prints a matrix with the names and units of its rows and columns: a table for people, or comma-separated values.
void print_matrix(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                  const NamedLinearSystem& linear, const Texts& columns, const Texts& units, bool csv) {
  Texts rows;
  for (size_t i = 0; i < linear.states.size(); ++i) {
    rows.push_back(csv ? linear.states[i]
                       : fmt::format("d{}/dt [{}]", linear.states[i], rate_unit(linear.state_units[i])));
  }
  if (csv) {
    fmt::print("{},{}\n", name, fmt::join(columns, ","));
  } else {
    fmt::print("{:>20}", name);
    for (const std::string& column : columns) fmt::print("{:>11}", column);
    fmt::print("\n{:>20}", "");
    for (const std::string& unit : units) fmt::print("{:>11}", fmt::format("[{}]", unit));
    fmt::print("\n");
  }
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const std::string& row = rows[static_cast<size_t>(i)];
    fmt::print("{}", csv ? row : fmt::format("{:>20}", row));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      fmt::print("{}", csv ? fmt::format(",{}", matrix(i, j)) : fmt::format("{:>11}", decimals(matrix(i, j), 4)));
    }
    fmt::print("\n");
  }
}

/// Returns "halves in 0.17 s", "doubles in 1386 s" or "neutral".
std::string growth_words(double rate_radps) {
  constexpr double kNeutralRadps = 1e-9;
  if (std::abs(rate_radps) < kNeutralRadps) return "neutral";
  return fmt::format("{} in {:.4g} s", rate_radps < 0.0 ? "halves" : "doubles",
                     std::numbers::ln2 / std::abs(rate_radps));
}

void print_modes(const std::vector<Mode>& modes, bool csv) {
  if (csv) {
    fmt::print("name,eigenvalue_re_radps,eigenvalue_im_radps,frequency_radps,damping\n");
  } else {
    fmt::print("{:<40}{:>24}{:>20}{:>10}{:>22}\n", "mode", "eigenvalue [1/s]", "frequency [rad/s]", "damping", "");
  }
  for (const Mode& mode : modes) {
    const double re = mode.eigenvalue.real(), im = mode.eigenvalue.imag();
    if (csv) {
      fmt::print("\"{}\",{},{},{},{}\n", mode.name, re, im, mode.frequency_radps, mode.damping);
      continue;
    }
    const std::string value = im > 0.0 ? fmt::format("{:.4f} +- {:.4f}i", re, im) : decimals(re, 4);
    fmt::print("{:<40}{:>24}{:>20.4f}{:>10.3f}{:>22}\n", mode.name, value, mode.frequency_radps, mode.damping,
               growth_words(re));
  }
}

/// Prints magnitude and phase of each eigenvector: one row per mode, or one line per number.
void print_eigenvectors(const std::vector<Mode>& modes, const NamedLinearSystem& linear, bool csv) {
  if (csv) {
    fmt::print("mode,state,unit,magnitude,phase_deg\n");
  } else {
    fmt::print("{:<40}", "eigenvector, magnitude / phase [deg]");
    for (size_t i = 0; i < linear.states.size(); ++i) {
      fmt::print("{:>16}", fmt::format("{} [{}]", linear.states[i], linear.state_units[i]));
    }
    fmt::print("\n");
  }
  for (const Mode& mode : modes) {
    if (!csv) fmt::print("{:<40}", mode.name);
    for (size_t i = 0; i < linear.states.size(); ++i) {
      const std::complex<double> part = mode.eigenvector[static_cast<Eigen::Index>(i)];
      const double magnitude = std::abs(part), phase = std::arg(part) * kDegPerRad;
      if (csv) {
        fmt::print("\"{}\",{},{},{},{}\n", mode.name, linear.states[i], linear.state_units[i], magnitude, phase);
      } else {
        constexpr double kNothing = 5e-5;
        fmt::print("{:>16}", magnitude < kNothing ? "0" : fmt::format("{:.2g} / {}", magnitude, decimals(phase, 0)));
      }
    }
    if (!csv) fmt::print("\n");
  }
}

Json modes_json(const std::vector<Mode>& modes) {
  Json rows = Json::array();
  for (const Mode& mode : modes) {
    Json vector = Json::array();
    for (Eigen::Index i = 0; i < mode.eigenvector.size(); ++i) {
      vector.push_back({mode.eigenvector[i].real(), mode.eigenvector[i].imag()});
    }
    rows.push_back({{"name", mode.name},
                    {"eigenvalue_radps", {mode.eigenvalue.real(), mode.eigenvalue.imag()}},
                    {"frequency_radps", mode.frequency_radps},
                    {"damping", mode.damping},
                    {"eigenvector", std::move(vector)}});
  }
  return rows;
}

}  // namespace

int linearize(const LinearizeOptions& options) {
  Texts beyond;
  const auto linear = about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) {
    const Eigen::Vector3d v_air_W{options.speed_mps, 0.0, 0.0};
    if (const auto flight = dynamics::steady_flight(vehicle, v_air_W)) beyond = flight->beyond();
    return dynamics::linear_system(vehicle, v_air_W);
  });
  if (!linear)
    throw InputError(fmt::format("{}: no steady flight at {} m/s", options.vehicle.string(), options.speed_mps));
  if (!beyond.empty()) {
    warn(fmt::format("beyond the limits, not flyable, at {} m/s: {}", options.speed_mps, fmt::join(beyond, "; ")));
  }
  const std::vector<Mode> modes = dynamics::modes(*linear, options.speed_mps);
  const dynamics::control::LinearSystem& system = linear->system;
  if (options.json) {
    Json json{
        {"speed_mps", options.speed_mps},    {"within_limits", beyond.empty()}, {"beyond", beyond},
        {"states", linear->states},          {"inputs", linear->inputs},        {"state_units", linear->state_units},
        {"input_units", linear->input_units}};
    json["A"] = matrix_json(system.A);
    json["B"] = matrix_json(system.B);
    json["A_units"] = units_json(linear->state_units, linear->state_units);
    json["B_units"] = units_json(linear->state_units, linear->input_units);
    json["modes"] = modes_json(modes);
    fmt::print("{}\n", json_text(json, 2));
    return 0;
  }
  if (!options.csv) fmt::print("Each number has the unit of its row per the unit of its column.\n\n");
  print_matrix("A", system.A, *linear, linear->states, linear->state_units, options.csv);
  fmt::print("\n");
  print_matrix("B", system.B, *linear, linear->inputs, linear->input_units, options.csv);
  fmt::print("\n");
  print_modes(modes, options.csv);
  fmt::print("\n");
  print_eigenvectors(modes, *linear, options.csv);
  return 0;
}

}  // namespace hedgehop::sim::cli
