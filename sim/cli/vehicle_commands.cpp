#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/steady_flight.h"
#include "dynamics/vehicle.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/pages/report_page.h"
#include "sim/pages/trim_data.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the first sentence of the comment at the head of a file.
std::string first_sentence(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string text, line;
  while (std::getline(in, line) && line.starts_with("#")) text += line.substr(1);
  for (size_t at = text.find(". "); at != std::string::npos; at = text.find(". ", at + 1)) {
    if (at + 2 < text.size() && std::isupper(static_cast<unsigned char>(text[at + 2]))) {
      text.resize(at + 1);
      break;
    }
  }
  return text.starts_with(" ") ? text.substr(1) : text;
}

/// Runs `compute` on a vehicle; a vehicle that cannot fly is bad input, reported with the file's name.
template <class Compute>
auto about(const std::filesystem::path& file, Compute compute) {
  const dynamics::VehicleConfig vehicle = load_vehicle(file);
  try {
    dynamics::Vehicle{vehicle};  // throws with the reason if the vehicle cannot fly
    return compute(vehicle);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", file.string(), error.what()));
  }
}

Json to_json(const TrimPoint& row) {
  Json json{{"V_mps", row.speed_mps}};
  for (const dynamics::Quantity& q : row.flight.quantities) {
    json[q.name] = q.value;
  }
  return json;
}

void print_rows(const std::vector<TrimPoint>& rows, bool csv) {
  std::vector<std::string> heads{csv ? "V_mps" : "V [m/s]"};
  for (const dynamics::Quantity& q : rows.front().flight.quantities) {
    heads.push_back(csv ? q.name : fmt::format("{} [{}]", q.name, q.unit));
  }
  if (csv) {
    fmt::print("{}\n", fmt::join(heads, ","));
    for (const TrimPoint& row : rows) {
      fmt::print("{}", row.speed_mps);
      for (const dynamics::Quantity& q : row.flight.quantities) fmt::print(",{}", q.value);
      fmt::print("\n");
    }
    return;
  }
  for (const std::string& head : heads) fmt::print("{:>18}", head);
  fmt::print("\n");
  for (const TrimPoint& row : rows) {
    fmt::print("{:>18.2f}", row.speed_mps);
    for (const dynamics::Quantity& q : row.flight.quantities) fmt::print("{:>18.3f}", q.value);
    fmt::print("\n");
  }
}

Json to_json(const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// A matrix with its rows' and columns' names: a table for people, or comma-separated values.
void print_matrix(const std::string& name, const Eigen::Ref<const Eigen::MatrixXd>& matrix,
                  const std::vector<std::string>& rows, const std::vector<std::string>& columns, bool csv) {
  if (csv) {
    fmt::print("{},{}\n", name, fmt::join(columns, ","));
  } else {
    fmt::print("{:>8}", name);
    for (const std::string& column : columns) fmt::print("{:>11}", column);
    fmt::print("\n");
  }
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const std::string& row = rows[static_cast<size_t>(i)];
    fmt::print("{}", csv ? row : fmt::format("{:>8}", row));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      if (csv) {
        fmt::print(",{}", matrix(i, j));
      } else {
        fmt::print("{:>11.4f}", matrix(i, j));
      }
    }
    fmt::print("\n");
  }
}

void print_modes(const std::vector<dynamics::Mode>& modes, bool csv) {
  if (csv) {
    fmt::print("eigenvalue_re_radps,eigenvalue_im_radps,frequency_radps,damping\n");
  } else {
    fmt::print("{:>24}{:>20}{:>10}{:>24}\n", "mode [rad/s]", "frequency [rad/s]", "damping", "");
  }
  for (const dynamics::Mode& mode : modes) {
    const double re = mode.eigenvalue.real(), im = mode.eigenvalue.imag();
    if (csv) {
      fmt::print("{},{},{},{}\n", re, im, mode.frequency_radps, mode.damping);
      continue;
    }
    const std::string value = im > 0.0 ? fmt::format("{:.4f} +- {:.4f}i", re, im) : fmt::format("{:.4f}", re);
    constexpr double kStaysRadps = 1e-9;
    const std::string time = std::abs(re) < kStaysRadps ? "stays"
                                                        : fmt::format("{} in {:.2f} s", re < 0.0 ? "halves" : "doubles",
                                                                      std::numbers::ln2 / std::abs(re));
    fmt::print("{:>24}{:>20.4f}{:>10.3f}{:>24}\n", value, mode.frequency_radps, mode.damping, time);
  }
}

}  // namespace

