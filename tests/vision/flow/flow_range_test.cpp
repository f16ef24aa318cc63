#include "vision/flow/flow_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/vision/flow/projected_flow.h"

namespace hedgehop::vision::flow {
namespace {

constexpr double kStepS = 1e-4;
constexpr double kTinyFloorMps = 1e-3;

camera::PinholeCamera camera() { return camera::PinholeCamera::from_fov(400, 400, std::numbers::pi / 2); }

Eigen::Vector3d random_velocity(std::mt19937_64& random) {
  std::uniform_real_distribution<double> speed(-2.0, 2.0);
  return {speed(random), 0.2 * speed(random), speed(random)};
}

TEST(FlowRange, EveryPatchGivesItsDepthOnASlantedWallForAnyMotion) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> slant(-0.8, 0.8), range(2.0, 20.0);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d v_WC_C = random_velocity(random);
    const Eigen::Vector3d on_plane(0, 0, range(random)), normal(slant(random), 0.0, 1.0);
    const FlowField field =
        plane_flow(camera(), grid_field(16, 16, 32, 400), on_plane, normal, v_WC_C, {0, 0, 0}, kStepS);
    for (const FlowVector& vector : field.vectors) {
      const Eigen::Vector3d ray = camera().ray_at_unit_depth(vector.center_px);
      const double depth_m = normal.dot(on_plane) / normal.dot(ray);
      const Eigen::Vector2d b(-v_WC_C.x() + ray.x() * v_WC_C.z(), -v_WC_C.y() + ray.y() * v_WC_C.z());
      if (b.norm() < 0.1 || depth_m < 0.5) continue;  // no measurement around the focus of expansion
      EXPECT_NEAR(inverse_depth_per_m(vector, camera(), v_WC_C, kStepS, kTinyFloorMps), 1.0 / depth_m, 2e-3 / depth_m);
    }
  }
}

TEST(FlowRange, NoiseIsRarelyANearObstacle) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise_px(0.0, 0.05);
  constexpr double kFrameS = 0.02, kFloorMps = 0.2;
  int too_near = 0, all = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector3d v_WC_C = random_velocity(random);
    for (FlowVector vector : grid_field(16, 16, 32, 400).vectors) {  // open space: no flow but noise
      vector.flow_px = {noise_px(random), noise_px(random)};
      ++all;
      too_near += inverse_depth_per_m(vector, camera(), v_WC_C, kFrameS, kFloorMps) > 0.05;
    }
  }
  EXPECT_LT(too_near, 0.01 * all);  // fewer than 1 % of the patches indicate an obstacle within 20 m
}

TEST(FlowRange, FloorScalesTheInverseRangeByTheWeight) {
  std::mt19937_64 random(5);
  constexpr double kFloorMps = 0.4, kRangeM = 3.0;
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d v_WC_C = random_velocity(random);
    const FlowField field =
        plane_flow(camera(), grid_field(8, 8, 32, 400), {0, 0, kRangeM}, {0, 0, 1}, v_WC_C, {0, 0, 0}, kStepS);
    const std::vector<double> weights = parallax_weights(field, camera(), v_WC_C, kFloorMps);
    ASSERT_EQ(weights.size(), field.vectors.size());
    for (size_t i = 0; i < weights.size(); ++i) {
      EXPECT_NEAR(inverse_depth_per_m(field.vectors[i], camera(), v_WC_C, kStepS, kFloorMps), weights[i] / kRangeM,
                  2e-3 / kRangeM);
    }
  }
}

TEST(FlowRange, BearingsAreTheAzimuthsOfThePatchesRays) {
  const FlowField field = grid_field(4, 6, 32, 400);
  const std::vector<double> bearings = bearings_rad(field, camera());
  ASSERT_EQ(bearings.size(), field.vectors.size());
  for (size_t i = 0; i < bearings.size(); ++i) {
    const Eigen::Vector3d ray = camera().ray_at_unit_depth(field.vectors[i].center_px);
    EXPECT_NEAR(bearings[i], std::atan2(ray.x(), ray.z()), 1e-12);
  }
}

TEST(FlowRange, FloorOnlyIncreasesRange) {
  const FlowField field =
      plane_flow(camera(), grid_field(8, 8, 32, 400), {0, 0, 4}, {0, 0, 1}, {1, 0, 1}, {0, 0, 0}, kStepS);
  for (const FlowVector& vector : field.vectors) {
    double last = 1.0 / 4.0 + 1e-3;
    for (const double floor_mps : {0.01, 0.1, 0.3, 1.0, 5.0}) {
      const double near = inverse_depth_per_m(vector, camera(), {1, 0, 1}, kStepS, floor_mps);
      EXPECT_LE(near, last);
      last = near;
    }
  }
}

TEST(FlowRange, NearestTenthDeterminesTheResult) {
  // A wall at 3 m in the two left columns of 16 (an eighth of the view), and one at 50 m in the others.
  const Eigen::Vector3d v_WC_C(1.5, 0, 1.0);
  FlowField field = plane_flow(camera(), grid_field(16, 16, 32, 400), {0, 0, 50}, {0, 0, 1}, v_WC_C, {0, 0, 0}, kStepS);
  const FlowField near =
      plane_flow(camera(), grid_field(16, 16, 32, 400), {0, 0, 3}, {0, 0, 1}, v_WC_C, {0, 0, 0}, kStepS);
  double least_range_m = 1e9, largest_range_m = 0.0;
  for (int row = 0; row < 16; ++row) {
    for (int col = 0; col < 2; ++col) {
      field.at(row, col) = near.at(row, col);
      const double range_m = 3.0 * std::hypot(1.0, camera().ray_at_unit_depth(field.at(row, col).center_px).x());
      least_range_m = std::min(least_range_m, range_m);
      largest_range_m = std::max(largest_range_m, range_m);
    }
  }
  const double measured_per_m =
      nearest_inverse_range_per_m(inverse_ranges_per_m(field, camera(), v_WC_C, kStepS, kTinyFloorMps), 0.1);
  EXPECT_GT(measured_per_m, 0.99 / largest_range_m);
  EXPECT_LT(measured_per_m, 1.01 / least_range_m);
}

TEST(FlowRange, BlankImagesAreFar) {
  FlowField field = grid_field(4, 4, 32, 400);
  for (FlowVector& vector : field.vectors) vector.valid = false;
  EXPECT_EQ(nearest_inverse_range_per_m(inverse_ranges_per_m(field, camera(), {1, 0, 1}, 0.02, 0.2), 0.1), 0.0);
  EXPECT_EQ(nearest_inverse_range_per_m({}, 0.1), 0.0);
}

}  // namespace
}  // namespace hedgehop::vision::flow
