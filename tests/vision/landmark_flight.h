#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "vision/landmark_map.h"

/// The flights of [Shah2009] ch. 4 and 5, seen by a camera that reports the corners of its scene.
namespace hedgehop::vision {

constexpr double kFeet_m = 0.3048, kFrame_s = 0.1;
constexpr double kAltitude_m = 140.0 * kFeet_m;

/// Camera at p_WC that looks at a point, its picture upright.
inline Eigen::Isometry3d looking_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d forward = (target_W - p_WC).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  X_WC.linear() << right, forward.cross(right), forward;
  X_WC.translation() = p_WC;
  return X_WC;
}

/// A flight: where the camera is at a time, and what it flies past.
struct CornerFlight {
  std::vector<Eigen::Vector3d> corners_W;
  std::function<Eigen::Isometry3d(double t_s)> X_WC;
  double duration_s = 100.0;
  PinholeCamera camera = PinholeCamera::from_fov(640, 640, std::numbers::pi / 6.0);
};

/// [Shah2009] table 4.1: 0.36 deg/s on a circle about the object.
inline CornerFlight lateral_flight(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& middle_W) {
  const auto X_WC = [middle_W](double t_s) {
    const double azimuth = std::numbers::pi + 0.36 * std::numbers::pi / 180.0 * t_s;
    const double radius_m = 140.0 * kFeet_m;
    return looking_at({radius_m * std::cos(azimuth), radius_m * std::sin(azimuth), -kAltitude_m}, middle_W);
  };
  return {std::move(corners_W), X_WC};
}

/// [Shah2009] table 5.1: level, 1.4 ft/s towards the scene. The distance of its start is not printed; ours is 120 m.
inline CornerFlight forward_flight(std::vector<Eigen::Vector3d> corners_W) {
  const auto X_WC = [](double t_s) {
    const Eigen::Vector3d p_WC(-120.0 + 1.4 * kFeet_m * t_s, 0.0, -kAltitude_m);
    const double down_rad = 11.0 * std::numbers::pi / 180.0;
    return looking_at(p_WC, p_WC + Eigen::Vector3d(std::cos(down_rad), 0.0, std::sin(down_rad)));
  };
  return {std::move(corners_W), X_WC, 125.0};
}

/// What a flight's map came to.
struct CornerFlightResult {
  std::vector<double> error_percent;  ///< of every picture: mean over all coordinates of all corners
  double converged_s = NAN;           ///< from then on that mean stays within 3 %; NaN when it never does
  size_t landmarks = 0;               ///< confirmed, at the end
  double worst_percent = 0.0;         ///< at the end, of any coordinate of any corner
};

/// Is shown the map after every picture, and which of its landmarks each corner has.
using Watch = std::function<void(double t_s, const LandmarkMap& map, const std::map<size_t, int64_t>& id_of)>;

/// Flies with white errors of the navigation as the filter expects them, and of the corners, 0.5 px.
/// A coordinate's error is a share of the distance from the first camera to the corner.
inline CornerFlightResult fly(const CornerFlight& flight, const LandmarkMapConfig& config, uint64_t seed,
                              const Watch& watch = {}) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto normal3 = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  LandmarkMap map(config, flight.camera);
  std::map<size_t, int64_t> id_of;
  const Eigen::Vector3d first_W = flight.X_WC(0.0).translation();
  CornerFlightResult result;
  for (int picture = 0; picture * kFrame_s <= flight.duration_s; ++picture) {
    const Eigen::Isometry3d X_WC = flight.X_WC(picture * kFrame_s);
    std::vector<Eigen::Vector2d> pixels;
    std::vector<size_t> corner_of;
    for (size_t i = 0; i < flight.corners_W.size(); ++i) {
      const auto pixel = flight.camera.project(X_WC.inverse() * flight.corners_W[i]);
      if (!pixel || (pixel->array() < 0).any() || pixel->x() > flight.camera.width_px - 1 ||
          pixel->y() > flight.camera.height_px - 1) {
        continue;
      }
      pixels.push_back(*pixel + 0.5 * Eigen::Vector2d(normal(random), normal(random)));
      corner_of.push_back(i);
    }
    CameraPose pose{X_WC, config.position_sigma_m, config.attitude_sigma_rad};
    pose.X_WC_est.translation() += config.position_sigma_m * normal3();
    const Eigen::Vector3d turn_C = config.attitude_sigma_rad * normal3();
    pose.X_WC_est.linear() *= Eigen::AngleAxisd(turn_C.norm(), turn_C.normalized()).toRotationMatrix();
    const auto ids = map.update(pixels, pose, picture == 0 ? 0.0 : kFrame_s);
    const auto find = [&](int64_t id) { return std::ranges::find(map.landmarks(), id, &MappedLandmark::id); };
    for (size_t k = 0; k < ids.size(); ++k) {
      // A corner stays with its landmark until that is gone, or another one in its stead is confirmed.
      const auto now = find(ids[k]);
      int64_t& id = id_of.try_emplace(corner_of[k], ids[k]).first->second;
      if (find(id) == map.landmarks().end() || (now != map.landmarks().end() && map.confirmed(*now))) id = ids[k];
    }
    if (watch) watch(picture * kFrame_s, map, id_of);

    double sum = 0.0, worst = 0.0;
    for (size_t i = 0; i < flight.corners_W.size(); ++i) {
      double percent = 100.0;
      if (const auto mapped = find(id_of.contains(i) ? id_of.at(i) : -1); mapped != map.landmarks().end()) {
        const Eigen::Vector3d off = (position_W(mapped->landmark) - flight.corners_W[i]).cwiseAbs();
        const double per_m = 100.0 / (flight.corners_W[i] - first_W).norm();
        percent = per_m * off.mean();
        worst = std::max(worst, per_m * off.maxCoeff());
      }
      sum += percent / static_cast<double>(flight.corners_W.size());
    }
    result.error_percent.push_back(sum);
    result.worst_percent = worst;
    if (sum > 3.0) {
      result.converged_s = NAN;
    } else if (std::isnan(result.converged_s)) {
      result.converged_s = picture * kFrame_s;
    }
  }
  for (const MappedLandmark& mapped : map.landmarks()) result.landmarks += map.confirmed(mapped);
  return result;
}

}  // namespace hedgehop::vision
