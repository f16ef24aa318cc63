#include "dynamics/control/rate_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dynamics/vehicle.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kTurnControlDtS = 0.01, kTurnPhysicsDtS = 0.002;

/// A vehicle that turns by its true body rates, from a hover in still air.
class TurningVehicle {
 public:
  explicit TurningVehicle(const VehicleConfig& config)
      : vehicle_(config), model_(make_hover_model(config)), control_(model_, kTurnControlDtS) {
    vehicle_.reset({0.0, 0.0, -100.0}, 0.3, Eigen::Vector3d::Zero());
  }

  /// Turns for a time. @return the mean body rates of its last half.
  Eigen::Vector3d turn(const RateSetpoint& setpoint, double duration_s) {
    const auto steps = std::lround(duration_s / kTurnControlDtS);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (long i = 0; i < steps; ++i) {
      const Controls controls = control_.control(setpoint, vehicle_.body().w_WB_B);
      for (int k = 0; k < std::lround(kTurnControlDtS / kTurnPhysicsDtS); ++k) {
        vehicle_.step(controls, Eigen::Vector3d::Zero(), kTurnPhysicsDtS);
      }
      if (i >= steps / 2) sum += vehicle_.body().w_WB_B;
    }
    return sum / static_cast<double>(steps - steps / 2);
  }
  double hover_thrust() const {
    return (model_.trim[kHeave] - model_.lowest[kHeave]) / (model_.highest[kHeave] - model_.lowest[kHeave]);
  }
  const Vehicle& vehicle() const { return vehicle_; }

 private:
  Vehicle vehicle_;
  HoverModel model_;
  RateControl control_;
};

TEST(RateControl, HoldsEachBodyRateOfMulticopterAndHelicopter) {
  constexpr double kRateRadps = 0.5, kTolerance = 0.05;  // the settling is part of the mean
  constexpr double kStopTolerance = 0.125;  // the tilted vehicle gains speed, and its rotors' drag turns it
  for (const VehicleConfig& config :
       {VehicleConfig(multicopter::MulticopterConfig()), VehicleConfig(helicopter::HelicopterConfig())}) {
    for (int axis = 0; axis < 3; ++axis) {
      SCOPED_TRACE("vehicle " + std::to_string(config.index()) + ", axis " + std::to_string(axis));
      TurningVehicle turning(config);
      const Eigen::Vector3d wanted = kRateRadps * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d flown = turning.turn({wanted, turning.hover_thrust()}, 1.0);
      EXPECT_LT((flown - wanted).cwiseAbs().maxCoeff(), kTolerance) << flown.transpose();
      const Eigen::Vector3d stopped = turning.turn({Eigen::Vector3d::Zero(), turning.hover_thrust()}, 1.0);
      EXPECT_LT(stopped.cwiseAbs().maxCoeff(), kStopTolerance) << stopped.transpose();
    }
  }
}

TEST(RateControl, ThrustIsAShareOfTheForceOfAllRotorsAtTheirMaximum) {
  const multicopter::MulticopterConfig config;
  const double full_mps2 = static_cast<double>(config.arms.size()) * config.rotor.thrust_ns2 *
                           config.rotor.highest_radps * config.rotor.highest_radps / config.mass.mass_kg;
  for (const double thrust : {0.1, 0.5, 0.9}) {
    TurningVehicle turning(config);
    turning.turn({Eigen::Vector3d::Zero(), thrust}, 0.15);  // six time constants of the slower motors
    EXPECT_NEAR(turning.vehicle().specific_force_B().z(), -thrust * full_mps2, 0.03 * full_mps2) << thrust;
  }
}

TEST(RateControl, ARateBeyondTheAuthorityIsLeftWithoutWindUp) {
  TurningVehicle turning{multicopter::MulticopterConfig()};
  turning.turn({{200.0, 0.0, 0.0}, turning.hover_thrust()}, 0.5);
  EXPECT_LT(turning.turn({Eigen::Vector3d::Zero(), turning.hover_thrust()}, 2.0).norm(), 0.2);
}

}  // namespace
}  // namespace hedgehop::dynamics::control
