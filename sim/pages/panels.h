#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/column_table.h"

namespace hedgehop::sim {

/// One line of a time plot.
struct Series {
  std::string label;
  std::string role;  ///< decides its look: "true", "est", "cmd", a camera's name, or "" for the next free color
  std::vector<double> values;
};

/// A level a quantity should keep to.
struct Limit {
  std::string label;
  double value = 0.0;
};

/// One time plot: series over a common time axis.
struct Panel {
  std::string section, title, unit;
  std::string note;  ///< one line below the title, may be empty
  std::vector<double> t_s;
  std::vector<Series> series;
  std::optional<double> lowest, highest;  ///< fixed ends of the axis, in the unit; else they follow the data
  std::vector<Limit> limits;
};

/// Sections of a report, in order.
inline constexpr std::string_view kMotionSection = "Command and motion";
inline constexpr std::string_view kModuleSection = "What the module saw";
inline constexpr std::string_view kAircraftSection = "Aircraft";
inline constexpr std::string_view kNavigationSection = "Navigation error";
inline constexpr std::array kSections = {kMotionSection, kModuleSection, kAircraftSection, kNavigationSection};

/// Time plots of trajectory.csv, as in [Garratt2009] fig. 6 and beyond. Velocities are along and across the true
/// heading. @param clearance_limits  drawn into the clearance plot.
std::vector<Panel> trajectory_panels(const ColumnTable& trajectory, const std::vector<Limit>& clearance_limits);

/// Time plots of the module's signals in decisions.csv, as in [Garratt2009] fig. 7: one for all signals whose names
/// share the first word and the unit ("flow_left_radps", "flow_right_radps"). The unit is read from the name's end.
std::vector<Panel> signal_panels(const ColumnTable& decisions);

}  // namespace hedgehop::sim
