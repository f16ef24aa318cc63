#include "sim/link/state_text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace hedgehop::sim::link {
namespace {

constexpr double kClockLeadS = 1e-10;  // per step: more than the rounding of a step, less than 1 us in 1e4 steps
constexpr size_t kRangeFinderKeys = 6;

void add_vector(std::string& text, const Eigen::Vector3d& v) {
  fmt::format_to(std::back_inserter(text), "[{},{},{}]", v.x(), v.y(), v.z());
}

}  // namespace

bool write_state(const PhysicsState& state, std::string& text) {
  const dynamics::RigidBodyState& body = state.body;
  const Eigen::Vector3d v_WB_W = body.q_WB * body.v_WB_B;
  if (!body.p_WB.allFinite() || !body.q_WB.coeffs().allFinite() || !v_WB_W.allFinite() || !body.w_WB_B.allFinite() ||
      !state.specific_force_B.allFinite() || !state.wind_W.allFinite()) {
    return false;
  }
  text.clear();
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "\n{{\"timestamp\":{:.11f},\"imu\":{{\"gyro\":",
                 state.time_s + kClockLeadS * static_cast<double>(state.step));
  add_vector(text, body.w_WB_B);
  text += ",\"accel_body\":";
  add_vector(text, state.specific_force_B);
  text += "},\"position\":";
  add_vector(text, body.p_WB);
  text += ",\"attitude\":";
  add_vector(text, dynamics::to_roll_pitch_heading(body.q_WB));
  const Eigen::Quaterniond& q = body.q_WB;
  fmt::format_to(out, ",\"quaternion\":[{},{},{},{}],\"velocity\":", q.w(), q.x(), q.y(), q.z());
  add_vector(text, v_WB_W);
  for (size_t i = 0; i < (state.range_m.empty() ? 0 : kRangeFinderKeys); ++i) {
    const bool sees = i < state.range_m.size() && std::isfinite(state.range_m[i]);
    fmt::format_to(out, ",\"rng_{}\":{}", i + 1, sees ? state.range_m[i] : -1.0);
  }
  text += ",\"velocity_wind\":";
  add_vector(text, state.wind_W);
  fmt::format_to(out, ",\"airspeed\":{}}}\n", (v_WB_W - state.wind_W).norm());
  return true;
}

}  // namespace hedgehop::sim::link
