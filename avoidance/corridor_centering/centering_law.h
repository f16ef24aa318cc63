#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "avoidance/module.h"

/// The controller of [Zingg2010] sec. V-C.
namespace hedgehop::avoidance::corridor_centering {

/// How long a vehicle flies by its last measurement of both walls, s: four images at 10 Hz.
inline constexpr double kPatienceS = 0.45;

/// The printed controller's gains. Source: [Zingg2010] eq. (13) and (14).
struct CenteringGains {
  double kp = 0.2;    ///< on the change of the error from one sample to the next
  double kd = 0.009;  ///< on the error itself
};

template <class Visitor>
void describe(Visitor& v, CenteringGains& c) {
  v("kp", c.kp, {.at_least = 0.0, .meaning = "on the change of the error from sample to sample"});
  v("kd", c.kd, {.at_least = 0.0, .meaning = "on the error itself"});
}

/// Returns C(z) = ((kp + kD) z - kp) / z of the centering error: roll to the right, rad, and as well turn rate to the
/// right, rad/s. Its steady gain is kD and kp multiplies the difference, the reverse of what the letters suggest.
/// @param error, last_error  e_n now and one sample ago, -1..1. Source: [Zingg2010] eq. (12).
double published_control(const CenteringGains& gains, double error, double last_error);

/// The controller in flight: roll and turn rate by eq. (12), sampled, at constant pitch.
/// Source: [Zingg2010] sec. V-C. Differs: the paper keeps the thrust constant, we hold the height with the height
/// sensor; and it hovers while no walls are measured.
class CenteringLaw {
 public:
  struct Config {
    CenteringGains gains;
    double sample_s = 0.5;   ///< T, > 0
    double pitch_rad = 0.0;  ///< nose down, >= 0
    double probe_s = 0.0;    ///< time for which it flies before it measures anything
  };
  explicit CenteringLaw(const Config& config) : config_(config) {}

  /// Takes the error e_n that an image of this instant shows, NaN when a side is unknown.
  void observe(double error, int64_t t_ns);
  /// Returns what to fly now. @param dt_s  since the last call, >= 0.
  Command update(const Observation& observation, double dt_s);
  /// Of the last command: "cruise", "probe" or "blind".
  const char* status() const { return status_; }

 private:
  Config config_;
  const char* status_ = "wait";
  double error_ = std::numeric_limits<double>::quiet_NaN();  ///< of the last image
  double control_ = 0.0;                                     ///< roll, rad, and turn rate, rad/s
  std::optional<double> sampled_error_, heading_rad_;
  int64_t begun_ns_ = -1, known_ns_ = -1, sampled_ns_ = -1;
};

}  // namespace hedgehop::avoidance::corridor_centering
