#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "dynamics/actuators.h"
#include "dynamics/control/hover_model.h"
#include "dynamics/control/lqr.h"
#include "dynamics/control/navigation.h"
#include "dynamics/vehicle.h"
#include "sim/fields/field.h"

/// Setpoints, and the autopilot that follows them.
namespace hedgehop::dynamics::control {

/// Fly at a horizontal velocity; hold an altitude and a heading.
struct VelocitySetpoint {
  Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();  ///< north, east, m/s
  double altitude_m = 0.0;                           ///< above W's origin, positive up
  double heading_rad = 0.0;                          ///< from north to east
};
/// Fly to a point and hold it.
struct PositionSetpoint {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
  double heading_rad = 0.0;
};
/// Hold an attitude and an altitude. Roll and pitch are relative to the trimmed hover.
struct AttitudeSetpoint {
  double roll_rad = 0.0, pitch_rad = 0.0, heading_rad = 0.0, altitude_m = 0.0;
};
/// Stop and hold the position; turn at `yaw_rate_radps`.
struct HoverSetpoint {
  double yaw_rate_radps = 0.0;
};
using Setpoint = std::variant<VelocitySetpoint, PositionSetpoint, AttitudeSetpoint, HoverSetpoint>;

/// Limits of the autopilot. Its gains follow from the vehicle.
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
    {.unit = "m/s", .above = 0.0, .at_most = 20.0, .meaning = "maximum commanded horizontal speed"});
  v("acceleration_limit", c.acceleration_limit_mps2,
    {.unit = "m/s2", .above = 0.0, .at_most = 6.0, .meaning = "maximum planned horizontal acceleration"});
  v("climb_rate_limit", c.climb_rate_limit_mps,
    {.unit = "m/s", .above = 0.0, .at_most = 5.0, .meaning = "maximum planned vertical speed"});
  v("yaw_rate_limit", c.yaw_rate_limit_radps,
    {.unit = "deg/s", .above = 0.0, .at_most = 180.0, .meaning = "maximum planned yaw rate"});
  v("tilt_limit", c.tilt_limit_rad,
    {.unit = "deg", .above = 0.0, .at_most = 45.0, .meaning = "maximum commanded tilt from the attitude of the hover"});
}

/// Autopilot of any vehicle that has a hover model. It has two linear-quadratic designs on that model. The first plans
/// a reference flight within the limits. The second, with integrals of velocity, altitude and heading, holds the
/// vehicle to the reference flight. Setpoints act on the reference flight only, so the integrals respond to
/// disturbances only. Sources: design by [BrysonHo1975] sec. 5.2 with weights by the inverse squares of acceptable
/// deviations; following an explicit model [Tyler1964] sec. II.
class Autopilot {
 public:
  /// Throws std::invalid_argument if values are out of range or the vehicle cannot be stabilized.
  Autopilot(const AutopilotConfig& config, const VehicleConfig& vehicle);

  /// Starts a flight in a trimmed hover.
  void reset(const NavigationEstimate& now);
  /// Returns the actuator commands for the next dt_s, > 0.
  Controls control(const Setpoint& setpoint, const NavigationEstimate& now, double dt_s);

  const HoverModel& model() const { return model_; }

 private:
  /// A setpoint of any kind, as input of the reference flight.
  struct Target {
    Eigen::Vector2d v_WB_W = Eigen::Vector2d::Zero();
    double altitude_m = 0.0, heading_rad = 0.0;
    bool attitude = false;  ///< hold roll and pitch (from the trim) instead of the velocity
    double roll_rad = 0.0, pitch_rad = 0.0;
  };
  /// Commands for the inner loop per error of the outer loop, by a gain matrix.
  struct Slopes {
    Eigen::Vector2d tilt_per_mps;  ///< pitch per forward, roll per right velocity error, rad s/m
    Eigen::Vector2d tilt_per_m;    ///< the same per integral, rad/m; zero without integrals
    double climb_per_m = 0.0;      ///< vertical velocity per altitude error, 1/s
    double turn_per_rad = 0.0;     ///< turn rate per heading error, 1/s
  };
  /// Hold point of a HoverSetpoint.
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
  DesignMatrix K_plan_, K_hold_;                 ///< inputs x states; in K_hold_ the four integrals follow the states
  Slopes plan_slopes_, hold_slopes_;

  DesignVector reference_;     ///< state of the reference flight, velocities in the frame of its own heading
  DesignVector hidden_;        ///< the vehicle's hidden states, predicted by the model
  Eigen::Vector4d integrals_;  ///< of the errors forward (m), right (m), below (m s), heading (rad s)
  std::optional<HoverAnchor> anchor_;
};

}  // namespace hedgehop::dynamics::control
