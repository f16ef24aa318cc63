#include "sim/pages/panels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/fields/quantities.h"
#include "sim/record/flight_columns.h"

namespace hedgehop::sim {
namespace {

using Values = std::vector<double>;
constexpr std::string_view kTruthNote = "true: known to the simulator only";
constexpr std::string_view kHeadingNote = "in the frame of the true heading; true: known to the simulator only";
/// Upper end of the clearance plot if a clearance lies below it. Larger clearances are no danger.
constexpr double kClearanceShownM = 20.0;

template <class Function>
Values each(const Values& a, const Values& b, Function function) {
  Values result(a.size());
  std::ranges::transform(a, b, result.begin(), function);
  return result;
}
Values difference(const Values& a, const Values& b) { return each(a, b, std::minus{}); }
Values norm(const Values& a, const Values& b) {
  return each(a, b, [](double x, double y) { return std::hypot(x, y); });
}
Values scaled(Values values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

/// Returns the components of a horizontal vector along and across a heading.
std::pair<Values, Values> along_across(const Values& north, const Values& east, const Values& yaw_rad) {
  Values along(north.size()), across(north.size());
  for (size_t i = 0; i < north.size(); ++i) {
    const double c = std::cos(yaw_rad[i]), s = std::sin(yaw_rad[i]);
    along[i] = c * north[i] + s * east[i];
    across[i] = -s * north[i] + c * east[i];
  }
  return {along, across};
}

/// Returns headings without jumps of 2 pi: each is the value closest to `reference`, or to the previous value.
Values unwrapped(Values yaw_rad, const Values* reference = nullptr) {
  double before = NAN;
  for (size_t i = 0; i < yaw_rad.size(); ++i) {
    const double near = reference != nullptr ? (*reference)[i] : before;
    if (std::isfinite(near)) yaw_rad[i] = near + std::remainder(yaw_rad[i] - near, 2.0 * std::numbers::pi);
    if (std::isfinite(yaw_rad[i])) before = yaw_rad[i];
  }
  return yaw_rad;
}

/// Reads columns of the trajectory and makes panels over time.
class TrajectoryPanels {
 public:
  explicit TrajectoryPanels(const Table& table) : table_(table), t_s_(column("t_s")) {}

  bool has(std::string_view name) const { return std::ranges::count(table_.names(), name) > 0; }
  Values column(std::string_view name) const { return table_.numbers(name); }
  Values degrees(std::string_view name) const { return scaled(column(name), kDegPerRad); }
  Values altitude(std::string_view down) const { return scaled(column(down), -1.0); }

  Panel& add(std::string_view section, std::string title, std::string unit, std::string_view note,
             std::vector<Series> series) {
    panels_.push_back({.section = std::string(section),
                       .title = std::move(title),
                       .unit = std::move(unit),
                       .note = std::string(note),
                       .t_s = t_s_,
                       .series = std::move(series)});
    return panels_.back();
  }
  std::vector<Panel> take() { return std::move(panels_); }

 private:
  const Table& table_;
  Values t_s_;
  std::vector<Panel> panels_;
};

void add_motion(TrajectoryPanels& p, const std::vector<Limit>& clearance_limits) {
  const Values yaw = p.column("yaw_rad");
  const auto [u, v] = along_across(p.column("v_north_mps"), p.column("v_east_mps"), yaw);
  const auto [u_cmd, v_cmd] = along_across(p.column("cmd_v_north_mps"), p.column("cmd_v_east_mps"), yaw);
  const auto [u_est, v_est] = along_across(p.column("est_v_north_mps"), p.column("est_v_east_mps"), yaw);
  p.add(kMotionSection, "Forward velocity", "m/s", kHeadingNote,
        {{"commanded", "cmd", u_cmd}, {"estimate", "est", u_est}, {"true", "true", u}});
  p.add(kMotionSection, "Sideways velocity, right positive", "m/s", kHeadingNote,
        {{"commanded", "cmd", v_cmd}, {"estimate", "est", v_est}, {"true", "true", v}});

  const Values clearance = p.column("clearance_m");
  Panel& panel = p.add(kMotionSection, "Clearance of the hull", "m", kTruthNote,
                       {{"obstacles", "a", clearance}, {"ground", "b", p.column("ground_clearance_m")}});
  panel.lowest = 0.0;
  panel.limits = clearance_limits;
  double lowest = kClearanceShownM, largest = 0.0;
  for (const Series& series : panel.series) {
    for (const double value : series.values) {
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      largest = std::max(largest, value);
    }
  }
  if (lowest < kClearanceShownM && largest > kClearanceShownM) {
    panel.highest = kClearanceShownM;
    panel.note += fmt::format("; not shown above {:.0f} m", kClearanceShownM);
  }

  p.add(kMotionSection, "Altitude", "m", kTruthNote,
        {{"commanded", "cmd", p.column("cmd_altitude_m")},
         {"estimate", "est", p.altitude("est_down_m")},
         {"true", "true", p.altitude("down_m")}});
}

void add_aircraft(TrajectoryPanels& p) {
  p.add(kAircraftSection, "Attitude", "deg", kTruthNote,
        {{"roll", "a", p.degrees("roll_rad")}, {"pitch", "b", p.degrees("pitch_rad")}});
  const Values yaw = unwrapped(p.column("yaw_rad"));
  p.add(kAircraftSection, "Heading, from north to east", "deg", kTruthNote,
        {{"commanded", "cmd", scaled(unwrapped(p.column("cmd_heading_rad"), &yaw), kDegPerRad)},
         {"estimate", "est", scaled(unwrapped(p.column("est_yaw_rad"), &yaw), kDegPerRad)},
         {"true", "true", scaled(yaw, kDegPerRad)}});
  if (p.has("collective_rad")) {
    p.add(kAircraftSection, "Control inputs at the blades", "deg", "",
          {{"collective", "a", p.degrees("collective_rad")},
           {"lateral", "b", p.degrees("lateral_rad")},
           {"longitudinal", "c", p.degrees("longitudinal_rad")},
           {"tail", "d", p.degrees("tail_rad")}});
  } else {
    p.add(kAircraftSection, "Thrust of the rotors", "N", "", {{"thrust", "a", p.column("thrust_n")}});
    p.add(kAircraftSection, "Torque of the rotors", "N m", "",
          {{"roll", "a", p.column("roll_torque_nm")},
           {"pitch", "b", p.column("pitch_torque_nm")},
           {"yaw", "c", p.column("yaw_torque_nm")}});
  }
  p.add(kAircraftSection, "Wind", "m/s", "towards north, east and down; known to the simulator only",
        {{"north", "a", p.column("wind_north_mps")},
         {"east", "b", p.column("wind_east_mps")},
         {"down", "c", p.column("wind_down_mps")}});
}

void add_navigation(TrajectoryPanels& p) {
  constexpr std::string_view kNote = "estimate minus truth; the truth is known to the simulator only";
  const Values yaw = p.column("yaw_rad");
  const auto [u, v] = along_across(difference(p.column("est_v_north_mps"), p.column("v_north_mps")),
                                   difference(p.column("est_v_east_mps"), p.column("v_east_mps")), yaw);
  const Values north = difference(p.column("est_north_m"), p.column("north_m"));
  const Values east = difference(p.column("est_east_m"), p.column("east_m"));
  p.add(kNavigationSection, "Velocity error", "m/s", kNote, {{"forward", "a", u}, {"right", "b", v}});
  p.add(kNavigationSection, "Position error", "m", kNote,
        {{"horizontal", "a", norm(north, east)},
         {"altitude", "b", difference(p.column("down_m"), p.column("est_down_m"))}});
}

struct Unit {
  std::string_view suffix, unit;
};
/// Longest first, so that `_mps2` is not read as `_s`.
constexpr std::array<Unit, 17> kUnits = {{{"_radps2", "rad/s²"},
                                          {"_radps", "rad/s"},
                                          {"_degps", "deg/s"},
                                          {"_per_s", "1/s"},
                                          {"_per_m", "1/m"},
                                          {"_mps2", "m/s²"},
                                          {"_pxps", "px/s"},
                                          {"_mps", "m/s"},
                                          {"_rad", "rad"},
                                          {"_deg", "deg"},
                                          {"_1ps", "1/s"},
                                          {"_hz", "Hz"},
                                          {"_ms", "ms"},
                                          {"_px", "px"},
                                          {"_ps", "1/s"},
                                          {"_m", "m"},
                                          {"_s", "s"}}};
constexpr std::array<std::string_view, 6> kCameras = {"left", "right", "front", "rear", "aft", "down"};

/// The parts of the name of a signal: "flow_left_radps" is the flow of "left" in rad/s.
struct SignalName {
  std::string group, label, role;
  std::string_view unit;
};

SignalName read_name(std::string_view name) {
  SignalName result;
  for (const Unit& unit : kUnits) {
    if (!name.ends_with(unit.suffix)) continue;
    result.unit = unit.unit;
    name.remove_suffix(unit.suffix.size());
    break;
  }
  const size_t end = name.find('_');
  result.group = name.substr(0, end);
  result.label = end == std::string_view::npos ? name : name.substr(end + 1);
  std::ranges::replace(result.label, '_', ' ');
  if (result.unit == "m/s" && result.label.starts_with("v ")) result.label.replace(0, 1, "velocity");
  for (const std::string_view camera : kCameras) {
    if (result.label.find(camera) != std::string::npos) result.role = camera == "aft" ? "rear" : camera;
  }
  return result;
}

std::string group_title(std::string_view group) {
  if (group == "flow") return "Mean optic flow of each camera";
  if (group == "loom") return "Loom of each camera, approaching positive";
  std::string title(group);
  if (title.front() >= 'a' && title.front() <= 'z') title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

/// Moves the common first words of all labels into the title: "valid: share left, share right" becomes "valid share:
/// left, right". A single signal moves its whole label.
void move_common_words(Panel& panel) {
  std::vector<Series>& series = panel.series;
  if (series.size() == 1) {
    panel.title += " " + series[0].label;
    return;
  }
  while (true) {
    const std::string word = series[0].label.substr(0, series[0].label.find(' ') + 1);
    const auto begins = [&word](const Series& s) { return s.label.size() > word.size() && s.label.starts_with(word); };
    if (word.empty() || !std::ranges::all_of(series, begins)) return;
    panel.title += " " + word.substr(0, word.size() - 1);
    for (Series& s : series) s.label.erase(0, word.size());
  }
}

}  // namespace

std::vector<Panel> trajectory_panels(const Table& trajectory, const std::vector<Limit>& clearance_limits) {
  TrajectoryPanels panels(trajectory);
  add_motion(panels, clearance_limits);
  add_aircraft(panels);
  add_navigation(panels);
  return panels.take();
}

std::vector<Panel> signal_panels(const Table& decisions) {
  std::vector<Panel> panels;
  std::vector<std::string> groups;
  for (size_t c = kCommonDecisionColumns; c < decisions.names().size(); ++c) {
    const std::string& column = decisions.names()[c];
    const SignalName name = read_name(column);
    const std::string key = name.group + " " + std::string(name.unit);
    const auto found = std::ranges::find(groups, key);
    const size_t index = static_cast<size_t>(found - groups.begin());
    if (found == groups.end()) {
      groups.push_back(key);
      panels.push_back({.section = std::string(kModuleSection),
                        .title = group_title(name.group),
                        .unit = std::string(name.unit),
                        .t_s = decisions.numbers("t_s")});
    }
    panels[index].series.push_back({name.label, name.role, decisions.numbers(column)});
  }
  for (size_t i = 0; i < panels.size(); ++i) {
    const bool one_word = panels[i].series.front().label + " " == groups[i].substr(0, groups[i].find(' ') + 1);
    if (!one_word) move_common_words(panels[i]);
  }
  return panels;
}

}  // namespace hedgehop::sim