std::string vehicle_files_text() {
  std::string text = "\nvehicle files, for `vehicle: {use: ...}`:\n";
  for (const std::filesystem::path& file : shipped_files("vehicles")) {
    const dynamics::VehicleConfig vehicle = load_vehicle(file);
    const double mass_kg = std::visit([](const auto& config) { return config.mass.mass_kg; }, vehicle);
    const std::string_view kind = std::visit([](const auto& config) { return config.kName; }, vehicle);
    text += fmt::format("{}: {}, {:.3g} kg, {:.2f} m across\n    {}\n", file.string(), kind, mass_kg,
                        2.0 * dynamics::radius_m(dynamics::hull(vehicle)), first_sentence(file));
  }
  return text;
}

int trim(const TrimOptions& options) {
  std::vector<double> missing_mps;
  const std::vector<TrimPoint> rows = about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) {
    std::vector<TrimPoint> found;
    for (const double speed_mps : options.speeds_mps) {
      const auto flight = dynamics::steady_flight(vehicle, {speed_mps, 0.0, 0.0});
      if (flight) {
        found.push_back({speed_mps, *flight});
      } else {
        missing_mps.push_back(speed_mps);
      }
    }
    return found;
  });
  for (const double speed_mps : missing_mps) notice(fmt::format("no steady flight at {} m/s\n", speed_mps));
  if (rows.empty()) throw InputError(options.vehicle.string() + ": no steady flight at any of the speeds");
  if (options.json) {
    Json json = Json::array();
    for (const TrimPoint& row : rows) json.push_back(to_json(row));
    fmt::print("{}\n", json.dump(2));
  } else {
    print_rows(rows, options.csv);
  }
  if (!options.plot.empty()) {
    const Json data = trim_data(options.vehicle.stem().string(), rows, missing_mps);
    write_file_whole(options.plot, trim_page(data["title"].get<std::string>(), data.dump()));
    notice(fmt::format("{}\n", options.plot.string()));
  }
  return 0;
}

int linearize(const LinearizeOptions& options) {
  const auto linear = about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) {
    return dynamics::linear_system(vehicle, {options.speed_mps, 0.0, 0.0});
  });
  if (!linear)
    throw InputError(fmt::format("{}: no steady flight at {} m/s", options.vehicle.string(), options.speed_mps));
  const std::vector<dynamics::Mode> modes = dynamics::modes(linear->system.A);
  if (options.json) {
    Json json{{"speed_mps", options.speed_mps}, {"states", linear->states}, {"inputs", linear->inputs}};
    json["A"] = to_json(linear->system.A);
    json["B"] = to_json(linear->system.B);
    json["modes"] = Json::array();
    for (const dynamics::Mode& mode : modes) {
      json["modes"].push_back({{"eigenvalue_radps", {mode.eigenvalue.real(), mode.eigenvalue.imag()}},
                               {"frequency_radps", mode.frequency_radps},
                               {"damping", mode.damping}});
    }
    fmt::print("{}\n", json.dump(2));
    return 0;
  }
  print_matrix("A", linear->system.A, linear->states, linear->states, options.csv);
  fmt::print("\n");
  print_matrix("B", linear->system.B, linear->states, linear->inputs, options.csv);
  fmt::print("\n");
  print_modes(modes, options.csv);
  return 0;
}

std::vector<double> speed_range(const std::string& text) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    size_t used = 0;
    try {
      numbers.push_back(std::stod(part, &used));
    } catch (const std::exception&) {
      used = 0;
    }
    if (used == 0 || used != part.size() || !std::isfinite(numbers.back())) {
      throw InputError(fmt::format("--speed {}: expected a speed in m/s or FROM:TO:STEP, such as -4:20:2", text));
    }
    begin = end + 1;
  }
  if (numbers.size() == 1) return numbers;
  constexpr double kMaxSpeeds = 10000;
  if (numbers.size() != 3 || numbers[2] <= 0.0 || numbers[1] < numbers[0] ||
      (numbers[1] - numbers[0]) / numbers[2] > kMaxSpeeds) {
    throw InputError(fmt::format("--speed {}: expected FROM:TO:STEP with TO above FROM and STEP above 0", text));
  }
  std::vector<double> speeds;
  constexpr double kRounding = 1e-9;
  const auto count = static_cast<int>(std::floor((numbers[1] - numbers[0]) / numbers[2] + kRounding));
  for (int i = 0; i <= count; ++i) speeds.push_back(numbers[0] + i * numbers[2]);
  return speeds;
}

}  // namespace hedgehop::sim::cli
