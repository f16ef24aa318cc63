#include "sim/flightlog/log_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "sim/config/include.h"
#include "sim/config/reader.h"

namespace hedgehop::sim {

std::vector<std::string_view> log_quantities() {
  return {"t_s",
          "north_m",
          "east_m",
          "down_m",
          "roll_rad",
          "pitch_rad",
          "yaw_rad",
          "qw",
          "qx",
          "qy",
          "qz",
          "v_north_mps",
          "v_east_mps",
          "v_down_mps",
          "u_mps",
          "v_mps",
          "w_mps",
          "p_radps",
          "q_radps",
          "r_radps",
          "fx_mps2",
          "fy_mps2",
          "fz_mps2",
          "wind_north_mps",
          "wind_east_mps",
          "wind_down_mps",
          "motor_N_radps",
          "pwm_N",
          "voltage_v",
          "collective_rad",
          "lateral_rad",
          "longitudinal_rad",
          "tail_rad",
          "thrust_n",
          "roll_torque_nm",
          "pitch_torque_nm",
          "yaw_torque_nm",
          "cmd_v_north_mps",
          "cmd_v_east_mps",
          "cmd_altitude_m",
          "cmd_heading_rad"};
}

namespace {

/// Returns the name with the number of its motor replaced by N: "pwm_12" gives "pwm_N".
std::string without_number(const std::string& name) {
  const size_t begin = name.find_first_of("0123456789");
  const bool numbered = name.starts_with("pwm_") || name.starts_with("motor_");
  if (!numbered || begin == std::string::npos) return name;
  const size_t end = std::min(name.find_first_not_of("0123456789", begin), name.size());
  return name.substr(0, begin) + "N" + name.substr(end);
}

}  // namespace

LogColumnsConfig read_log_columns(const std::filesystem::path& file) {
  ErrorList errors("column map");
  const Node root = load_tree(file, errors);
  LogColumnsConfig config;
  if (root.kind == Node::Kind::map) read_struct(root, "", "", config, errors);
  const std::vector<std::string_view> known = log_quantities();
  std::set<std::string> seen;
  for (size_t i = 0; i < config.columns.size(); ++i) {
    const std::string& name = config.columns[i].name;
    const SourcePosition at = position_of(root, fmt::format("columns.{}.name", i));
    if (std::ranges::find(known, without_number(name)) == known.end()) {
      errors.add(at, fmt::format("unknown quantity '{}'{}", name, suggestion(name, known)));
    } else if (!seen.insert(name).second) {
      errors.add(at, fmt::format("quantity '{}' occurs twice", name));
    }
  }
  errors.throw_if_any();
  return config;
}

}  // namespace hedgehop::sim
