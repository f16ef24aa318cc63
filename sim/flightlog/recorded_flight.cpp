#include "sim/flightlog/recorded_flight.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>
#include <variant>

#include "sim/config/input_error.h"
#include "sim/fields/order_statistics.h"
#include "sim/fields/quantities.h"
#include "sim/record/table.h"

namespace hedgehop::sim {
namespace {

using Inputs = LogColumnsConfig::Inputs;
using Names = std::vector<std::string>;

/// The columns of a file as quantities.
class Quantities {
 public:
  Quantities(const std::filesystem::path& file, const LogColumnsConfig& config)
      : file_(file.string()), config_(config), table_(file) {}

  size_t rows() const { return table_.rows(); }
  const std::string& file() const { return file_; }
  bool has(const Names& names) const {
    return std::ranges::all_of(names, [&](const std::string& name) { return table_.has(column(name).from); });
  }
  std::vector<double> values(const std::string& name) const {
    const LogColumnConfig map = column(name);
    if (!table_.has(map.from)) {
      throw InputError(map.from == name
                           ? fmt::format("{}: no column '{}'{}", file_, name, columns_advice())
                           : fmt::format("{}: no column '{}' for '{}'{}", file_, map.from, name, columns_advice()));
    }
    std::vector<double> out = table_.numbers(map.from);
    for (double& value : out) value = map.scale * value + map.offset;
    const auto finite = [](double value) { return std::isfinite(value); };
    const auto fault = std::ranges::find_if_not(out, finite);
    if (fault == out.end()) return out;
    const auto first = std::ranges::find_if(out, finite);
    const bool starts_late = fault == out.begin() && first != out.end();
    throw InputError(
        fmt::format("{}: column '{}' has no finite number in row {}{}", file_, map.from, fault - out.begin() + 1,
                    starts_late ? late_start_advice(static_cast<size_t>(first - out.begin())) : std::string()));
  }
  /// Returns three columns as vectors.
  std::vector<Eigen::Vector3d> vectors(const Names& names) const {
    const std::vector<double> x = values(names[0]), y = values(names[1]), z = values(names[2]);
    std::vector<Eigen::Vector3d> out;
    for (size_t i = 0; i < x.size(); ++i) out.emplace_back(x[i], y[i], z[i]);
    return out;
  }

 private:
  /// Returns the columns of the file and the option that maps them.
  std::string columns_advice() const {
    constexpr size_t kMaxNames = 20;
    const std::vector<std::string>& names = table_.names();
    const auto end = names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMaxNames));
    return fmt::format("; the file has {}{}; --columns MAP.yaml gives their names", fmt::join(names.begin(), end, ", "),
                       names.size() > kMaxNames ? ", ..." : "");
  }
  /// @param row  first with a number, from 0.
  std::string late_start_advice(size_t row) const {
    const std::string t = column("t_s").from;
    if (!table_.has(t)) return "";
    const std::vector<double> times = table_.numbers(t);
    if (!std::isfinite(times.front())) return "";
    return fmt::format("; row {} has the first: scripts/convert-log {} --time {} --from {} -o CUT.csv", row + 1, file_,
                       t, times[row] - times.front());  // --from counts from the first row
  }
  LogColumnConfig column(const std::string& name) const {
    LogColumnConfig map{.name = name, .from = name};
    for (const LogColumnConfig& c : config_.columns) {
      if (c.name != name) continue;
      map = c;
      if (map.from.empty()) map.from = name;
    }
    return map;
  }

  std::string file_;
  const LogColumnsConfig& config_;
  Table table_;
};

const Names kPosition = {"north_m", "east_m", "down_m"}, kAngles = {"roll_rad", "pitch_rad", "yaw_rad"},
            kQuaternion = {"qw", "qx", "qy", "qz"}, kVelocityW = {"v_north_mps", "v_east_mps", "v_down_mps"},
            kVelocityB = {"u_mps", "v_mps", "w_mps"}, kRates = {"p_radps", "q_radps", "r_radps"},
            kForce = {"fx_mps2", "fy_mps2", "fz_mps2"}, kWind = {"wind_north_mps", "wind_east_mps", "wind_down_mps"};

size_t rotors(const dynamics::VehicleConfig& vehicle) {
  const auto* const multicopter = std::get_if<dynamics::multicopter::MulticopterConfig>(&vehicle);
  return multicopter ? multicopter->arms.size() : 0;
}

/// Returns the columns of each kind of input that a vehicle has.
std::vector<std::pair<Inputs, Names>> input_columns(const dynamics::VehicleConfig& vehicle) {
  std::vector<std::pair<Inputs, Names>> kinds;
  Names speeds, duties;
  for (size_t i = 0; i < rotors(vehicle); ++i) {
    speeds.push_back(fmt::format("motor_{}_radps", i));
    duties.push_back(fmt::format("pwm_{}", i));
  }
  if (!speeds.empty()) kinds = {{Inputs::motor_speeds, speeds}, {Inputs::pwm, duties}};
  const auto& controls = speeds.empty() ? dynamics::helicopter::HelicopterFlight::kControlNames
                                        : dynamics::multicopter::MulticopterFlight::kControlNames;
  kinds.emplace_back(Inputs::controls, Names(controls.begin(), controls.end()));
  kinds.emplace_back(Inputs::setpoints,
                     Names{"cmd_v_north_mps", "cmd_v_east_mps", "cmd_altitude_m", "cmd_heading_rad"});
  return kinds;
}

