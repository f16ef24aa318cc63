#pragma once

#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "avoidance/corridor_centering/wall_observer.h"
#include "avoidance/module.h"
#include "vision/corridor/corridor_space.h"

/// Law `modified`: fly towards the middle of the gap ahead, and mind what lies ahead. Frame H: B turned level, x along
/// the heading, y to the right.
namespace hedgehop::avoidance::corridor_centering {

/// Greatest angle from the heading to the course, rad: beyond, the corridor leaves the regions in which walls are
/// measured.
inline constexpr double kMaxCourseRad = 50.0 * std::numbers::pi / 180.0;

/// Returns the course to the middle of the gap `ahead_m` in front, rad to the right of the heading, within `most_rad`.
/// An offset from a straight corridor's middle falls by e in every `ahead_m` of path, at any speed, and cannot
/// overshoot; the printed controller acts on acceleration, and its settling takes a fixed time, at any speed.
/// @param gap  both sides known. @param ahead_m  > 0.
double pursuit_course_rad(const vision::corridor::Gap& gap, double ahead_m, double most_rad);

/// What limits the speed.
struct SpeedLimits {
  double speed_mps = 0.8;    ///< where nothing is near
  double aside_s = 0.8;      ///< in this time it could fly the clearance at its narrower side: time to correct twice
  double stop_mps2 = 1.0;    ///< deceleration counted on
  double reaction_s = 0.35;  ///< from the image to the vehicle's answer: three images at 10 Hz
};

/// Returns the greatest speed at which the clearance aside is flown in no less than `aside_s` and the path ahead is
/// long enough to stop in, m/s, >= 0.
/// @param aside_m, ahead_m  clearances of the hull, m; below 0 counts as 0, +inf is nothing there.
double clearance_speed_mps(double aside_m, double ahead_m, const SpeedLimits& limits);

/// The law in flight.
class Pursuit {
 public:
  struct Config {
    SpeedLimits limits;
    double lookahead_m = 1.5;  ///< distance of the point flown to, > 0
    double margin_m = 0.15;    ///< clearance of the hull that is kept, >= 0
    double probe_mps = 0.3;    ///< least speed, > 0
    double probe_s = 3.0;      ///< longest time at that speed without a measurement, > 0
    double yaw_rate_radps = 0.5;
    double radius_m = 0.0;  ///< of the vehicle
  };
  explicit Pursuit(const Config& config) : config_(config) {}

  /// Takes what an image of this instant shows.
  void observe(const WallObservation& seen, int64_t t_ns);
  /// Returns what to fly now. @param seen  of the last image, or null. @param is_new  whether that is of this instant.
  /// @param dt_s  since the last call, >= 0.
  Command update(const Observation& observation, const WallObservation* seen, bool is_new, double dt_s);

  /// Of the last command: "cruise", "probe", "blind" or "blocked".
  const char* status() const { return status_; }
  const vision::corridor::Gap& gap() const { return gap_; }                ///< smoothed; NaN before the first
  double free_s() const { return free_s_; }                                ///< until the hull meets what lies ahead
  const std::optional<double>& course_rad() const { return course_rad_; }  ///< to the right of the heading

 private:
  void follow_gap(const WallObservation& seen, int64_t t_ns);
  bool is_blocked(const WallObservation* seen, int64_t now_ns) const;
  double hull_ahead_m(const WallObservation* seen) const;
  Command turn_away();
  Command fly(const Observation& observation, double speed_mps, double course_rad, double dt_s);

  Config config_;
  const char* status_ = "wait";
  vision::corridor::Gap gap_{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  double free_s_ = std::numeric_limits<double>::infinity();
  int64_t known_ns_ = -1;    ///< when both sides were known last
  int64_t probing_ns_ = -1;  ///< since when they have not been
  int64_t dark_ns_ = -1;     ///< since when, flying, nothing was known of what lies ahead
  std::optional<double> course_rad_;
  std::optional<double> heading_rad_;    ///< commanded
  std::optional<double> turn_from_rad_;  ///< heading at which the path was blocked
  double turn_ = 1.0;                    ///< to the right
};

}  // namespace hedgehop::avoidance::corridor_centering
