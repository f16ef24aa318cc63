#include "sim/scenario/motor_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace hedgehop::sim {
namespace {

using dynamics::multicopter::ArmConfig;

constexpr double kMaxAzimuthDeg = 10.0;   // neighbors of an octocopter are 45 deg apart
constexpr bool kCw = true, kCcw = false;  // clockwise, counter-clockwise

struct Frame {
  int64_t frame_class, frame_type;
  std::array<FrameMotor, 8> motors;
  size_t count;
};

constexpr Frame kFrames[] = {
    {1, 0, {{{90, kCcw}, {-90, kCcw}, {0, kCw}, {180, kCw}}}, 4},
    {1, 1, {{{45, kCcw}, {-135, kCcw}, {-45, kCw}, {135, kCw}}}, 4},
    {1, 12, {{{135, kCw}, {45, kCcw}, {-135, kCcw}, {-45, kCw}}}, 4},
    {1, 13, {{{45, kCcw}, {-45, kCw}, {-135, kCcw}, {135, kCw}}}, 4},
    {1, 14, {{{45, kCcw}, {135, kCw}, {-135, kCcw}, {-45, kCw}}}, 4},
    {2, 0, {{{0, kCw}, {180, kCcw}, {-120, kCw}, {60, kCcw}, {-60, kCcw}, {120, kCw}}}, 6},
    {2, 1, {{{90, kCw}, {-90, kCcw}, {-30, kCw}, {150, kCcw}, {30, kCcw}, {-150, kCw}}}, 6},
    {3, 0, {{{0, kCw}, {180, kCw}, {45, kCcw}, {135, kCcw}, {-45, kCcw}, {-135, kCcw}, {-90, kCw}, {90, kCw}}}, 8},
    {3,
     1,
     {{{22.5, kCw},
       {-157.5, kCw},
       {67.5, kCcw},
       {157.5, kCcw},
       {-22.5, kCcw},
       {-112.5, kCcw},
       {-67.5, kCw},
       {112.5, kCw}}},
     8},
    {4, 1, {{{45, kCcw}, {-45, kCw}, {-135, kCcw}, {135, kCw}, {-45, kCcw}, {45, kCw}, {135, kCcw}, {-135, kCw}}}, 8},
};

const Frame* find_frame(int64_t frame_class, int64_t frame_type) {
  const auto* const found = std::ranges::find_if(
      kFrames, [&](const Frame& f) { return f.frame_class == frame_class && f.frame_type == frame_type; });
  return found == std::end(kFrames) ? nullptr : found;
}

double azimuth_deg(const ArmConfig& arm) { return arm.azimuth_rad * 180.0 / std::numbers::pi; }

bool is_clockwise(const ArmConfig& arm) { return arm.turns == ArmConfig::Turns::clockwise; }

bool matches(const ArmConfig& arm, const FrameMotor& motor) {
  const double apart_deg = std::remainder(azimuth_deg(arm) - motor.azimuth_deg, 360.0);
  return std::abs(apart_deg) <= kMaxAzimuthDeg && is_clockwise(arm) == motor.clockwise;
}

/// Returns the error of a class or a type that is not in the table. @param path  as match_motors()'s.
FieldError unknown_frame(int64_t frame_class, int64_t frame_type, std::string_view path) {
  std::set<int64_t> classes, types;
  for (const Frame& frame : kFrames) {
    classes.insert(frame.frame_class);
    if (frame.frame_class == frame_class) types.insert(frame.frame_type);
  }
  if (types.empty()) {
    return {fmt::format("{}.frame_class", path),
            fmt::format("{} is unknown; valid: {}", frame_class, fmt::join(classes, ", "))};
  }
  return {fmt::format("{}.frame_type", path),
          fmt::format("{} is not for frame_class {}; valid: {}", frame_type, frame_class, fmt::join(types, ", "))};
}

}  // namespace

std::span<const FrameMotor> frame_motors(int64_t frame_class, int64_t frame_type) {
  const Frame* const frame = find_frame(frame_class, frame_type);
  return frame ? std::span(frame->motors).first(frame->count) : std::span<const FrameMotor>();
}

MotorMatch match_motors(const dynamics::multicopter::MulticopterConfig& vehicle, int64_t frame_class,
                        int64_t frame_type, std::string_view path) {
  MotorMatch match;
  const std::span<const FrameMotor> motors = frame_motors(frame_class, frame_type);
  if (motors.empty()) {
    match.errors.push_back(unknown_frame(frame_class, frame_type, path));
    return match;
  }
  if (vehicle.arms.size() != motors.size()) {
    match.errors.push_back({"vehicle.arms", fmt::format("{} arms; FRAME_CLASS {}, TYPE {} has {} motors",
                                                        vehicle.arms.size(), frame_class, frame_type, motors.size())});
    return match;
  }
  match.arm_of_motor.assign(motors.size(), vehicle.arms.size());
  for (size_t a = 0; a < vehicle.arms.size(); ++a) {
    const ArmConfig& arm = vehicle.arms[a];
    size_t m = 0;
    while (m < motors.size() && !(match.arm_of_motor[m] == vehicle.arms.size() && matches(arm, motors[m]))) ++m;
    if (m == motors.size()) {
      match.errors.push_back(
          {"vehicle.arms",
           fmt::format("arm {} ({:g}, {}) is no motor of FRAME_CLASS {}, TYPE {}", a + 1, azimuth_deg(arm),
                       is_clockwise(arm) ? "clockwise" : "counter_clockwise", frame_class, frame_type)});
      continue;
    }
    match.arm_of_motor[m] = a;
  }
  if (!match.errors.empty()) match.arm_of_motor.clear();
  return match;
}

}  // namespace hedgehop::sim
