#include "sim/loop/aircraft.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/sim/loop/allocations.h"
#include "tests/sim/loop/outdoor_flight.h"

namespace hedgehop::sim {
namespace {

/// Of each kind of vehicle the default, by name.
class EitherKind : public testing::TestWithParam<std::string> {
 protected:
  static dynamics::VehicleConfig vehicle() {
    if (GetParam() == "Helicopter") return dynamics::helicopter::HelicopterConfig{};
    return dynamics::multicopter::MulticopterConfig{};
  }
};
INSTANTIATE_TEST_SUITE_P(Aircraft, EitherKind, testing::Values("Helicopter", "Multicopter"),
                         [](const auto& kind) { return kind.param; });

TEST(Allocations, AreCountedForEveryKindOfRequest) {
  if (!counts_allocations()) GTEST_SKIP() << "the address sanitizer has the allocator";
  const size_t before = allocation_count();
  const auto number = std::make_unique<double>(1.0);
  const Eigen::VectorXd numbers = Eigen::VectorXd::Ones(3 + static_cast<int>(*number));
  EXPECT_EQ(allocation_count() - before, 2u) << numbers.sum();
}

TEST_P(EitherKind, DoesNotAllocateInFlight) {
  if (!counts_allocations()) GTEST_SKIP() << "the address sanitizer has the allocator";
  OutdoorFlight flight(vehicle());
  flight.fly(0.1);
  const Eigen::Vector3d from_W = flight.aircraft().body().p_WB;
  const size_t before = allocation_count();
  flight.fly(12.0);
  EXPECT_EQ(allocation_count() - before, 0u);
  EXPECT_GT((flight.aircraft().body().p_WB - from_W).norm(), 10.0);  // it did fly
}

TEST_P(EitherKind, RangesTheWallAheadOfIt) {
  OutdoorFlight flight(vehicle());
  flight.fly(8.0);
  const Aircraft& aircraft = flight.aircraft();
  // The wall is perpendicular to north and the nose points to it, so the attitude gives the beam's length.
  const Eigen::Vector3d ahead_W = aircraft.body().q_WB * Eigen::Vector3d::UnitX();
  const double distance_m = (OutdoorFlight::kWallNorthM - aircraft.body().p_WB.x()) / ahead_W.x();
  ASSERT_TRUE(aircraft.avionics().range_m());
  const double sigma_m = 0.01 + 0.005 * distance_m, stale_m = 0.03 * 5.0 + 0.02 * distance_m;  // moved and turned since
  EXPECT_NEAR(*aircraft.avionics().range_m(), distance_m, 3.0 * sigma_m + stale_m);
}

}  // namespace
}  // namespace hedgehop::sim