/// Rotor speeds from duty cycles.
void apply_duty(Eigen::MatrixXd& inputs, const DutySpeedConfig& pwm, const Quantities& log) {
  if (!pwm.trims.empty() && pwm.trims.size() != static_cast<size_t>(inputs.cols())) {
    throw InputError(
        fmt::format("pwm.trims: needs {} numbers, one per motor; got {}", inputs.cols(), pwm.trims.size()));
  }
  const bool by_voltage = pwm.voltage_exponent > 0.0;
  const std::vector<double> volts = by_voltage ? log.values("voltage_v") : std::vector<double>{};
  for (Eigen::Index k = 0; k < inputs.cols(); ++k) {
    const double trim = pwm.trims.empty() ? 1.0 : pwm.trims[static_cast<size_t>(k)];
    for (Eigen::Index i = 0; i < inputs.rows(); ++i) {
      const double ratio =
          by_voltage ? std::pow(volts[static_cast<size_t>(i)] / pwm.voltage_v, pwm.voltage_exponent) : 1.0;
      inputs(i, k) = std::max(0.0, (pwm.at_zero_radps + pwm.per_duty_radps * trim * inputs(i, k)) * ratio);
    }
  }
}

/// Reverses the inputs along and about the axes y and z, of a log with axes flu. Altitude and thrust are upwards in
/// both.
void reverse_inputs(Eigen::MatrixXd& inputs, const Names& names) {
  constexpr std::array<std::string_view, 4> kReversed = {"cmd_v_east_mps", "cmd_heading_rad", "pitch_torque_nm",
                                                         "yaw_torque_nm"};
  for (size_t k = 0; k < names.size(); ++k) {
    if (std::ranges::find(kReversed, names[k]) != kReversed.end()) inputs.col(static_cast<Eigen::Index>(k)) *= -1.0;
  }
}

/// Refuses an angle that only a column in degrees can have. @param valid  text of the limit.
void require_radians(const Quantities& log, std::string_view name, double angle_rad, size_t row, double limit_rad,
                     std::string_view valid) {
  if (std::abs(angle_rad) <= limit_rad) return;
  throw InputError(
      fmt::format("{}: {} is {:.4g} rad in row {}; valid: -{} to {}; if the column is in degrees, map it with scale: "
                  "0.0174533 (--columns)",
                  log.file(), name, angle_rad, row + 1, valid, valid));
}

/// Refuses rates in degrees per second, which are 57 times those of the attitude.
void require_rates_in_radians(const RecordedFlight& flight) {
  constexpr double kCorrelation = 0.5, kFactor = 2.0;  // noise alone gives large rates too, without correlation
  double products = 0.0, rates2 = 0.0, turns2 = 0.0;
  for (size_t i = 0; i + 1 < flight.size(); ++i) {
    if (flight.gap_after[i]) continue;
    const Eigen::AngleAxisd turn(flight.states[i].q_WB.conjugate() * flight.states[i + 1].q_WB);
    const Eigen::Vector3d turn_radps = turn.angle() * turn.axis() / (flight.t_s[i + 1] - flight.t_s[i]);
    const Eigen::Vector3d& rate = flight.states[i].w_WB_B;
    products += rate.dot(turn_radps);
    rates2 += rate.squaredNorm();
    turns2 += turn_radps.squaredNorm();
  }
  const double factor = rates2 / (products * kDegPerRad);
  if (products < kCorrelation * std::sqrt(rates2 * turns2) || !(factor > 1.0 / kFactor && factor < kFactor)) return;
  throw InputError(
      fmt::format("{}: {} are about 57 times the rates of the attitude; if the columns are in deg/s, map them with "
                  "scale: 0.0174533 (--columns)",
                  flight.file, fmt::join(kRates, ", ")));
}

void read_inputs(RecordedFlight& flight, const Quantities& log, const LogColumnsConfig& config,
                 const dynamics::VehicleConfig& vehicle) {
  const auto kinds = input_columns(vehicle);
  const bool positions = config.inputs == Inputs::control_positions;
  const std::optional<Inputs> columns_of = positions ? Inputs::controls : config.inputs;
  std::vector<std::string> wanted;
  for (const auto& [kind, names] : kinds) {
    if (columns_of ? kind != *columns_of : !log.has(names)) {
      wanted.push_back(fmt::format("{}", fmt::join(names, ", ")));
      continue;
    }
    flight.kind = positions ? Inputs::control_positions : kind;
    flight.inputs.resize(static_cast<Eigen::Index>(log.rows()), static_cast<Eigen::Index>(names.size()));
    for (size_t k = 0; k < names.size(); ++k) {
      const std::vector<double> values = log.values(names[k]);
      flight.inputs.col(static_cast<Eigen::Index>(k)) =
          Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
      if (kind != Inputs::controls || rotors(vehicle) > 0) continue;
      for (size_t i = 0; i < values.size(); ++i) {
        require_radians(log, names[k], values[i], i, 0.5 * std::numbers::pi, "pi / 2");  // of blades
      }
    }
    if (config.axes == LogColumnsConfig::Axes::flu) reverse_inputs(flight.inputs, names);
    if (kind == Inputs::pwm) apply_duty(flight.inputs, config.pwm, log);
    return;
  }
  throw InputError(
      fmt::format("{}: no inputs of this vehicle; expected the columns {}", log.file(), fmt::join(wanted, "; or ")));
}

