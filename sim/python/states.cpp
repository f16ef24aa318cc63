#include <pybind11/stl.h>

#include <array>
#include <cmath>

#include "avoidance/policy/action_pilot.h"
#include "sim/fields/quantities.h"
#include "sim/python/bindings.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::python {
namespace py = pybind11;
using namespace py::literals;
using namespace avoidance;

namespace {

using dynamics::control::RateSetpoint;
using dynamics::multicopter::PerRotor;

struct MotorCommand {
  Eigen::VectorXd speeds_radps;
};

void bind_commands(py::module_& native) {
  py::class_<VelocityCommand>(native, "VelocityCommand",
                              "Fly at a horizontal velocity (north, east), and hold altitude and heading.")
      .def(py::init([](const Eigen::Vector2d& v, double altitude_m, double heading_rad) {
             return VelocityCommand{v, altitude_m, heading_rad};
           }),
           "v_WB_W_mps"_a, "altitude_m"_a, "heading_rad"_a)
      .def_readwrite("v_WB_W_mps", &VelocityCommand::v_WB_W)
      .def_readwrite("altitude_m", &VelocityCommand::altitude_m)
      .def_readwrite("heading_rad", &VelocityCommand::heading_rad);
  py::class_<PositionCommand>(native, "PositionCommand", "Fly to a point in W (north, east, down) and hover there.")
      .def(py::init([](const Eigen::Vector3d& p, double heading_rad) {
             return PositionCommand{p, heading_rad};
           }),
           "p_WB_m"_a, "heading_rad"_a)
      .def_readwrite("p_WB_m", &PositionCommand::p_WB)
      .def_readwrite("heading_rad", &PositionCommand::heading_rad);
  py::class_<AttitudeCommand>(native, "AttitudeCommand", "Hold attitude and altitude.")
      .def(py::init([](double roll_rad, double pitch_rad, double heading_rad, double altitude_m) {
             return AttitudeCommand{roll_rad, pitch_rad, heading_rad, altitude_m};
           }),
           "roll_rad"_a, "pitch_rad"_a, "heading_rad"_a, "altitude_m"_a)
      .def_readwrite("roll_rad", &AttitudeCommand::roll_rad)
      .def_readwrite("pitch_rad", &AttitudeCommand::pitch_rad)
      .def_readwrite("heading_rad", &AttitudeCommand::heading_rad)
      .def_readwrite("altitude_m", &AttitudeCommand::altitude_m);
  py::class_<HoverCommand>(native, "HoverCommand", "Hover, with a yaw rate.")
      .def(py::init([](double yaw_rate_radps) { return HoverCommand{yaw_rate_radps}; }), "yaw_rate_radps"_a = 0.0)
      .def_readwrite("yaw_rate_radps", &HoverCommand::yaw_rate_radps);
  py::class_<RateSetpoint>(
      native, "BodyRateCommand",
      "Turn at body rates with a share of the thrust, below the autopilot; for Simulation, not for modules.")
      .def(py::init([](const Eigen::Vector3d& w, double thrust) {
             return RateSetpoint{w, thrust};
           }),
           "w_WB_B_radps"_a, "thrust"_a)
      .def_readwrite("w_WB_B_radps", &RateSetpoint::w_WB_B)
      .def_readwrite("thrust", &RateSetpoint::thrust);
  py::class_<MotorCommand>(
      native, "MotorCommand",
      "Speed of each rotor of a multicopter, below the autopilot; for Simulation, not for modules.")
      .def(py::init([](const Eigen::VectorXd& speeds) { return MotorCommand{speeds}; }), "speeds_radps"_a)
      .def_readwrite("speeds_radps", &MotorCommand::speeds_radps);
  py::class_<Decision>(native, "Decision", "A command, a status word, and the values of the module's signals.")
      .def(py::init([](const Command& command, std::string status, std::vector<double> signals) {
             return Decision{command, std::move(status), std::move(signals)};
           }),
           "command"_a, "status"_a = "cruise", "signals"_a = std::vector<double>{})
      .def_readwrite("command", &Decision::command)
      .def_readwrite("status", &Decision::status)
      .def_readwrite("signals", &Decision::signals);
}

void bind_observation(py::module_& native) {
  py::class_<NavigationState>(native, "NavigationState", "The estimated motion of the aircraft, from noisy sensors.")
      .def(py::init<>())
      .def_readwrite("p_WB_est_m", &NavigationState::p_WB_est, "position in W")
      .def_property(
          "q_WB_est", [](const NavigationState& n) { return wxyz(n.q_WB_est); },
          [](NavigationState& n, const Eigen::Vector4d& q) {
            n.q_WB_est = {q[0], q[1], q[2], q[3]};
          },
          "attitude in W, (w, x, y, z)")
      .def_readwrite("v_WB_B_est_mps", &NavigationState::v_WB_B_est, "velocity in B")
      .def_readwrite("w_WB_B_est_radps", &NavigationState::w_WB_B_est, "angular velocity in B")
      .def_property(
          "q_WB_gyro", [](const NavigationState& n) { return wxyz(n.q_WB_gyro); },
          [](NavigationState& n, const Eigen::Vector4d& q) {
            n.q_WB_gyro = {q[0], q[1], q[2], q[3]};
          },
          "attitude from the gyros only, (w, x, y, z)")
      .def_readwrite("height_above_ground_m", &NavigationState::height_above_ground_m, "from the height sensor")
      .def_readwrite("range_m", &NavigationState::range_m, "from the range finder; None without a reading");
  py::class_<Goal>(native, "Goal", "The current goal.")
      .def(py::init([](const Eigen::Vector3d& p, double heading_rad) {
             return Goal{p, heading_rad};
           }),
           "p_WG_m"_a = Eigen::Vector3d(Eigen::Vector3d::Zero()), "heading_rad"_a = 0.0)
      .def_readwrite("p_WG_m", &Goal::p_WG)
      .def_readwrite("heading_rad", &Goal::heading_rad);
  py::class_<Observation>(native, "Observation", "The input of a module: images, navigation, goal.")
      .def(py::init([](int64_t t_ns, py::dict images, const NavigationState& navigation, const Goal& goal,
                       py::dict image_t_ns) {
             return Observation{t_ns, std::move(images), navigation, goal, std::move(image_t_ns)};
           }),
           "t_ns"_a, "images"_a, "navigation"_a, "goal"_a, "image_t_ns"_a = py::dict())
      .def_readonly("t_ns", &Observation::t_ns, "current time, ns; images may be older")
      .def_property_readonly(
          "t_s", [](const Observation& o) { return seconds(o.t_ns); }, "current time, s")
      .def_readonly("image_t_ns", &Observation::image_t_ns,
                    "role: instant of the image, ns, at which its exposure ends")
      .def_readonly("images", &Observation::images, "role: array, valid until the simulation continues")
      .def_readonly("navigation", &Observation::navigation, "estimated motion of the aircraft")
      .def_readonly("goal", &Observation::goal, "current goal");
}

void bind_setup(py::module_& native) {
  py::class_<VehicleLimits>(native, "VehicleLimits", "Limits of the autopilot, and the size of the vehicle.")
      .def_readonly("speed_mps", &VehicleLimits::speed_mps, "maximum speed")
      .def_readonly("acceleration_mps2", &VehicleLimits::acceleration_mps2, "maximum acceleration")
      .def_readonly("radius_m", &VehicleLimits::radius_m, "radius of a sphere about B that contains the hull")
      .def_property_readonly(
          "outline_B_m",
          [](const VehicleLimits& l) {
            py::list boxes;
            for (const Eigen::AlignedBox3d& box : l.outline_B) {
              boxes.append(py::make_tuple(Eigen::Vector3d(box.min()), Eigen::Vector3d(box.max())));
            }
            return boxes;
          },
          "boxes that contain the hull, as pairs of corners in B");
  py::class_<Setup>(native, "Setup", "The input of a module before a flight.")
      .def_readonly("cameras", &Setup::cameras, "all cameras of the rig")
      .def_readonly("limits", &Setup::limits, "limits of the vehicle")
      .def_property_readonly(
          "altitude_band_m",
          [](const Setup& s) -> std::optional<std::pair<double, double>> {
            if (!s.altitude_band) return std::nullopt;
            return std::pair{s.altitude_band->min_m, s.altitude_band->max_m};
          },
          "minimum and maximum altitude of the mission; None if the altitude is fixed")
      .def_readonly("seed", &Setup::seed, "for random numbers of the module");
}

void bind_policies(py::module_& native) {
  using policy::ActionPilot;
  native.def("state_of", &policy::state_of, "navigation"_a, "goal"_a,
             "The state for a policy: ten numbers, as \"state\" of Env.");
  py::class_<ActionPilot>(
      native, "ActionPilot",
      "Converts actions into commands, as in Env. Starts at the altitude and heading of a navigation state.")
      .def(py::init<const NavigationState&>(), "navigation"_a)
      .def("fly", &ActionPilot::fly, "action"_a, "navigation"_a, "speed_limit_mps"_a, "step_s"_a);
}

void bind_truth(py::module_& native) {
  py::class_<sim::TrueMotion>(native, "TrueMotion", "The true motion of the vehicle, for evaluation only.")
      .def_readonly("p_WB_m", &sim::TrueMotion::p_WB)
      .def_property_readonly(
          "q_WB", [](const sim::TrueMotion& t) { return wxyz(t.q_WB); }, "(w, x, y, z)")
      .def_readonly("v_WB_W_mps", &sim::TrueMotion::v_WB_W)
      .def_readonly("w_WB_B_radps", &sim::TrueMotion::w_WB_B)
      .def_readonly("wind_W_mps", &sim::TrueMotion::wind_W);
  py::class_<sim::Proximity>(native, "Proximity", "True clearances of the hull.")
      .def_readonly("obstacle_clearance_m", &sim::Proximity::obstacle_clearance_m)
      .def_readonly("ground_clearance_m", &sim::Proximity::ground_clearance_m)
      .def_readonly("collided", &sim::Proximity::collided);
}

}  // namespace

