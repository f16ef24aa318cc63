#include "dynamics/identification/trimmed_flight.h"

#include <array>
#include <cmath>
#include <string>
#include <variant>

#include "dynamics/helicopter/trim.h"

namespace hedgehop::dynamics::identification {
namespace {

/// Velocity, rates and attitude: the first states of both linear models.
Eigen::Matrix<double, 9, 1> body_states(const RigidBodyState& body) {
  Eigen::Matrix<double, 9, 1> x;
  x << body.v_WB_B, body.w_WB_B, to_roll_pitch_heading(body.q_WB);
  return x;
}

class HelicopterTest {
 public:
  HelicopterTest(const helicopter::HelicopterConfig& config, const helicopter::Trim& trim)
      : flight_(config), trim_(to_controls(trim.blades)) {
    helicopter::HelicopterFlightState state{trim.state, {}, flight_.state().rotor};
    for (size_t i = 0; i < state.servos.size(); ++i) state.servos[i] = {trim_[static_cast<Eigen::Index>(i)], 0.0};
    if (const auto* engine = std::get_if<helicopter::GovernedEngineConfig>(&config.rotor_speed)) {
      state.rotor.integral_throttle =
          (trim.loads.main_rotor.power_w + trim.loads.tail_rotor.power_w) / engine->max_power_w;
    }
    flight_.set_state(state, Eigen::Vector3d::Zero());
    has_bar_ = flight_.model().main_rotor.flapping.explicit_bar;
  }
  const Controls& trim() const { return trim_; }
  void step(const Controls& command) { flight_.step_controls(command, Eigen::Vector3d::Zero(), kTestStepS); }
  Controls inputs(const Controls& /*before*/, const Controls& /*after*/) const { return flight_.controls(); }
  Eigen::VectorXd states() const {
    const helicopter::FlapState& flap = flight_.state().airframe.flap;
    Eigen::VectorXd x(has_bar_ ? 13 : 11);
    x.head<9>() = body_states(flight_.body());
    x.segment<2>(9) << flap.back_rad, flap.right_rad;
    if (has_bar_) x.tail<2>() << flap.bar_back_rad, flap.bar_right_rad;
    return x;
  }

 private:
  helicopter::HelicopterFlight flight_;
  Controls trim_;
  bool has_bar_ = false;
};

class MulticopterTest {
 public:
  MulticopterTest(const multicopter::MulticopterConfig& config, const multicopter::MulticopterTrim& trim)
      : flight_(config) {
    flight_.set_state(trim.state, Eigen::Vector3d::Zero());
    trim_ = flight_.controls();
  }
  const Controls& trim() const { return trim_; }
  void step(const Controls& command) { flight_.step_controls(command, Eigen::Vector3d::Zero(), kTestStepS); }
  /// The command is held over a step, so its value at a sample is the mean of both steps.
  static Controls inputs(const Controls& before, const Controls& after) { return 0.5 * (before + after); }
  Eigen::VectorXd states() const {
    Eigen::VectorXd x(13);
    x << body_states(flight_.body()), flight_.controls();
    return x;
  }

 private:
  multicopter::MulticopterFlight flight_;
  Controls trim_;
};

template <class Test>
Record flown(Test& test, const TestFlight& plan) {
  const auto steps = static_cast<Eigen::Index>(std::lround(plan.duration_s / kTestStepS));
  const Eigen::Index every = plan.steps_per_sample, samples = steps / every + 1;
  const Eigen::VectorXd trim = test.states();
  Record record{kTestStepS * static_cast<double>(every), Eigen::MatrixXd(samples, kControlAxes),
                Eigen::MatrixXd(samples, trim.size())};
  Controls before = test.trim();
  for (Eigen::Index i = 0; i <= steps; ++i) {
    Eigen::VectorXd x = test.states() - trim;
    x[8] = wrap_angle(x[8]);
    Controls command = test.trim() + plan.input(static_cast<double>(i) * kTestStepS);
    if (plan.gain.size() > 0) command -= plan.gain * x;
    if (i % every == 0) {
      record.inputs.row(i / every) = test.inputs(before, command) - test.trim();
      record.states.row(i / every) = x;
    }
    test.step(command);
    before = command;
  }
  return record;
}

std::optional<Record> fly(const helicopter::HelicopterConfig& config, const TestFlight& plan) {
  const std::optional<helicopter::Trim> trim = helicopter::trim(make_model(config), plan.v_air_W);
  if (!trim) return std::nullopt;
  HelicopterTest test(config, *trim);
  return flown(test, plan);
}

std::optional<Record> fly(const multicopter::MulticopterConfig& config, const TestFlight& plan) {
  const std::optional<multicopter::MulticopterTrim> trim = multicopter::trim(make_model(config), plan.v_air_W);
  if (!trim) return std::nullopt;
  MulticopterTest test(config, *trim);
  return flown(test, plan);
}

}  // namespace

std::optional<Record> fly_test(const VehicleConfig& vehicle, const TestFlight& test) {
  return std::visit([&](const auto& config) { return fly(config, test); }, vehicle);
}

Eigen::MatrixXd linear_states(const control::LinearSystem& linear, const Record& record) {
  const control::LinearSystem step = control::sampled(linear, record.step_s);
  Eigen::MatrixXd states = Eigen::MatrixXd::Zero(record.states.rows(), linear.A.rows());
  for (Eigen::Index i = 1; i < states.rows(); ++i) {
    const Eigen::VectorXd u = 0.5 * (record.inputs.row(i - 1) + record.inputs.row(i)).transpose();
    states.row(i) = (step.A * states.row(i - 1).transpose() + step.B * u).transpose();
  }
  return states;
}

Eigen::MatrixXd holding_gain(const NamedLinearSystem& linear, const Controls& acceptable) {
  constexpr double kSpeedMps = 2.0, kRateRadps = 1.0, kAngleRad = 0.2;  // chosen: deviations of equal cost
  constexpr double kWeak = 10.0;
  const Eigen::Index size = linear.system.A.rows();
  control::DesignMatrix Q = control::DesignMatrix::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::string& unit = linear.state_units[static_cast<size_t>(i)];
    const double scale = unit == "m/s" ? kSpeedMps : unit == "rad/s" ? kRateRadps : kAngleRad;
    if (i < 9) Q(i, i) = 1.0 / (scale * scale);
  }
  const control::DesignMatrix R = kWeak * acceptable.cwiseAbs2().cwiseInverse().asDiagonal().toDenseMatrix();
  return control::lqr_gain(control::sampled(linear.system, kTestStepS), Q, R);
}

}  // namespace hedgehop::dynamics::identification
