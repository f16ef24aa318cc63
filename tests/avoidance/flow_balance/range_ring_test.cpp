#include "avoidance/flow_balance/range_ring.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace hedgehop::avoidance::flow_balance {
namespace {

using Eigen::Vector2d;

constexpr int64_t kTenthNs = 100'000'000;
constexpr double kTenthS = 0.1;

Vector2d nearest(const std::vector<Vector2d>& places_W) {
  return *std::ranges::min_element(places_W, {}, [](const Vector2d& p) { return p.norm(); });
}

RangeColumn column_at(const Vector2d& p_BP_H, double weight = 1.0) {
  return {.direction_H = p_BP_H.normalized(), .inverse_range_per_m = 1.0 / p_BP_H.norm(), .weight = weight};
}

TEST(RangeRing, CarriesAPlaceThatNoCameraSeesAnyMoreAsTheVehicleMoves) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> meters(-20.0, 20.0), mps(-3.0, 3.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector2d p_WP(meters(random), meters(random));
    RangeRing ring;
    ring.carry({0.0, 0.0}, 0);
    ring.add({column_at(p_WP)}, 0.0);
    Vector2d p_WB(0.0, 0.0);
    for (int step = 1; step <= 20; ++step) {
      const Vector2d v_W(mps(random), mps(random));
      p_WB += kTenthS * v_W;
      ring.carry(v_W, step * kTenthNs);
    }
    ASSERT_EQ(ring.places_W().size(), 1u);
    EXPECT_LT((ring.places_W()[0] - (p_WP - p_WB)).norm(), 1e-9);
  }
}

TEST(RangeRing, ForgetsAPlaceThatWasNotSeenForLong) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0);
  ring.carry({0.0, 0.0}, RangeRing::kKeepNs);
  EXPECT_EQ(ring.places_W().size(), 1u);
  ring.carry({0.0, 0.0}, RangeRing::kKeepNs + 1);
  EXPECT_TRUE(ring.places_W().empty());
}

TEST(RangeRing, BelievesAColumnThatShowsParallaxAndDoubtsOneThatShowsNone) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({5.0, 0.0})}, 0.0);
  ring.add({{.direction_H = {1.0, 0.0}, .inverse_range_per_m = 0.0, .weight = 0.1}}, 0.0);
  ASSERT_EQ(ring.places_W().size(), 1u) << "no parallax: nothing measured is not nothing there";
  ring.add({column_at({9.0, 0.0}, /*weight=*/0.1)}, 0.0);
  EXPECT_DOUBLE_EQ(nearest(ring.places_W()).norm(), 5.0);
  ring.add({column_at({9.0, 0.0})}, 0.0);
  EXPECT_DOUBLE_EQ(nearest(ring.places_W()).norm(), 9.0);
  ring.add({{.direction_H = {1.0, 0.0}, .inverse_range_per_m = 0.0, .weight = 1.0}}, 0.0);
  EXPECT_TRUE(ring.places_W().empty());
}

TEST(RangeRing, PutsColumnsWhereTheHeadingHasThem) {
  RangeRing ring;
  ring.carry({0.0, 0.0}, 0);
  ring.add({column_at({0.0, 6.0})}, M_PI / 4);  // right of a nose that points north-east
  EXPECT_LT((nearest(ring.places_W()) - 6.0 * Vector2d(-std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-12);
}

}  // namespace
}  // namespace hedgehop::avoidance::flow_balance
