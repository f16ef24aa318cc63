#pragma once

#include <Eigen/Core>
#include <optional>

#include "dynamics/control/hover_model.h"
#include "dynamics/control/lqr.h"
#include "dynamics/control/navigation.h"
#include "dynamics/control/setpoint.h"
#include "dynamics/controls.h"
#include "dynamics/vehicle.h"
#include "sim/fields/field.h"

namespace hedgehop::dynamics::control {

/// What the autopilot keeps within; its gains follow from the vehicle.
struct AutopilotConfig {
  double speed_limit_mps = 3.0;
  double acceleration_limit_mps2 = 2.0;
  double climb_rate_limit_mps = 1.0;
  double yaw_rate_limit_radps = 0.7853981633974483;
  double tilt_limit_rad = 0.3490658503988659;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<AutopilotConfig> auto& c) {
  v("speed_limit", c.speed_limit_mps,
    {.unit = "m/s", .above = 0.0, .at_most = 20.0, .meaning = "limit of a commanded horizontal speed"});
  v("acceleration_limit", c.acceleration_limit_mps2,
    {.unit = "m/s2", .above = 0.0, .at_most = 6.0, .meaning = "greatest horizontal acceleration it plans"});
  v("climb_rate_limit", c.climb_rate_limit_mps,
    {.unit = "m/s", .above = 0.0, .at_most = 5.0, .meaning = "greatest vertical speed it plans"});
  v("yaw_rate_limit", c.yaw_rate_limit_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 180.0, .meaning = "greatest turn rate it plans"});
  v("tilt_limit", c.tilt_limit_rad,
    {.unit = "deg", .above = 0.0, .at_most = 45.0, .meaning = "greatest tilt from the hover's attitude it asks for"});
}

/// Flies any vehicle that has a hover model. Two linear-quadratic designs on that model: one makes a reference flight
/// that obeys the limits, the other, with integrals of velocity, altitude and heading, holds the vehicle to the
/// reference flight. Setpoints therefore meet the reference flight only, and integrals wind up with disturbances only.
/// Sources: design by [BrysonHo1975] sec. 5.2 with weights by the inverse squares of acceptable deviations; following
/// an explicit model [Tyler1964] sec. II.
class Autopilot {
 public:
  /// Throws std::invalid_argument on values out of range, or on a vehicle that cannot be stabilized.
  Autopilot(const AutopilotConfig& config, const VehicleConfig& vehicle);

  /// Starts a flight in a trimmed hover.
  void reset(const NavigationEstimate& now);
  /// Returns what to ask of the actuators over the next dt_s, > 0.
  Controls control(const Setpoint& setpoint, const NavigationEstimate& now, double dt_s);

  const HoverModel& model() const { return model_; }
  /// The reference flight's velocity, north, east, down, m/s.
  Eigen::Vector3d reference_v_WB_W() const;

 private:
  /// A setpoint of any kind, as the reference flight takes it.
  struct Target {
    Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();
    double altitude_m = 0.0, heading_rad = 0.0;
    bool attitude = false;  ///< hold roll and pitch (from the trim) instead of the velocity
    double roll_rad = 0.0, pitch_rad = 0.0;
  };
  /// What a gain matrix asks of the inner motion per error of the outer.
  struct Slopes {
    Eigen::Vector2d tilt_per_mps;  ///< pitch per forward, roll per right velocity error, rad s/m
    Eigen::Vector2d tilt_per_m;    ///< the same per integral, rad/m; zero without integrals
    double climb_per_m = 0.0;      ///< vertical velocity per altitude error, 1/s
    double turn_per_rad = 0.0;     ///< turn rate per heading error, 1/s
  };
  /// Where a HoverSetpoint stopped.
  struct HoverAnchor {
    double altitude_m = 0.0, heading_rad = 0.0;
    bool stopped = false;
    Eigen::Vector2d p_WB = Eigen::Vector2d::Zero();
  };

  void design(double dt_s);
  void solve_cruise();
  Slopes slopes(const DesignMatrix& K) const;

  Target target(const VelocitySetpoint& s, const NavigationEstimate& now);
  Target target(const PositionSetpoint& s, const NavigationEstimate& now);
  Target target(const AttitudeSetpoint& s, const NavigationEstimate& now);
  Target target(const HoverSetpoint& s, const NavigationEstimate& now);
  Eigen::Vector2d velocity_towards(const Eigen::Vector2d& p_WG, const Eigen::Vector2d& p_WB) const;

  Controls plan(const Target& target) const;
  Controls hold(const DesignVector& state, const Controls& planned, bool attitude);
  DesignVector state_of(const NavigationEstimate& now) const;
  void advance_reference(const Controls& u);

  AutopilotConfig config_;
  HoverModel model_;
  double dt_s_ = 0.0;
  LinearSystem step_;                            ///< the model, sampled
  DesignMatrix cruise_state_, cruise_controls_;  ///< of steady flight, per velocity forward and right
  DesignMatrix K_plan_, K_hold_;                 ///< inputs x states; K_hold_ with the four integrals behind
  Slopes plan_slopes_, hold_slopes_;

  DesignVector reference_;     ///< state of the reference flight, velocities in the frame of its own heading
  DesignVector hidden_;        ///< the vehicle's hidden states, predicted by the model
  Eigen::Vector4d integrals_;  ///< of the errors forward (m), right (m), below (m s), heading (rad s)
  std::optional<HoverAnchor> anchor_;
};

}  // namespace hedgehop::dynamics::control
