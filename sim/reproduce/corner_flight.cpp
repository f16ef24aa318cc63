#include "sim/reproduce/corner_flight.h"

#include <algorithm>
#include <chrono>
#include <numbers>
#include <utility>

#include "scenes/worlds/highrise.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

using vision::landmarks::LandmarkMap;
using vision::landmarks::MappedLandmark;

constexpr double kFeetM = 0.3048, kImageS = 0.1, kConvergedPercent = 3.0;
constexpr double kAltitudeM = 140.0 * kFeetM;
constexpr double kCornerPx = 0.5;  // standard deviation of a corner's pixel

CornerFlight lateral(std::vector<Eigen::Vector3d> corners_W, const Eigen::Vector3d& middle_W) {
  CornerFlight flight;
  flight.corners_W = std::move(corners_W);
  flight.camera = vision::camera::PinholeCamera::from_fov(640, 640, std::numbers::pi / 6.0);
  flight.X_WC = [middle_W](double t_s) {
    const double azimuth = std::numbers::pi + 0.36 * std::numbers::pi / 180.0 * t_s;
    const double radius_m = 140.0 * kFeetM;
    return looking_at({radius_m * std::cos(azimuth), radius_m * std::sin(azimuth), -kAltitudeM}, middle_W);
  };
  return flight;
}

/// White noise of a flight.
class Noise {
 public:
  explicit Noise(uint64_t seed) : stream_(seed) {}
  Eigen::Vector2d pixel(double sigma_px) {
    const double right = stream_.normal();
    return sigma_px * Eigen::Vector2d(right, stream_.normal());
  }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = stream_.normal();
    return v;
  }

 private:
  RandomStream stream_;
};

/// Which landmark each corner has: it stays with one until that is gone, or another one in its stead is confirmed.
void follow(const LandmarkMap& map, const std::vector<size_t>& corner_of, const std::vector<int64_t>& ids,
            std::map<size_t, int64_t>& id_of_corner) {
  const auto find = [&](int64_t id) { return std::ranges::find(map.landmarks(), id, &MappedLandmark::id); };
  for (size_t k = 0; k < ids.size(); ++k) {
    const auto now = find(ids[k]);
    int64_t& id = id_of_corner.try_emplace(corner_of[k], ids[k]).first->second;
    if (find(id) == map.landmarks().end() || (now != map.landmarks().end() && map.confirmed(*now))) id = ids[k];
  }
}

/// Corners in one image: pixels with noise, and the index of each one's corner.
struct ObservedCorners {
  std::vector<Eigen::Vector2d> pixels;
  std::vector<size_t> corner_of;
};
ObservedCorners observe_corners(const CornerFlight& flight, const Eigen::Isometry3d& X_WC, Noise& noise) {
  ObservedCorners observed;
  for (size_t i = 0; i < flight.corners_W.size(); ++i) {
    const auto pixel = flight.camera.project(X_WC.inverse() * flight.corners_W[i]);
    if (!pixel || (pixel->array() < 0).any() || pixel->x() > flight.camera.width_px - 1 ||
        pixel->y() > flight.camera.height_px - 1) {
      continue;
    }
    observed.pixels.push_back(*pixel + noise.pixel(kCornerPx));
    observed.corner_of.push_back(i);
  }
  return observed;
}

vision::landmarks::CameraPose estimate_pose(const Eigen::Isometry3d& X_WC,
                                            const vision::landmarks::LandmarkMapConfig& config, Noise& noise) {
  vision::landmarks::CameraPose pose{X_WC, config.position_sigma_m, config.attitude_sigma_rad};
  pose.X_WC_est.translation() += config.position_sigma_m * noise.vector();
  const Eigen::Vector3d turn_C = config.attitude_sigma_rad * noise.vector();
  pose.X_WC_est.linear() *= Eigen::AngleAxisd(turn_C.norm(), turn_C.normalized()).toRotationMatrix();
  return pose;
}

