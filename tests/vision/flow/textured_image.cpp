#include "tests/vision/flow/textured_image.h"

namespace hedgehop::vision {
namespace {

/// sin(2 pi x) to 1e-11. Unlike std::sin, the compiler vectorizes it.
inline double sine_of_turns(double x) {
  constexpr double kRoundToInteger = 0x1.8p52;  // the sum keeps no digits below 1
  x -= (x + kRoundToInteger) - kRoundToInteger;
  const double folded = std::copysign(0.25 - std::abs(std::abs(x) - 0.25), x);
  const double y = 2 * std::numbers::pi * folded, y2 = y * y;
  double sum = 1.0;
  for (int n = 16; n >= 2; n -= 2) sum = 1.0 - sum * y2 / (n * (n + 1));  // Taylor series
  return y * sum;
}

}  // namespace

WaveTexture::WaveTexture(uint64_t seed, double least_period, double largest_period, int waves) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  double power = 0.0;
  for (int i = 0; i < waves; ++i) {
    const double period = least_period * std::pow(largest_period / least_period, uniform(random));
    const double direction = 2 * std::numbers::pi * uniform(random);
    per_s_.push_back(std::cos(direction) / period);
    per_t_.push_back(std::sin(direction) / period);
    phase_.push_back(uniform(random));
    amplitude_.push_back(period);
    power += 0.5 * period * period;
  }
  for (double& amplitude : amplitude_) amplitude *= 35.0 / std::sqrt(power);
}

double WaveTexture::grey(double s, double t) const {
  constexpr size_t kLanes = 8;
  std::array<double, kLanes> sums{};
  const size_t whole = amplitude_.size() / kLanes * kLanes;
  for (size_t first = 0; first < whole; first += kLanes) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      const size_t i = first + lane;
      sums[lane] += amplitude_[i] * sine_of_turns(per_s_[i] * s + per_t_[i] * t + phase_[i]);
    }
  }
  double sum = 127.0;
  for (size_t i = whole; i < amplitude_.size(); ++i) {
    sum += amplitude_[i] * sine_of_turns(per_s_[i] * s + per_t_[i] * t + phase_[i]);
  }
  for (const double lane : sums) sum += lane;
  return sum;
}

std::optional<Eigen::Vector2d> seen_point(const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W,
                                          const std::vector<TexturedPlane>& planes) {
  double nearest = std::numeric_limits<double>::infinity();
  std::optional<Eigen::Vector2d> point;
  for (const TexturedPlane& plane : planes) {
    const Eigen::Vector3d normal_W = plane.s_W.cross(plane.t_W);
    const double range = normal_W.dot(plane.p_WO - p_W) / normal_W.dot(ray_W);
    if (!(range > 1e-6 && range < nearest)) continue;
    const Eigen::Vector3d p_OP_W = p_W + range * ray_W - plane.p_WO;
    const double s = plane.s_W.dot(p_OP_W);
    if (std::abs(s) > plane.half_width_m) continue;
    nearest = range;
    point = {s, plane.t_W.dot(p_OP_W)};
  }
  return point;
}

}  // namespace hedgehop::vision
