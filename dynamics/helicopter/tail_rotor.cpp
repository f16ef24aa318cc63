#include "dynamics/helicopter/tail_rotor.h"

#include <cmath>

namespace hedgehop::dynamics::helicopter {
namespace {

// Limit of w_r over hover inflow. Chosen: fast sideways flight puts a tail rotor into its own wake, which pilots fly
// through; up to this limit, momentum theory is a fair mean.
constexpr double kDescentLimit = 1.0;

}  // namespace

TailRotor make_tail_rotor(const TailRotorConfig& c, double main_speed_radps, double clockwise, double density_kgpm3) {
  TailRotor rotor;
  rotor.disc = make_rotor_disc(c, c.gear_ratio * main_speed_radps, density_kgpm3);
  rotor.disc.descent_limit = kDescentLimit;
  rotor.clockwise = clockwise;
  rotor.thrust_fraction = c.thrust_fraction;
  rotor.arm_m = c.arm_m;
  rotor.height_m = c.height_m;
  return rotor;
}

TailRotorLoads tail_rotor_loads(const TailRotor& rotor, double collective_rad, const Eigen::Vector3d& v_air_B,
                                const Eigen::Vector3d& w_WB_B) {
  // Air at the hub, normal to the disc and in its plane. The thrust is to the left if the main rotor turns clockwise.
  const double v_tr = v_air_B.y() - rotor.arm_m * w_WB_B.z() + rotor.height_m * w_WB_B.x();
  const double w_tr = v_air_B.z() + rotor.arm_m * w_WB_B.y();
  const double upflow = rotor.clockwise * v_tr;
  const double inplane = Eigen::Vector2d(v_air_B.x(), w_tr).norm();

  TailRotorLoads loads;
  loads.inflow = solve_inflow(rotor.disc, collective_rad, upflow, inplane);
  loads.power_w = shaft_power_w(rotor.disc, loads.inflow, upflow, inplane);
  const double Y = -rotor.clockwise * rotor.thrust_fraction * loads.inflow.thrust_n;
  loads.f_B = {0.0, Y, 0.0};
  loads.t_B = {Y * rotor.height_m, 0.0, -Y * rotor.arm_m};
  return loads;
}

}  // namespace hedgehop::dynamics::helicopter