/// Marks pauses and checks that the times rise.
void read_times(RecordedFlight& flight, const Quantities& log) {
  constexpr size_t kMinSamples = 10;
  constexpr double kPause = 5.0;  // periods; shorter dropouts are bridged by the held input
  flight.t_s = log.values("t_s");
  if (flight.t_s.size() < kMinSamples) {
    throw InputError(fmt::format("{}: {} samples; at least {} are needed", log.file(), flight.t_s.size(), kMinSamples));
  }
  std::vector<double> steps;
  for (size_t i = 1; i < flight.t_s.size(); ++i) {
    steps.push_back(flight.t_s[i] - flight.t_s[i - 1]);
    if (!(steps.back() > 0.0)) {
      throw InputError(fmt::format("{}: the times of rows {} and {} do not rise", log.file(), i, i + 1));
    }
  }
  flight.period_s = median(steps);
  for (const double step : steps) flight.gap_after.push_back(step > kPause * flight.period_s);
  flight.gap_after.push_back(true);
}

}  // namespace

RecordedFlight read_recorded_flight(const std::filesystem::path& file, const LogColumnsConfig& config,
                                    const dynamics::VehicleConfig& vehicle) {
  const Quantities log(file, config);
  RecordedFlight flight;
  flight.file = log.file();
  flight.warm_up_s = config.warm_up_s;
  flight.rate_feedback = config.rate_feedback;
  flight.torque_share = config.pwm.torque_share;
  read_times(flight, log);
  const size_t n = flight.t_s.size();
  // A half turn about x exchanges the axes frd and flu, of W and of B alike.
  const bool flip = config.axes == LogColumnsConfig::Axes::flu;
  const Eigen::Vector3d signs = flip ? Eigen::Vector3d(1.0, -1.0, -1.0) : Eigen::Vector3d(1.0, 1.0, 1.0);
  const auto vectors = [&](const Names& names) {
    std::vector<Eigen::Vector3d> out = log.vectors(names);
    for (Eigen::Vector3d& v : out) v = v.cwiseProduct(signs);
    return out;
  };
  flight.states.resize(n);
  if (log.has(kQuaternion)) {
    const std::vector<double> w = log.values("qw");
    const std::vector<Eigen::Vector3d> xyz = vectors({"qx", "qy", "qz"});
    for (size_t i = 0; i < n; ++i) {
      const Eigen::Quaterniond q(w[i], xyz[i].x(), xyz[i].y(), xyz[i].z());
      if (q.norm() < 0.5) throw InputError(fmt::format("{}: the quaternion of row {} is 0", log.file(), i + 1));
      flight.states[i].q_WB = q.normalized();
    }
  } else {
    const std::vector<Eigen::Vector3d> rpy = vectors(kAngles);
    for (size_t i = 0; i < n; ++i) {
      const Eigen::Index larger = std::abs(rpy[i].x()) > std::abs(rpy[i].y()) ? 0 : 1;
      require_radians(log, kAngles[static_cast<size_t>(larger)], rpy[i][larger], i, 2.0 * std::numbers::pi, "2 pi");
      flight.states[i].q_WB = dynamics::from_roll_pitch_heading(rpy[i].x(), rpy[i].y(), rpy[i].z());
    }
  }
  const bool in_body = log.has(kVelocityB);
  const std::vector<Eigen::Vector3d> v = vectors(in_body ? kVelocityB : kVelocityW), w = vectors(kRates);
  flight.has_position = log.has(kPosition);
  const auto p = flight.has_position ? vectors(kPosition) : std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero());
  for (size_t i = 0; i < n; ++i) {
    dynamics::RigidBodyState& state = flight.states[i];
    state.p_WB = p[i];
    state.v_WB_B = in_body ? v[i] : Eigen::Vector3d(state.q_WB.conjugate() * v[i]);
    state.w_WB_B = w[i];
  }
  require_rates_in_radians(flight);
  if (log.has(kForce)) flight.specific_force_B = vectors(kForce);
  flight.wind_W = log.has(kWind) ? vectors(kWind) : std::vector<Eigen::Vector3d>(n, Eigen::Vector3d::Zero());
  read_inputs(flight, log, config, vehicle);
  flight.takes_positions_for_commands = !config.inputs && flight.kind == Inputs::controls && log.has({"model_valid"});
  return flight;
}

}  // namespace hedgehop::sim