/// Returns the mean error of the corners' coordinates, % of the distance from the first camera; 100 for a corner
/// without a landmark.
double mean_error_percent(const LandmarkMap& map, const std::vector<Eigen::Vector3d>& corners_W,
                          const std::map<size_t, int64_t>& id_of_corner, const Eigen::Vector3d& first_W) {
  double mean_percent = 0.0;
  for (size_t i = 0; i < corners_W.size(); ++i) {
    double percent = 100.0;
    const auto id = id_of_corner.find(i);
    const auto mapped =
        std::ranges::find(map.landmarks(), id == id_of_corner.end() ? -1 : id->second, &MappedLandmark::id);
    if (mapped != map.landmarks().end()) {
      const Eigen::Vector3d off = (position_W(mapped->landmark) - corners_W[i]).cwiseAbs();
      const double per_m = 100.0 / (corners_W[i] - first_W).norm();
      percent = per_m * off.mean();
    }
    mean_percent += percent / static_cast<double>(corners_W.size());
  }
  return mean_percent;
}

}  // namespace

Eigen::Isometry3d looking_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W) {
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d forward = (target_W - p_WC).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(forward).normalized();
  X_WC.linear() << right, forward.cross(right), forward;
  X_WC.translation() = p_WC;
  return X_WC;
}

CornerFlight cube_lateral_flight() {
  return lateral(scenes::worlds::highrise_corners({.layout = scenes::worlds::HighriseConfig::Layout::cube}, 1),
                 {0, 0, -9});
}

CornerFlight highrise_lateral_flight() {
  return lateral(scenes::worlds::highrise_corners({.scale = 0.5}, 1), {0, 0, -7});
}

CornerFlight highrise_forward_flight() {
  CornerFlight flight = lateral(scenes::worlds::highrise_corners({}, 1), {0, 0, 0});
  flight.duration_s = 125.0;
  flight.X_WC = [](double t_s) {
    const Eigen::Vector3d p_WC(-120.0 + 1.4 * kFeetM * t_s, 0.0, -kAltitudeM);
    const double down_rad = 11.0 * std::numbers::pi / 180.0;
    return looking_at(p_WC, p_WC + Eigen::Vector3d(std::cos(down_rad), 0.0, std::sin(down_rad)));
  };
  return flight;
}

CornerFlightResult fly_past_corners(const CornerFlight& flight, const vision::landmarks::LandmarkMapConfig& config,
                                    uint64_t seed, const WatchMap& watch) {
  Noise noise(seed);
  LandmarkMap map(config, flight.camera);
  std::map<size_t, int64_t> id_of_corner;
  const Eigen::Vector3d first_W = flight.X_WC(0.0).translation();
  CornerFlightResult result;
  for (int image = 0; image * kImageS <= flight.duration_s; ++image) {
    const double t_s = image * kImageS;
    const Eigen::Isometry3d X_WC = flight.X_WC(t_s);
    const ObservedCorners observed = observe_corners(flight, X_WC, noise);
    const vision::landmarks::CameraPose pose = estimate_pose(X_WC, config, noise);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<int64_t> ids = map.update(observed.pixels, pose, image == 0 ? 0.0 : kImageS);
    const std::chrono::duration<double, std::milli> cost = std::chrono::steady_clock::now() - start;
    result.filter_ms.push_back(cost.count());
    follow(map, observed.corner_of, ids, id_of_corner);
    if (watch) watch(t_s, map, id_of_corner);

    const double error_percent = mean_error_percent(map, flight.corners_W, id_of_corner, first_W);
    result.error_percent.push_back(error_percent);
    if (error_percent > kConvergedPercent) {
      result.converged_s = NAN;
    } else if (std::isnan(result.converged_s)) {
      result.converged_s = t_s;
    }
  }
  result.landmarks =
      static_cast<size_t>(std::ranges::count_if(map.landmarks(), [&](const auto& m) { return map.confirmed(m); }));
  return result;
}

}  // namespace hedgehop::sim
