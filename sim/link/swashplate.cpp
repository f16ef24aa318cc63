#include "sim/link/swashplate.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

namespace hedgehop::sim::link {
namespace {

using Type = HelicopterLinkConfig::Swashplate;
/// Per servo: the factors of collective, roll and pitch.
using Factors = Eigen::Matrix<double, 4, 3>;

constexpr double kRollPitchScale = 0.45;  // of ArduPilot's mixing

Factors mixing(const HelicopterLinkConfig& config) {
  Factors f = Factors::Zero();
  f.col(0).setOnes();
  switch (config.swashplate) {
    case Type::h3:
      for (Eigen::Index i = 0; i < 3; ++i) {
        const double a_rad = config.h3_azimuth_rad[i] - config.h3_phase_rad;
        f.row(i).tail<2>() << -std::sin(a_rad), std::cos(a_rad);
      }
      break;
    case Type::h1:
      f << 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0;
      break;
    case Type::h3_140:
      f << 1, 1, 1, 1, -1, 1, 1, 0, -1, 0, 0, 0;
      break;
    case Type::h3_120:
      f << 1, 0.866025, 0.5, 1, -0.866025, 0.5, 1, 0, -1, 0, 0, 0;
      break;
    case Type::h4_90:
      f << 1, 1, 0, 1, -1, 0, 1, 0, -1, 1, 0, 1;
      break;
    case Type::h4_45:
      f << 1, 0.707107, 0.707107, 1, -0.707107, 0.707107, 1, 0.707107, -0.707, 1, -0.707107, -0.707;
      break;
  }
  f.rightCols<2>() *= kRollPitchScale;
  if (swash_servos(config.swashplate) == 3) f.row(3).setZero();
  return f;
}

}  // namespace

size_t swash_servos(Type type) { return type == Type::h4_90 || type == Type::h4_45 ? 4 : 3; }

SwashplateInverse::SwashplateInverse(const HelicopterLinkConfig& config)
    : servos_(swash_servos(config.swashplate)), reversed_(config.collective_reversed) {
  const Factors factors = mixing(config);
  const Eigen::Matrix3d squared = factors.transpose() * factors;
  constexpr double kSingular = 1e-6;
  if (std::abs(squared.determinant()) < kSingular) {
    throw std::invalid_argument("h3_azimuths: the servos do not determine collective, roll and pitch");
  }
  inverse_ = squared.inverse() * factors.transpose();
  for (size_t i = 0; i < servos_; ++i) {
    const double trim_us = config.trim_us.empty() ? 1500.0 : config.trim_us[i];
    const bool is_centered = config.swashplate == Type::h1 && i < 2;  // its output is 0.5 at roll or pitch 0
    zero_us_[static_cast<Eigen::Index>(i)] = is_centered ? trim_us : trim_us - 500.0;
  }
}

SwashCommand SwashplateInverse::command(std::span<const double> pulse_us) const {
  Eigen::Vector4d u = Eigen::Vector4d::Zero();
  for (size_t i = 0; i < servos_; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    u[k] = (pulse_us[i] - zero_us_[k]) / 1000.0;
  }
  const Eigen::Vector3d found = inverse_ * u;
  return {reversed_ ? 1.0 - found[0] : found[0], found[1], found[2]};
}

}  // namespace hedgehop::sim::link
