#pragma once

#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "avoidance/corridor_centering/wall_observer.h"
#include "avoidance/module.h"
#include "vision/corridor/corridor_space.h"

/// The modified law: flies towards the middle of the gap ahead and reduces the speed near obstacles. Frame H: B
/// leveled, x along the heading, y to the right.
namespace hedgehop::avoidance::corridor_centering {

/// Maximum angle from the heading to the course, rad. At larger angles the corridor leaves the regions in which walls
/// are measured.
inline constexpr double kMaxCourseRad = 50.0 * std::numbers::pi / 180.0;

/// Returns the course to the middle of the gap at the distance `ahead_m`, rad to the right of the heading, at most
/// `most_rad`. In a straight corridor, the offset from the middle decreases by the factor e per `ahead_m` of path, at
/// any speed and without overshoot. The published controller acts on the acceleration, so its settling time is constant
/// at any speed.
/// @param gap  both sides known. @param ahead_m  > 0.
double pursuit_course_rad(const vision::corridor::Gap& gap, double ahead_m, double most_rad);

/// Limits of the speed.
struct SpeedLimits {
  double speed_mps = 0.8;    ///< without near obstacles
  double aside_s = 0.8;      ///< minimum time to fly the clearance of the narrower side: time for two corrections
  double stop_mps2 = 1.0;    ///< assumed deceleration
  double reaction_s = 0.35;  ///< from an image to the response of the vehicle: three images at 10 Hz
};

/// Returns the maximum speed, m/s, >= 0, at which flying the lateral clearance takes at least `aside_s` and the vehicle
/// can stop within the path ahead.
/// @param aside_m, ahead_m  clearances of the hull, m; negative values count as 0, +inf means no obstacle.
double clearance_speed_mps(double aside_m, double ahead_m, const SpeedLimits& limits);

/// The modified law in flight.
class Pursuit {
 public:
  struct Config {
    SpeedLimits limits;
    double lookahead_m = 1.5;  ///< distance of the target point, > 0
    double margin_m = 0.15;    ///< minimum clearance of the hull, >= 0
    double probe_mps = 0.3;    ///< minimum speed, > 0
    double probe_s = 3.0;      ///< maximum time at that speed without a measurement, > 0
    double yaw_rate_radps = 0.5;
    double radius_m = 0.0;  ///< of the vehicle
  };
  explicit Pursuit(const Config& config) : config_(config) {}

  /// Adds the measurements of the image of this instant.
  void observe(const WallObservation& seen, int64_t t_ns);
  /// Returns the current command. @param seen  from the last image, or null. @param is_new  whether that image is of
  /// this instant.
  /// @param dt_s  time since the last call, >= 0.
  Command update(const Observation& observation, const WallObservation* seen, bool is_new, double dt_s);

  /// Status of the last command: "cruise", "probe", "blind" or "blocked".
  const char* status() const { return status_; }
  const vision::corridor::Gap& gap() const { return gap_; }  ///< smoothed; NaN before the first
  double free_s() const { return free_s_; }                  ///< time until the hull meets the obstacle ahead
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
  int64_t known_ns_ = -1;    ///< last time at which both sides were known
  int64_t probing_ns_ = -1;  ///< time since which a side has been unknown
  int64_t dark_ns_ = -1;     ///< time in flight since which the space ahead has been unknown
  std::optional<double> course_rad_;
  std::optional<double> heading_rad_;    ///< commanded
  std::optional<double> turn_from_rad_;  ///< heading at which the path was blocked
  double turn_ = 1.0;                    ///< to the right
};

}  // namespace hedgehop::avoidance::corridor_centering
