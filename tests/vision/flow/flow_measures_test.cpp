#include "vision/flow/flow_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/vision/flow/projected_flow.h"
#include "tests/vision/flow/textured_image.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::vision::flow {
namespace {

const camera::PinholeCamera kCamera = camera::PinholeCamera::from_fov(400, 400, std::numbers::pi / 2);
constexpr double kPeriodS = 0.02;

Eigen::Vector3d random_vector(std::mt19937_64& random, double largest) {
  std::uniform_real_distribution<double> uniform(-largest, largest);
  return {uniform(random), uniform(random), uniform(random)};
}

TEST(ImageJacobian, EqualsFiniteDifferencesOfProjectedPoints) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> pixel(0.0, 399.0), depth(1.0, 30.0);
  camera::PinholeCamera camera = kCamera;
  camera.focal_y_px = 170.0;  // unequal focal lengths and an off-center axis, so that every term matters
  camera.center_u_px = 180.0;
  camera.center_v_px = 215.0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector2d at{pixel(random), pixel(random)};
    const double z = depth(random);
    const Eigen::Vector3d v = random_vector(random, 3.0), w = random_vector(random, 1.0),
                          p_CP = z * camera.ray_at_unit_depth(at);
    Eigen::Matrix<double, 6, 1> twist;
    twist << v, w;
    constexpr double kStepS = 1e-6;
    const auto moved = [&](double t) {
      const Eigen::Matrix3d R = Eigen::AngleAxisd(w.norm() * t, w.normalized()).toRotationMatrix();
      return *camera.project(R.transpose() * (p_CP - v * t));
    };
    const Eigen::Vector2d rate = (moved(kStepS) - moved(-kStepS)) / (2 * kStepS);
    EXPECT_LT((image_jacobian(camera, at, z) * twist - rate).norm(), 1e-4 * (1.0 + rate.norm()));
  }
}

TEST(RotationFlow, EqualsTheMotionOfPixelsOfARotatingCamera) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> pixel(0.0, 399.0);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Vector2d at{pixel(random), pixel(random)};
    const Eigen::Vector3d w = random_vector(random, 2.0);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.rotate(Eigen::AngleAxisd(w.norm() * kPeriodS, w.normalized()));
    const Eigen::Vector2d expected = *kCamera.project(X.inverse() * (7.0 * kCamera.ray_at_unit_depth(at))) - at;
    EXPECT_LT((rotation_flow_px(kCamera, at, w, kPeriodS) - expected).norm(), 1e-9);
  }
}

TEST(Derotate, RemovesPureRotationExactly) {
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d w = random_vector(random, 3.0);
    FlowField field = plane_flow(kCamera, grid_field(16, 16, 60, 400), {0, 0, 5}, {0, 0, 1}, {0, 0, 0}, w, kPeriodS);
    derotate(field, kCamera, w, kPeriodS);
    for (const FlowVector& vector : field.vectors) EXPECT_LT(vector.flow_px.norm(), 1e-9);
  }
}

TEST(Derotate, KeepsTheFlowOfTranslation) {
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d v = random_vector(random, 2.0), w = random_vector(random, 0.5);
    const auto grid = grid_field(16, 16, 60, 400);
    FlowField field = plane_flow(kCamera, grid, {0, 0, 6}, {0.3, -0.2, 1}, v, w, kPeriodS);
    const FlowField still = plane_flow(kCamera, grid, {0, 0, 6}, {0.3, -0.2, 1}, v, {0, 0, 0}, kPeriodS);
    derotate(field, kCamera, w, kPeriodS);
    for (size_t i = 0; i < field.vectors.size(); ++i) {
      // A rotation of w dt = 0.01 rad changes the translational flow by 1 %.
      EXPECT_LT((field.vectors[i].flow_px - still.vectors[i].flow_px).norm(), 0.06);
    }
  }
}

TEST(MeanFlowAndLoom, GiveTheInverseRangeOfAFacingWall) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> range(2.0, 40.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double z = range(random);
    const Eigen::Vector3d v = random_vector(random, 2.0);
    const FlowField field = plane_flow(kCamera, grid_field(16, 16, 60, 400), {0, 0, z}, {0, 0, 1}, v, {0, 0, 0}, 1e-4);
    const FlowAverage Q = mean_horizontal_flow(field, kCamera, 1e-4, Missing::skip);
    const FlowAverage L = loom(field, 1e-4, Missing::skip);
    EXPECT_NEAR(Q.value, -v.x() / z, 1e-3 / z);
    EXPECT_NEAR(L.value, v.z() / z, 1e-3 / z);
    EXPECT_EQ(Q.count, 256);
    EXPECT_EQ(L.count, 256);
  }
}

TEST(MeanFlowAndLoom, EqualTheJacobiansMeanForSlantedWallsAndAnyMotion) {
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d v = random_vector(random, 2.0), w = random_vector(random, 0.5);
    const Eigen::Vector3d normal = Eigen::Vector3d(0, 0, 1) + random_vector(random, 0.4), on_wall(0, 0, 8);
    const auto grid = grid_field(9, 12, 60, 400);
    const FlowField field = plane_flow(kCamera, grid, on_wall, normal, v, w, 1e-5);
    double Q = 0.0, right = 0.0, base = 0.0;
    Eigen::Matrix<double, 6, 1> twist;
    twist << v, w;
    for (const FlowVector& vector : grid.vectors) {
      const double z = normal.dot(on_wall) / normal.dot(kCamera.ray_at_unit_depth(vector.center_px));
      const double rate = (image_jacobian(kCamera, vector.center_px, z) * twist).x();
      const double side = vector.center_px.x() > 199.5 ? 1.0 : -1.0;
      Q += rate / 200.0 / 108.0;
      right += side * rate;
      base += side * vector.center_px.x();
    }
    EXPECT_NEAR(mean_horizontal_flow(field, kCamera, 1e-5, Missing::skip).value, Q, 1e-4);
    EXPECT_NEAR(loom(field, 1e-5, Missing::skip).value, right / base, 1e-4);
  }
}

