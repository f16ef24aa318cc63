#include "dynamics/hull.h"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/vehicle.h"

namespace hedgehop::dynamics {
namespace {

TEST(Hull, RotorDiscIsAsWideAsTheRotorAndAtItsHub) {
  const HullPart rotor = hull(VehicleConfig{})[0];
  EXPECT_EQ(rotor.shape, HullPart::Shape::cylinder);
  EXPECT_EQ(rotor.center_B_m, Eigen::Vector3d(0.0, 0.0, -0.235));
  EXPECT_EQ(rotor.half_extents_m, Eigen::Vector3d(0.775, 0.775, 0.02));
}

TEST(Hull, FollowsTheVehiclesDimensions) {
  helicopter::HelicopterConfig config;
  config.main_rotor.radius_m = 0.9;
  config.tail_rotor.arm_m = 1.1;
  const std::vector<HullPart> parts = hull(config);
  ASSERT_EQ(parts.size(), 4u);
  EXPECT_EQ(parts[0].half_extents_m.x(), 0.9);
  EXPECT_EQ(parts[3].center_B_m, Eigen::Vector3d(-1.1, 0.0, -0.08));
  EXPECT_EQ(parts[3].half_extents_m, Eigen::Vector3d(0.13, 0.02, 0.13));
}

TEST(Hull, BoomJoinsFuselageAndTailRotor) {
  const std::vector<HullPart> parts = hull(helicopter::HelicopterConfig{});
  const HullPart &fuselage = parts[1], &boom = parts[2], &tail = parts[3];
  EXPECT_NEAR(boom.center_B_m.x() + boom.half_extents_m.x(), fuselage.center_B_m.x() - fuselage.half_extents_m.x(),
              1e-12);
  EXPECT_NEAR(boom.center_B_m.x() - boom.half_extents_m.x(), tail.center_B_m.x(), 1e-12);
  // The front end of the boom touches the back of the fuselage.
  EXPECT_GT(boom.center_B_m.z() - boom.half_extents_m.z(), fuselage.center_B_m.z() - fuselage.half_extents_m.z());
}

TEST(Hull, RadiusContainsEveryCorner) {
  const std::vector<HullPart> parts = hull(helicopter::HelicopterConfig{});
  // The rear edge of the tail rotor has the maximum distance: 0.91 + 0.13 back, 0.02 to the side.
  EXPECT_NEAR(radius_m(parts), std::hypot(1.04, 0.02), 1e-12);
  EXPECT_EQ(radius_m({}), 0.0);
  EXPECT_NEAR(radius_m({parts[0]}), 0.775, 1e-12);
}

TEST(Hull, RefusesAPartWithoutSize) {
  helicopter::HelicopterConfig config;
  config.hull.disc_thickness_m = 0.0;
  EXPECT_THROW(hull(config), std::invalid_argument);
}

}  // namespace
}  // namespace hedgehop::dynamics
