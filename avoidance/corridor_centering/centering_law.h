#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "avoidance/module.h"
#include "sim/fields/field.h"

/// The published controller, [Zingg2010] sec. V-C.
namespace hedgehop::avoidance::corridor_centering {

/// Maximum age of the last measurement of both walls in flight, s: four images at 10 Hz.
inline constexpr double kPatienceS = 0.45;

/// Gains of the published controller. Source: [Zingg2010] eq. (13) and (14).
struct CenteringGains {
  double kp = 0.2;    ///< on the change of the error between two samples
  double kd = 0.009;  ///< on the error
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<CenteringGains> auto& c) {
  v("kp", c.kp, {.at_least = 0.0, .meaning = "gain on the change of the error between two samples"});
  v("kd", c.kd, {.at_least = 0.0, .meaning = "gain on the error"});
}

/// Returns C(z) = ((kp + kD) z - kp) / z applied to the centering error: roll to the right, rad, which is also the turn
/// rate to the right, rad/s. The steady gain is kD, and kp multiplies the difference; the letters suggest the reverse.
/// @param error, last_error  e_n of the current and of the previous sample, -1..1. Source: [Zingg2010] eq. (12).
double published_control(const CenteringGains& gains, double error, double last_error);

/// The controller in flight: sampled roll and turn rate from eq. (12) at constant pitch.
/// Source: [Zingg2010] sec. V-C. Differs: the paper keeps the thrust constant; here the height sensor controls the
/// altitude. The vehicle hovers while no walls are measured.
class CenteringLaw {
 public:
  struct Config {
    CenteringGains gains;
    double sample_s = 0.5;   ///< T, > 0
    double pitch_rad = 0.0;  ///< nose down, >= 0
    double probe_s = 0.0;    ///< maximum flight time before the first measurement
  };
  explicit CenteringLaw(const Config& config) : config_(config) {}

  /// Adds the error e_n of the image of this instant; NaN if a side is unknown.
  void observe(double error, int64_t t_ns);
  /// Returns the current command. @param dt_s  time since the last call, >= 0.
  Command update(const Observation& observation, double dt_s);
  /// Status of the last command: "cruise", "probe" or "blind".
  const char* status() const { return status_; }

 private:
  Config config_;
  const char* status_ = "wait";
  double error_ = std::numeric_limits<double>::quiet_NaN();  ///< from the last image
  double control_ = 0.0;                                     ///< roll, rad, and turn rate, rad/s
  std::optional<double> sampled_error_, heading_rad_;
  int64_t begun_ns_ = -1, known_ns_ = -1, sampled_ns_ = -1;
};

}  // namespace hedgehop::avoidance::corridor_centering
