#include "sim/mavlink/obstacle_sectors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace hedgehop::sim::mavlink {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity(), kDeg = std::numbers::pi / 180.0;
constexpr double kFloatDepthM = 1e-3;  // depth images are single precision

using vision::camera::Camera;
using vision::camera::PinholeCamera;

struct Sphere {
  Eigen::Vector3d center_W;
  double radius_m;
};

/// Returns the distance along a ray of length 1 to the spheres and to the ground plane `ground_z`, or infinity.
double ray_length_m(const Eigen::Vector3d& from_W, const Eigen::Vector3d& ray_W, const std::vector<Sphere>& spheres,
                    double ground_z) {
  double nearest = ray_W.z() > 0.0 ? (ground_z - from_W.z()) / ray_W.z() : kInf;
  for (const Sphere& sphere : spheres) {
    const Eigen::Vector3d to_center = sphere.center_W - from_W;
    const double along = to_center.dot(ray_W);
    const double inside = sphere.radius_m * sphere.radius_m - (to_center.squaredNorm() - along * along);
    if (inside >= 0.0 && along > std::sqrt(inside)) nearest = std::min(nearest, along - std::sqrt(inside));
  }
  return nearest;
}

Eigen::Isometry3d forward_camera(double yaw_rad) {
  Eigen::Matrix3d R_BC;
  R_BC << 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0;  // x_C = y_B, y_C = z_B, z_C = x_B
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * R_BC;
  X_BC.translation() = Eigen::Vector3d(0.3, -0.1, 0.2);
  return X_BC;
}

Eigen::Quaterniond attitude(double roll_rad, double pitch_rad, double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

/// Traces every pixel of a pinhole in W.
struct TracedView {
  PinholeCamera camera = PinholeCamera::from_fov(160, 120, 90.0 * kDeg);
  Eigen::Isometry3d X_BC = forward_camera(0.0);
  Eigen::Vector3d p_WB{10.0, -4.0, -5.0};
  Eigen::Quaterniond q_WB = attitude(0.1, -0.15, 2.0);
  std::vector<Sphere> spheres;
  double ground_z = 0.0;

  cv::Mat depth_m() const {
    cv::Mat depth(camera.height_px, camera.width_px, CV_32FC1);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        const Eigen::Vector3d ray_C = camera.ray_at_unit_depth({u, v}).normalized();
        const Eigen::Vector3d ray_W = q_WB * (X_BC.linear() * ray_C);
        depth.at<float>(v, u) =
            static_cast<float>(ray_length_m(p_WB + q_WB * X_BC.translation(), ray_W, spheres, ground_z) * ray_C.z());
      }
    }
    return depth;
  }
};

/// The sectors by the traced points in W: their bearing from the nose, their height and their horizontal distance.
struct BruteForce {
  std::array<double, 72> nearest_m;
  std::array<bool, 72> free{};

  BruteForce(const TracedView& view, const SectorLimits& limits) {
    nearest_m.fill(kInf);
    const Eigen::Vector3d nose_W = view.q_WB * Eigen::Vector3d::UnitX(),
                          from_W = view.p_WB + view.q_WB * view.X_BC.translation();
    const double heading = std::atan2(nose_W.y(), nose_W.x());
    const auto sector_of = [&](const Eigen::Vector3d& p_W) {
      double degrees = (std::atan2(p_W.y() - view.p_WB.y(), p_W.x() - view.p_WB.x()) - heading) / kDeg;
      while (degrees < -2.5) degrees += 360.0;
      while (degrees >= 357.5) degrees -= 360.0;
      return static_cast<size_t>((degrees + 2.5) / 5.0);
    };
    const auto in_band = [&](const Eigen::Vector3d& p_W) {
      return p_W.z() >= view.p_WB.z() - limits.above_m && p_W.z() <= view.p_WB.z() + limits.below_m;
    };
    for (int v = 0; v < view.camera.height_px; ++v) {
      for (int u = 0; u < view.camera.width_px; ++u) {
        const Eigen::Vector3d ray_W =
            view.q_WB * (view.X_BC.linear() * view.camera.ray_at_unit_depth({u, v}).normalized());
        const double length_m = ray_length_m(from_W, ray_W, view.spheres, view.ground_z);
        const Eigen::Vector3d end_W = from_W + std::min(length_m, 1e6) * ray_W;
        const double range_m = (end_W - view.p_WB).head<2>().norm();
        if (range_m <= limits.max_m) {
          if (in_band(end_W) && range_m >= limits.min_m) {
            double& nearest = nearest_m[sector_of(end_W)];
            nearest = std::min(nearest, range_m);
          }
          continue;
        }
        // March to the maximum range.
        double low = 0.0, high = std::min(length_m, 1e6);
        for (int i = 0; i < 80; ++i) {
          const double middle = 0.5 * (low + high);
          ((from_W + middle * ray_W - view.p_WB).head<2>().norm() < limits.max_m ? low : high) = middle;
        }
        const Eigen::Vector3d at_max_W = from_W + low * ray_W;
        if (in_band(at_max_W)) free[sector_of(at_max_W)] = true;
      }
    }
  }
};

