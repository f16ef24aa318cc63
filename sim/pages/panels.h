#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/table.h"

namespace hedgehop::sim {

/// One line of a time plot.
struct Series {
  std::string label;
  std::string
      role;  ///< selects its color and width: "true", "est", "cmd", a camera's name, or "" for the next free color
  std::vector<double> values;
};

/// A limit that is drawn as a line.
struct Limit {
  std::string label;
  double value = 0.0;
};

/// One time plot: series over a common time axis.
struct Panel {
  std::string section, title, unit;
  std::string note;  ///< one line below the title, or empty
  std::vector<double> t_s;
  std::vector<Series> series;
  std::optional<double> lowest, highest;  ///< fixed ends of the axis, in the unit; else the range of the data
  std::vector<Limit> limits;
};

/// The sections of a report, in order.
inline constexpr std::string_view kMotionSection = "Command and motion";
inline constexpr std::string_view kModuleSection = "Module signals";
inline constexpr std::string_view kAircraftSection = "Aircraft";
inline constexpr std::string_view kNavigationSection = "Navigation error";
inline constexpr std::array kSections = {kMotionSection, kModuleSection, kAircraftSection, kNavigationSection};

/// Returns the time plots of trajectory.csv, including those of [Garratt2009] fig. 6. Velocities are along and across
/// the true heading. @param clearance_limits  for the clearance plot.
std::vector<Panel> trajectory_panels(const Table& trajectory, const std::vector<Limit>& clearance_limits);

/// Returns the time plots of the module's signals in decisions.csv, as in [Garratt2009] fig. 7: one plot for all
/// signals with equal first word and unit ("flow_left_radps", "flow_right_radps"). The unit is the end of the name.
std::vector<Panel> signal_panels(const Table& decisions);

}  // namespace hedgehop::sim