Observation to_python(const avoidance::Observation& observation) {
  Observation seen{observation.t_ns, {}, observation.navigation, observation.goal, {}};
  for (const CameraFrame& frame : observation.frames) {
    seen.images[py::str(frame.role)] = view_of(frame.image);
    seen.image_t_ns[py::str(frame.role)] = frame.t_ns;
  }
  return seen;
}

Decision to_decision(const py::handle& answer) {
  if (py::isinstance<Decision>(answer)) return answer.cast<Decision>();
  if (answer.is_none()) throw std::invalid_argument("update() returned None, not a command or a Decision");
  try {
    return {answer.cast<Command>(), "cruise", {}};
  } catch (const py::cast_error&) {
    throw std::invalid_argument("expected a command or a Decision, got " +
                                std::string(py::str(py::type::of(answer).attr("__name__"))));
  }
}

sim::CallerCommand to_caller_command(const py::handle& command) {
  if (py::isinstance<RateSetpoint>(command)) return sim::DirectCommand(command.cast<RateSetpoint>());
  if (!py::isinstance<MotorCommand>(command)) return to_decision(command).command;
  const Eigen::VectorXd& speeds_radps = command.cast<const MotorCommand&>().speeds_radps;
  if (speeds_radps.size() > PerRotor::MaxRowsAtCompileTime) {
    throw std::invalid_argument("a vehicle has at most " + std::to_string(PerRotor::MaxRowsAtCompileTime) +
                                " rotors, got " + std::to_string(speeds_radps.size()) + " speeds");
  }
  return sim::DirectCommand(PerRotor(speeds_radps));
}

void bind_states(py::module_& native) {
  bind_commands(native);
  bind_observation(native);
  bind_cameras(native);
  bind_setup(native);
  bind_policies(native);
  bind_truth(native);
}

}  // namespace hedgehop::python
