#include "dynamics/control/autopilot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/dynamics/control/closed_loop.h"
#include "tests/dynamics/control/step_response.h"

namespace hedgehop::dynamics::control {
namespace {

constexpr double kAutopilotDeg = std::numbers::pi / 180.0;
Loop perfect() {
  Loop loop;
  loop.perfect = true;
  return loop;
}

void expect_crisp(const StepResponse& r) {
  EXPECT_LT(r.rise_s, 1.0);
  EXPECT_LT(r.settled_s, 1.6);
  EXPECT_LT(r.overshoot, 0.15);
}

TEST(Autopilot, FollowsVelocityStepsInAllDirections) {
  for (const double size : {0.5, 1.0, 2.0}) {
    for (int direction = 0; direction < 8; ++direction) {
      const double angle = direction * std::numbers::pi / 4.0;
      SCOPED_TRACE(testing::Message() << size << " m/s towards " << angle / kAutopilotDeg << " deg");
      const StepResponse r = step_response(perfect(), size * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      expect_crisp(r);
      EXPECT_LT(r.overshoot, 0.08);
      EXPECT_LT(r.across_mps, 0.05 * size);
      EXPECT_LT(r.altitude_m, 0.05 * size);
      EXPECT_LT(r.heading_rad, 1.5 * kAutopilotDeg);
      EXPECT_LT(r.tilt_rad, 14.0 * kAutopilotDeg);  // 2 m/s2 are 11.5 deg
    }
  }
}

TEST(Autopilot, ResponseIsIndependentOfHeading) {
  for (const double heading_deg : {22.5, 135.0, -170.0}) {
    SCOPED_TRACE(heading_deg);
    Loop loop = perfect();
    loop.heading_rad = heading_deg * kAutopilotDeg;
    const StepResponse r = step_response(loop, {1.0, 0.0});
    expect_crisp(r);
    EXPECT_LT(r.across_mps, 0.05);
  }
}

TEST(Autopilot, StepResponseIsUnchangedByWind) {
  Loop loop = perfect();
  loop.wind_W = [](double) { return Eigen::Vector3d(-5.0, 0.0, 0.0); };
  for (const Eigen::Vector2d& v : {Eigen::Vector2d(2.0, 0.0), Eigen::Vector2d(-2.0, 0.0), Eigen::Vector2d(0.0, 2.0)}) {
    const StepResponse r = step_response(loop, v);
    expect_crisp(r);
    EXPECT_LT(r.across_mps, 0.3);
    EXPECT_LT(r.altitude_m, 0.3);
  }
}

TEST(Autopilot, FliesVehiclesThatDifferFromItsModel) {
  const auto changed = [](const auto& change) {
    helicopter::HelicopterConfig c;
    change(c);
    return c;
  };
  const helicopter::HelicopterConfig others[] = {
      changed([](helicopter::HelicopterConfig& c) { c.mass.mass_kg *= 1.2; }),
      changed([](helicopter::HelicopterConfig& c) { c.mass.inertia_kgm2 *= 1.4; }),
      changed([](helicopter::HelicopterConfig& c) { c.mass.inertia_kgm2 *= 0.7; }),
      changed([](helicopter::HelicopterConfig& c) {
        std::get<helicopter::LumpedBarConfig>(c.main_rotor.flybar).lateral_gain *= 1.3;
      }),
      changed([](helicopter::HelicopterConfig& c) {
        std::get<helicopter::LumpedBarConfig>(c.main_rotor.flybar).lock_number *= 1.4;
      }),
      changed([](helicopter::HelicopterConfig& c) { c.servos.cyclic.natural_frequency_radps *= 0.8; }),
  };
  for (const helicopter::HelicopterConfig& other : others) {
    SCOPED_TRACE(&other - others);
    Loop loop = perfect();
    loop.vehicle = other;
    loop.designed_for = helicopter::HelicopterConfig();
    const StepResponse r = step_response(loop, {1.0, 1.0});
    EXPECT_LT(r.rise_s, 1.0);
    EXPECT_LT(r.overshoot, 0.25);
    EXPECT_LT(r.across_mps, 0.3);
  }
}

TEST(Autopilot, DesignsItselfForOtherHelicopters) {
  helicopter::HelicopterConfig left;
  left.main_rotor.turns = helicopter::MainRotorConfig::Turns::counter_clockwise;
  helicopter::HelicopterConfig bar;
  bar.main_rotor.flybar = helicopter::ExplicitBarConfig{};
  helicopter::HelicopterConfig heavy;
  heavy.mass.mass_kg = 11.0;
  for (const helicopter::HelicopterConfig& c : {left, bar, heavy}) {
    Loop loop = perfect();
    loop.vehicle = c;
    const StepResponse r = step_response(loop, {1.0, 1.0});
    expect_crisp(r);
    EXPECT_LT(r.across_mps, 0.15);
  }
}

TEST(Autopilot, KeepsClimbAndYawRateLimits) {
  const AutopilotConfig limits;
  const std::vector<Sample> flight = fly(perfect(), 14.0, [](double t_s) {
    return VelocitySetpoint{{0.0, 0.0}, t_s < 1.0 ? 10.0 : 14.0, t_s < 1.0 ? 0.0 : 170.0 * kAutopilotDeg};
  });
  double highest = 0.0;
  for (const Sample& s : flight) {
    EXPECT_LT(-s.v_WB_W().z(), limits.climb_rate_limit_mps * 1.1);
    EXPECT_LT(s.body.w_WB_B.norm(), limits.yaw_rate_limit_radps * 1.1);
    EXPECT_LT(s.v_WB_W().head<2>().norm(), 0.15);
    highest = std::max(highest, -s.body.p_WB.z());
  }
  EXPECT_LT(highest, 14.1);
  EXPECT_NEAR(flight.back().body.p_WB.z(), -14.0, 0.05);
  EXPECT_NEAR(flight.back().rpy()[2], 170.0 * kAutopilotDeg, 1.0 * kAutopilotDeg);
}

TEST(Autopilot, ClampsSpeedSetpoints) {
  const std::vector<Sample> flight = fly(perfect(), 8.0, [](double) {
    return VelocitySetpoint{{6.0, 8.0}, 10.0, 0.0};
  });
  EXPECT_NEAR(flight.back().v_WB_W().x(), 1.8, 0.05);
  EXPECT_NEAR(flight.back().v_WB_W().y(), 2.4, 0.05);
}

TEST(Autopilot, HoldsAttitudeAndHeight) {
  const std::vector<Sample> flight = fly(perfect(), 4.0, [](double) {
    return AttitudeSetpoint{5.0 * kAutopilotDeg, -3.0 * kAutopilotDeg, 0.0, 10.0};
  });
  const HoverModel hover = make_hover_model(helicopter::HelicopterConfig());
  EXPECT_NEAR(flight.back().rpy()[0] - hover.roll_rad, 5.0 * kAutopilotDeg, 1.0 * kAutopilotDeg);
  EXPECT_NEAR(flight.back().rpy()[1] - hover.pitch_rad, -3.0 * kAutopilotDeg, 1.0 * kAutopilotDeg);
  EXPECT_NEAR(flight.back().body.p_WB.z(), -10.0, 0.2);
}

TEST(Autopilot, FliesToAPointAndHoldsIt) {
  const std::vector<Sample> flight = fly(perfect(), 25.0, [](double) {
    return PositionSetpoint{{20.0, -15.0, -12.0}, 1.0};
  });
  double beyond = 0.0;
  for (const Sample& s : flight) {
    beyond = std::max(beyond, (s.body.p_WB.head<2>().dot(Eigen::Vector2d(0.8, -0.6))) - 25.0);
    EXPECT_LT(s.v_WB_W().head<2>().norm(), 3.15);
  }
  EXPECT_LT(beyond, 0.1);
  EXPECT_LT((flight.back().body.p_WB - Eigen::Vector3d(20.0, -15.0, -12.0)).norm(), 0.1);
}

TEST(Autopilot, HoverStopsHoldsPositionAndTurns) {
  const std::vector<Sample> flight = fly(perfect(), 20.0, [](double t_s) {
    return t_s < 4.0 ? Setpoint(VelocitySetpoint{{2.0, 0.0}, 10.0, 0.0}) : Setpoint(HoverSetpoint{0.2});
  });
  const Eigen::Vector3d stopped = flight[800].body.p_WB;
  for (size_t i = 800; i < flight.size(); ++i) EXPECT_LT((flight[i].body.p_WB - stopped).norm(), 0.4);
  EXPECT_NEAR(wrap_angle(flight[1900].rpy()[2] - flight[900].rpy()[2]), 2.0, 0.03);
}

TEST(Autopilot, HoldsTheHoverInTurbulence) {
  Loop loop;
  loop.weather = air::WindConfig{.speed_mps = 5.0, .from_rad = 0.5, .turbulence_w20_mps = 7.7};
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    loop.seed = seed;
    double v2 = 0.0;
    const std::vector<Sample> flight = fly(loop, 60.0, [](double) { return VelocitySetpoint{{0.0, 0.0}, 10.0, 0.0}; });
    for (const Sample& s : flight) {
      v2 += s.v_WB_W().head<2>().squaredNorm();
      if (s.t_s > 3.0) {
        EXPECT_NEAR(s.body.p_WB.z(), -10.0, 0.5);
      }
    }
    EXPECT_LT(std::sqrt(v2 / static_cast<double>(flight.size())), 0.12);
  }
}

TEST(Autopilot, IntegralsDoNotWindUpAtLimits) {
  // For three seconds, a gust accelerates the aircraft more than the tilt limit can counteract. After it, only the
  // velocity error may remain.
  Loop loop = perfect();
  loop.avionics.autopilot.tilt_limit_rad = 6.0 * kAutopilotDeg;
  loop.wind_W = [](double t_s) { return Eigen::Vector3d(t_s > 2.0 && t_s < 5.0 ? -14.0 : 0.0, 0.0, 0.0); };
  const std::vector<Sample> flight = fly(loop, 14.0, [](double) { return VelocitySetpoint{{0.0, 0.0}, 10.0, 0.0}; });
  double blown = 0.0, back = 0.0, late = 0.0;
  for (const Sample& s : flight) {
    const double v = s.v_WB_W().x();
    blown = std::min(blown, v);
    if (s.t_s > 5.0) back = std::max(back, v);
    if (s.t_s > 10.0) late = std::max(late, std::abs(v));
  }
  EXPECT_LT(blown, -1.0);
  EXPECT_LT(back, 0.35 * -blown);
  EXPECT_LT(late, 0.1);
}

TEST(Autopilot, FliesSquaresForAMinuteOnItsOwnSensors) {
  for (const double weather : {0.0, 7.7}) {
    Loop loop;
    loop.weather =
        air::WindConfig{.speed_mps = weather > 0.0 ? 5.0 : 0.0, .from_rad = 2.0, .turbulence_w20_mps = weather};
    const auto v = [](double t_s) {
      const double angle = (static_cast<int>(t_s / 2.5) % 4) * std::numbers::pi / 2.0;
      return Eigen::Vector2d(2.0 * std::cos(angle), 2.0 * std::sin(angle));
    };
    const std::vector<Sample> flight = fly(loop, 60.0, [&](double t_s) { return VelocitySetpoint{v(t_s), 10.0, 0.0}; });
    for (const Sample& s : flight) {
      if (s.t_s > 3.0) {
        ASSERT_NEAR(s.body.p_WB.z(), -10.0, 0.6) << s.t_s;
      }
      ASSERT_LT(s.v_WB_W().head<2>().norm(), 2.6) << s.t_s;
      // In the last half second of a side, the velocity is as commanded.
      if (std::fmod(s.t_s, 2.5) > 2.0) {
        EXPECT_LT((s.v_WB_W().head<2>() - v(s.t_s)).norm(), 0.4) << s.t_s;
      }
    }
  }
}

TEST(HoverModel, MatchesTheVehicleNearItsHover) {
  // Response of the vehicle and of the model to a small step of each actuator.
  const helicopter::HelicopterConfig config;
  const HoverModel model = make_hover_model(config);
  const LinearSystem step = sampled(model.motion, 0.002);
  for (int input = 0; input < kControlAxes; ++input) {
    Vehicle vehicle{VehicleConfig(config)};
    Eigen::Vector4d u = Eigen::Vector4d::Zero();
    u[input] = 1e-4;
    const Controls controls = model.trim + u;
    DesignVector x = DesignVector::Zero(model.motion.A.rows());
    for (int i = 0; i < 250; ++i) {
      vehicle.step(controls, Eigen::Vector3d::Zero(), 0.002);
      x = DesignVector(step.A * x + step.B * u);
    }
    const RigidBodyState& b = vehicle.body();
    const Eigen::Vector3d rpy = to_roll_pitch_heading(b.q_WB);
    Eigen::Matrix<double, 10, 1> truth;
    truth << b.q_WB * b.v_WB_B, rpy[0] - model.roll_rad, rpy[1] - model.pitch_rad, rpy[2], b.w_WB_B, b.p_WB.z();
    const Eigen::Matrix<double, 10, 1> predicted = x.head<10>();
    EXPECT_LT((truth - predicted).norm(), 0.01 * truth.norm()) << "input " << input;
  }
}

TEST(Autopilot, RefusesInvalidConfigs) {
  AutopilotConfig c;
  c.tilt_limit_rad = 0.0;
  EXPECT_THAT([&] { Autopilot(c, helicopter::HelicopterConfig()); },
              testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("autopilot.tilt_limit: ")));
}

}  // namespace
}  // namespace hedgehop::dynamics::control
