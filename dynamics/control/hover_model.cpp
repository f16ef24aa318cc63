#include "dynamics/control/hover_model.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dynamics/helicopter/trim.h"
#include "dynamics/rigid_body.h"

namespace hedgehop::dynamics::control {
namespace {

/// Places of the states of a helicopter's linear model in the hover model.
struct HelicopterPlaces {
  std::vector<int> index;  ///< -1 for unused states: a lumped stabilizer bar has none
  int servos = 0;          ///< first state of the servos
  int size = 0;
};

HelicopterPlaces places_of(const helicopter::LinearModel& linear) {
  using L = helicopter::LinearModel;
  using M = HoverModel;
  HelicopterPlaces places{.index = std::vector<int>(L::kStates)};
  const std::vector<std::pair<int, int>> named = {{L::kU, M::kForward},
                                                  {L::kV, M::kRight},
                                                  {L::kW, M::kDown},
                                                  {L::kP, M::kP},
                                                  {L::kQ, M::kQ},
                                                  {L::kR, M::kR},
                                                  {L::kRollAngle, M::kRollAngle},
                                                  {L::kPitchAngle, M::kPitchAngle},
                                                  {L::kHeading, M::kHeading}};
  for (const auto& [from, to] : named) places.index[static_cast<size_t>(from)] = to;
  places.servos = M::kHidden;
  for (const int k : {L::kDiscBack, L::kDiscRight, L::kBarBack, L::kBarRight}) {
    const bool is_used = !linear.A.row(k).isZero(0.0) || !linear.B.row(k).isZero(0.0);
    places.index[static_cast<size_t>(k)] = is_used ? places.servos++ : -1;
  }
  places.size = places.servos + 2 * kControlAxes;
  return places;
}

HoverModel make(const helicopter::HelicopterConfig& config) {
  using L = helicopter::LinearModel;
  using M = HoverModel;
  const helicopter::HelicopterModel model = make_model(config);
  const std::optional<helicopter::Trim> hover = trim(model, Eigen::Vector3d::Zero());
  if (!hover) throw std::invalid_argument("the helicopter has no steady hover in still air");
  helicopter::LinearModel linear = linearize(model, *hover);

  // From velocity in B to velocity in the level frame. At rest, the attitude has no effect on it.
  Eigen::Matrix<double, L::kStates, L::kStates> T = Eigen::Matrix<double, L::kStates, L::kStates>::Identity();
  T.topLeftCorner<3, 3>() = from_roll_pitch_heading(hover->roll_rad, hover->pitch_rad, 0.0).toRotationMatrix();
  linear.A = (T * linear.A * T.transpose()).eval();
  linear.B = (T * linear.B).eval();

  const auto [index, servos, size] = places_of(linear);
  HoverModel out;
  out.roll_rad = hover->roll_rad;
  out.pitch_rad = hover->pitch_rad;
  DesignMatrix& A = out.motion.A = DesignMatrix::Zero(size, size);
  DesignMatrix& B = out.motion.B = DesignMatrix::Zero(size, kControlAxes);
  for (int i = 0; i < L::kStates; ++i) {
    const int row = index[static_cast<size_t>(i)];
    if (row < 0) continue;
    for (int j = 0; j < L::kStates; ++j) {
      const int col = index[static_cast<size_t>(j)];
      if (col >= 0) A(row, col) = linear.A(i, j);
    }
    for (int j = 0; j < L::kInputs; ++j) A(row, servos + 2 * j) = linear.B(i, j);
  }
  A(M::kBelow, M::kDown) = 1.0;

  out.trim = helicopter::to_controls(hover->blades);
  out.acceptable = {0.02, 0.05, 0.05, 0.1};  // chosen, rad
  const std::array<helicopter::ServoConfig, 4> configs{config.servos.collective, config.servos.cyclic,
                                                       config.servos.cyclic, config.servos.tail};
  for (int j = 0; j < kControlAxes; ++j) {
    const helicopter::ServoConfig& servo = configs[static_cast<size_t>(j)];
    const double wn2 = servo.natural_frequency_radps * servo.natural_frequency_radps;
    const int position = servos + 2 * j, rate = position + 1;
    A(position, rate) = 1.0;
    A(rate, position) = -wn2;
    A(rate, rate) = -2.0 * servo.damping * servo.natural_frequency_radps;
    B(rate, j) = wn2;
    out.lowest[j] = servo.lowest_rad;
    out.highest[j] = servo.highest_rad;
  }
  return out;
}

HoverModel make(const multicopter::MulticopterConfig& config) {
  using L = multicopter::MulticopterLinearModel;
  using M = HoverModel;
  const multicopter::MulticopterModel model = make_model(config);
  const std::optional<multicopter::MulticopterTrim> hover = trim(model, Eigen::Vector3d::Zero());
  if (!hover) throw std::invalid_argument("the multicopter has no steady hover in still air");
  const multicopter::MulticopterLinearModel linear = linearize(model, *hover);

  HoverModel out;
  out.roll_rad = hover->roll_rad;
  out.pitch_rad = hover->pitch_rad;
  constexpr int kSize = M::kHidden + static_cast<int>(kControlAxes);
  out.motion.A = DesignMatrix::Zero(kSize, kSize);
  out.motion.B = DesignMatrix::Zero(kSize, kControlAxes);
  // In a level hover, velocities in B equal those in the level frame.
  constexpr std::array<int, L::kStates> kIndex = {
      M::kForward,    M::kRight,   M::kDown,   M::kP,          M::kQ,          M::kR,         M::kRollAngle,
      M::kPitchAngle, M::kHeading, M::kHidden, M::kHidden + 1, M::kHidden + 2, M::kHidden + 3};
  for (int i = 0; i < L::kStates; ++i) {
    for (int j = 0; j < L::kStates; ++j) out.motion.A(kIndex[i], kIndex[j]) = linear.A(i, j);
    for (int j = 0; j < kControlAxes; ++j) out.motion.B(kIndex[i], j) = linear.B(i, j);
  }
  out.motion.A(M::kBelow, M::kDown) = 1.0;

  const Controls limit = multicopter::authority(model);
  out.trim = multicopter::wrench(model, hover->state.speeds_radps);
  out.highest = limit;
  out.lowest = -limit;
  out.lowest[kHeave] = 0.0;
  // Chosen: a quarter of the available torque, thrust for 3 m/s2.
  out.acceptable = 0.25 * limit;
  out.acceptable[kHeave] = 3.0 * model.mass.mass_kg;
  return out;
}

}  // namespace

HoverModel make_hover_model(const VehicleConfig& vehicle) {
  return std::visit([](const auto& config) { return make(config); }, vehicle);
}

}  // namespace hedgehop::dynamics::control
