#include "dynamics/vehicle.h"

#include <stdexcept>

#include "dynamics/plausible_units.h"
#include "sim/fields/bounds.h"

namespace hedgehop::dynamics {
namespace {

using AnyFlight = std::variant<helicopter::HelicopterFlight, multicopter::MulticopterFlight>;

AnyFlight make_flight(const helicopter::HelicopterConfig& config) { return helicopter::HelicopterFlight(config); }
AnyFlight make_flight(const multicopter::MulticopterConfig& config) { return multicopter::MulticopterFlight(config); }
AnyFlight make_flight(const VehicleConfig& config) {
  return std::visit(
      [](const auto& c) {
        fields::require_bounds(c);
        require_plausible_units(c);
        return make_flight(c);
      },
      config);
}

}  // namespace

std::vector<HullPart> hull(const VehicleConfig& config) {
  return std::visit([](const auto& c) { return hull(c); }, config);
}

Vehicle::Vehicle(const VehicleConfig& config) : flight_(make_flight(config)) { hull(config); }

void Vehicle::reset(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  std::visit([&](auto& flight) { flight.reset(p_WB, heading_rad, wind_W); }, flight_);
}

void Vehicle::step(const Controls& command, const Eigen::Vector3d& wind_W, double dt_s) {
  std::visit([&](auto& flight) { flight.step_controls(command, wind_W, dt_s); }, flight_);
}

void Vehicle::step(const ActuatorCommand& command, const Eigen::Vector3d& wind_W, double dt_s) {
  if (const auto* const controls = std::get_if<Controls>(&command)) {
    step(*controls, wind_W, dt_s);
    return;
  }
  const auto& speeds_radps = std::get<multicopter::PerRotor>(command);
  auto* const flight = std::get_if<multicopter::MulticopterFlight>(&flight_);
  if (flight == nullptr || speeds_radps.size() != flight->state().speeds_radps.size()) {
    throw std::invalid_argument("the vehicle has another number of rotors than commanded");
  }
  flight->step_rotors(speeds_radps, wind_W, dt_s);
}

void Vehicle::reset_on_stand(const Eigen::Vector3d& p_WB, double heading_rad, const Eigen::Vector3d& wind_W) {
  std::visit([&](auto& flight) { flight.reset_on_stand(p_WB, heading_rad, wind_W); }, flight_);
}

bool Vehicle::step_on_stand(const ActuatorCommand& command, const Eigen::Vector3d& wind_W, double dt_s) {
  const RigidBodyState held = body();
  step(command, wind_W, dt_s);
  set_body(held, wind_W);
  return (held.q_WB * specific_force_B()).z() < -kGravityMps2;
}

void Vehicle::set_body(const RigidBodyState& body, const Eigen::Vector3d& wind_W) {
  std::visit(
      [&](auto& flight) {
        auto state = flight.state();
        if constexpr (requires { state.body; }) {
          state.body = body;
        } else {
          state.airframe.body = body;
        }
        flight.set_state(state, wind_W);
      },
      flight_);
}

void Vehicle::set_engine(bool on) {
  if (auto* const flight = std::get_if<helicopter::HelicopterFlight>(&flight_)) flight->set_engine(on);
}

void Vehicle::set_faults(std::span<const ActuatorFault> faults) {
  std::visit([&](auto& flight) { flight.set_faults(faults); }, flight_);
}

const RigidBodyState& Vehicle::body() const {
  return std::visit([](const auto& flight) -> const RigidBodyState& { return flight.body(); }, flight_);
}

const Eigen::Vector3d& Vehicle::specific_force_B() const {
  return std::visit([](const auto& flight) -> const Eigen::Vector3d& { return flight.specific_force_B(); }, flight_);
}

Controls Vehicle::actuators() const {
  return std::visit([](const auto& flight) { return flight.controls(); }, flight_);
}

const std::array<std::string_view, kControlAxes>& Vehicle::control_names() const {
  return std::visit(
      [](const auto& flight) -> const auto& { return flight.kControlNames; }, flight_);
}

bool Vehicle::within_validity() const {
  return std::visit([](const auto& flight) { return flight.within_validity(); }, flight_);
}

}  // namespace hedgehop::dynamics
