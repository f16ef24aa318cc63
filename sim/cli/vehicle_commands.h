#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/cli/log_commands.h"

namespace CLI {
class App;
}

/// The commands about vehicles, as those of commands.h.
namespace hedgehop::sim::cli {

/// Returns a list of the vehicle files with mass, width and description.
std::string vehicle_files_text();

struct TrimOptions {
  std::filesystem::path vehicle;
  std::vector<double> speeds_mps{0.0};
  bool json = false, csv = false;
  std::filesystem::path plot;  ///< page of plots to write as well; empty: no file
};
/// Prints the trim of level flight at each speed, and plots it.
int trim(const TrimOptions& options);

struct LinearizeOptions {
  std::filesystem::path vehicle;
  double speed_mps = 0.0;
  bool json = false, csv = false;
};
/// Prints A, B and the modes of level flight.
int linearize(const LinearizeOptions& options);

struct StepOptions {
  std::filesystem::path vehicle;
  std::string input;           ///< such as "longitudinal"
  std::string size;            ///< with its unit, such as "1deg"
  std::string shape = "step";  ///< or "doublet"
  double width_s = 0.5;        ///< of each half of a doublet
  double speed_mps = 0.0, duration_s = 2.0;
  bool json = false, csv = false;
  std::filesystem::path plot;  ///< page of plots to write as well; empty: no file
};
/// Prints the response to a step or doublet of one control from the trim, next to that of the linear model.
int step(const StepOptions& options);

struct IdentifyOptions {
  std::filesystem::path vehicle;
  std::string input;   ///< such as "longitudinal"
  std::string output;  ///< a state; empty: the main one of the input
  std::string size;    ///< with its unit; empty: a small default
  double from_radps = 0.3, to_radps = 30.0, duration_s = 105.0;
  double speed_mps = 0.0;
  bool json = false, csv = false;
  std::filesystem::path plot;  ///< page of plots to write as well; empty: no file
};
/// Flies frequency sweeps and prints the identified frequency response next to that of the linear model.
int identify(const IdentifyOptions& options);

/// The options of the commands about vehicles, which outlive the command line.
struct VehicleOptions {
  TrimOptions trim;
  std::string speeds = "0";
  LinearizeOptions linearize;
  StepOptions step;
  IdentifyOptions identify;
  IdentifyLogOptions identify_log;
  CompareLogOptions compare_log;
};
/// Declares these commands. Parsing stores the call of the selected command in `chosen`.
void declare_vehicle_commands(CLI::App& app, std::function<int()>& chosen, VehicleOptions& vehicles);

/// Speeds of "V" or "FROM:TO:STEP", m/s, both ends included. Throws InputError on anything else.
std::vector<double> speed_range(const std::string& text);

}  // namespace hedgehop::sim::cli