TEST(ObstacleSectors, AreTheNearestTracedPointsOfTheirBearings) {
  std::mt19937_64 random(3);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1'000'000) / 1e6;
  };
  const SectorLimits limits{1.0, 0.8, 0.5, 15.0};
  int obstacles = 0, free = 0, unseen = 0;
  for (int scene = 0; scene < 6; ++scene) {
    TracedView view;
    view.X_BC = forward_camera(uniform(-180.0, 180.0) * kDeg);
    view.q_WB = attitude(uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-3.0, 3.0));
    for (int i = 0; i < 12; ++i) {
      view.spheres.push_back({view.p_WB + Eigen::Vector3d(uniform(-14, 14), uniform(-14, 14), uniform(-2, 2)), 0.5});
    }
    const ObstacleSectors sectors = DepthToSectors(view.camera, view.X_BC, limits).sectors(view.depth_m(), view.q_WB);
    const BruteForce expected(view, limits);
    int differences = 0;  // points on the limit of a sector or of the band may fall on either side of it
    for (int i = 0; i < ObstacleSectors::kCount; ++i) {
      const double nearest_m = expected.nearest_m[static_cast<size_t>(i)];
      const bool is_free = expected.free[static_cast<size_t>(i)];
      const bool same = std::isinf(nearest_m)
                            ? std::isinf(sectors.at(i).nearest_m) && sectors.at(i).seen == is_free
                            : sectors.at(i).seen && std::abs(sectors.at(i).nearest_m - nearest_m) < kFloatDepthM;
      differences += same ? 0 : 1;
      obstacles += std::isfinite(nearest_m) ? 1 : 0;
      free += std::isinf(nearest_m) && is_free ? 1 : 0;
      unseen += std::isinf(nearest_m) && !is_free ? 1 : 0;
    }
    EXPECT_LE(differences, 1) << "scene " << scene;
  }
  EXPECT_GT(obstacles, 15);
  EXPECT_GT(free, 15);
  EXPECT_GT(unseen, 150);
}

TEST(ObstacleSectors, CountClockwiseFromTheNose) {
  TracedView view;
  view.q_WB = attitude(0.0, 0.0, 1.0);
  view.X_BC = forward_camera(0.0);
  view.X_BC.translation().setZero();
  const auto sectors_with_sphere_at = [&](double bearing_deg) {
    const double azimuth = 1.0 + bearing_deg * kDeg;
    view.spheres = {{view.p_WB + 8.0 * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0), 0.2}};
    return DepthToSectors(view.camera, view.X_BC, {}).sectors(view.depth_m(), view.q_WB);
  };
  EXPECT_NEAR(sectors_with_sphere_at(0.0).at(0).nearest_m, 7.8, 0.05);
  EXPECT_NEAR(sectors_with_sphere_at(20.0).at(4).nearest_m, 7.8, 0.05);    // to the right
  EXPECT_NEAR(sectors_with_sphere_at(-20.0).at(68).nearest_m, 7.8, 0.05);  // to the left
}

TEST(ObstacleSectors, AreUnknownWithoutACameraAndWithUnknownDepth) {
  TracedView view;
  view.q_WB = attitude(0.0, 0.0, 0.0);
  const DepthToSectors to_sectors(view.camera, view.X_BC, {});
  const ObstacleSectors of_sky = to_sectors.sectors(view.depth_m(), view.q_WB);
  EXPECT_TRUE(of_sky.at(0).seen);
  EXPECT_FALSE(of_sky.at(36).seen) << "no camera looks back";
  const cv::Mat unknown(view.camera.height_px, view.camera.width_px, CV_32FC1,
                        cv::Scalar(std::numeric_limits<double>::quiet_NaN()));
  const ObstacleSectors sectors = to_sectors.sectors(unknown, view.q_WB);
  for (int i = 0; i < ObstacleSectors::kCount; ++i) EXPECT_FALSE(sectors.at(i).seen) << i;
}

TEST(ObstacleSectors, OfTwoCamerasKeepTheNearerObstacle) {
  ObstacleSectors a, b;
  a.add_obstacle(5.0, 0.0, 5.0);
  b.add_obstacle(3.0, 0.0, 3.0);
  b.add_free(0.0, -9.0);
  a.merge(b);
  EXPECT_EQ(a.at(0).nearest_m, 3.0);
  EXPECT_TRUE(a.at(54).seen);
  EXPECT_TRUE(std::isinf(a.at(54).nearest_m));
  EXPECT_FALSE(a.at(18).seen);
}

TEST(ObstacleSectors, ReadTheRangesOfAFisheye) {
  const vision::camera::Camera fisheye(200, 200, vision::camera::FisheyeLens{60.0, 60.0, 99.5, 99.5});
  cv::Mat range_m(200, 200, CV_32FC1, cv::Scalar(6.0));  // a sphere around the camera
  Eigen::Isometry3d X_BC = forward_camera(0.0);
  X_BC.translation().setZero();
  const ObstacleSectors sectors =
      DepthToSectors(fisheye, X_BC, {0.1, 0.1, 0.2, 20.0}).sectors(range_m, Eigen::Quaterniond::Identity());
  for (const int sector : {0, 6, 12, 60, 66}) EXPECT_NEAR(sectors.at(sector).nearest_m, 6.0, 0.01) << sector;
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
