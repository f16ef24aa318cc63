#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The commands about recorded flights, as those of commands.h.
namespace hedgehop::sim::cli {

struct CompareLogOptions {
  std::filesystem::path vehicle;
  std::vector<std::filesystem::path> logs;
  std::filesystem::path columns;  ///< map of the columns; empty: Hedgehop's own names
  std::string part = "all";
  double split = 0.5, every_s = 0.1;
  std::vector<double> horizons_s{0.1, 0.5, 1.0, 2.0};
  bool json = false, csv = false;
  std::filesystem::path plot;  ///< figure to write as well; empty: no file
};
/// Prints the errors of a vehicle's model against recorded flights, next to those of simple predictions.
int compare_log(const CompareLogOptions& options);

struct IdentifyLogOptions {
  std::filesystem::path vehicle;
  std::vector<std::filesystem::path> logs;
  std::filesystem::path columns;
  std::vector<std::string> fit;  ///< NAME=LOW:HIGH
  double horizon_s = 0.5, every_s = 0.5, split = 0.5;
  bool json = false;
  std::filesystem::path out, out_columns;  ///< files of the fitted vehicle and columns; empty: none
};
/// Fits parameters of a vehicle to the first part of recorded flights, and prints which of them the data determines.
int identify_log(const IdentifyLogOptions& options);

/// Declares `compare-log`. Parsing stores the call of the command in `chosen`.
void declare_compare_log(CLI::App& app, std::function<int()>& chosen, CompareLogOptions& options);

/// Adds the options of a fit to `identify`.
void add_log_fit(CLI::App& command, IdentifyLogOptions& options);

}  // namespace hedgehop::sim::cli