TEST(Loom, StaysBelowAHundredthUnderPureRotation) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d w = random_vector(random, 0.35);  // up to 20 deg/s about each axis
    const FlowField field =
        plane_flow(kCamera, grid_field(16, 16, 60, 400), {0, 0, 5}, {0, 0, 1}, {0, 0, 0}, w, kPeriodS);
    EXPECT_LT(std::abs(loom(field, kPeriodS, Missing::skip).value), 0.01);
  }
}

TEST(Loom, StaysBelowAHundredthWhenATurningCameraSeesAWall) {
  const WaveTexture texture(8, 0.2, 4.0);
  const std::vector<TexturedPlane> wall = {{{0, 0, 5}, {1, 0, 0}, {0, 1, 0}}};
  const auto view = [&](const Eigen::Vector3d& angles) {
    Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
    if (angles.norm() > 0) X_WC.rotate(Eigen::AngleAxisd(angles.norm(), angles.normalized()));
    return draw_planes(kCamera, X_WC, wall, texture);
  };
  const cv::Mat still = view({0, 0, 0});
  for (const Eigen::Vector3d& w : {Eigen::Vector3d(0, 0.3, 0), {0.3, 0, 0}, {0, 0, 0.4}, {-0.2, -0.2, 0.2}}) {
    ImageInterpolationFlow flow({}, 400, 400);
    flow.update(still);
    const FlowField& field = flow.update(view(w * kPeriodS));
    EXPECT_GT(field.valid_share(), 0.99);
    EXPECT_LT(std::abs(loom(field, kPeriodS, Missing::skip).value), 0.01) << w.transpose();
    EXPECT_NEAR(mean_horizontal_flow(field, kCamera, kPeriodS, Missing::skip).value,
                mean_horizontal_flow(plane_flow(kCamera, field, {0, 0, 5}, {0, 0, 1}, {0, 0, 0}, w, kPeriodS), kCamera,
                                     kPeriodS, Missing::skip)
                    .value,
                0.003);
    FlowField derotated = field;
    derotate(derotated, kCamera, w, kPeriodS);
    EXPECT_LT(std::abs(mean_horizontal_flow(derotated, kCamera, kPeriodS, Missing::skip).value), 0.003);
  }
}

TEST(MeanFlowAndLoom, FollowAnApproachToARenderedWall) {
  const WaveTexture texture(9, 0.2, 4.0);
  const std::vector<TexturedPlane> wall = {{{0, 0, 6}, {1, 0, 0}, {0, 1, 0}}};
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d v(0.8, 0.0, 1.8);
  ImageInterpolationFlow flow({}, 400, 400);
  flow.update(draw_planes(kCamera, X_WC, wall, texture));
  X_WC.translation() = v * kPeriodS;
  const FlowField& field = flow.update(draw_planes(kCamera, X_WC, wall, texture));
  constexpr double kMidRangeM = 6.0 - 0.5 * 1.8 * kPeriodS;
  EXPECT_NEAR(loom(field, kPeriodS, Missing::skip).value, 1.8 / kMidRangeM, 0.01);
  EXPECT_NEAR(mean_horizontal_flow(field, kCamera, kPeriodS, Missing::skip).value, -0.8 / kMidRangeM, 0.003);
}

TEST(MeanFlowAndLoom, InvalidVectorsAreIgnoredOrFarAway) {
  FlowField field = plane_flow(kCamera, grid_field(4, 8, 60, 400), {0, 0, 5}, {0, 0, 1}, {1, 0, 1}, {0, 0, 0}, 1e-4);
  for (int col = 0; col < 8; ++col) field.at(0, col) = {field.at(0, col).center_px, {0, 0}, false};
  field.at(2, 1) = {field.at(2, 1).center_px, {0, 0}, false};
  EXPECT_NEAR(mean_horizontal_flow(field, kCamera, 1e-4, Missing::skip).value, -0.2, 0.01);
  EXPECT_NEAR(mean_horizontal_flow(field, kCamera, 1e-4, Missing::far_away).value, -0.2 * 23 / 32, 0.01);
  // A vector without its mirrored one would turn lateral motion into loom, so the pair is ignored.
  const FlowAverage skipped = loom(field, 1e-4, Missing::skip), far = loom(field, 1e-4, Missing::far_away);
  EXPECT_EQ(skipped.count, 22);
  EXPECT_NEAR(skipped.value, 0.2, 1e-3);
  EXPECT_GT(far.value, 0.2 * 0.6);
  EXPECT_LT(far.value, 0.2 * 0.8);
}

TEST(MeanFlowAndLoom, AreZeroWithoutValidVectors) {
  FlowField field = grid_field(4, 4, 60, 400);
  for (FlowVector& vector : field.vectors) vector.valid = false;
  for (const Missing missing : {Missing::skip, Missing::far_away}) {
    EXPECT_EQ(mean_horizontal_flow(field, kCamera, 0.02, missing).value, 0.0);
    EXPECT_EQ(mean_horizontal_flow(field, kCamera, 0.02, missing).count, 0);
    EXPECT_EQ(loom(field, 0.02, missing).value, 0.0);
    EXPECT_EQ(loom(field, 0.02, missing).count, 0);
  }
}

}  // namespace
}  // namespace hedgehop::vision::flow
