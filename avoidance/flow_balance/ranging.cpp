#include "avoidance/flow_balance/ranging.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/heading.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Share of the patches of a camera. A smaller share follows single wrong vectors; a larger one dilutes a narrow
/// obstacle with its background.
constexpr double kNearestShare = 0.1;
/// Maximum angle from the direction of the path. The vehicle passes walls at larger angles.
constexpr double kPathAngleRad = std::numbers::pi / 3;
constexpr double kNotCounted = std::numeric_limits<double>::quiet_NaN();

std::vector<Eigen::Vector2d> patch_directions_H(const CameraFlow& camera, const SideFlow& side) {
  std::vector<Eigen::Vector2d> directions_H;
  for (const double bearing_rad : vision::flow::bearings_rad(camera.field(), camera.pinhole())) {
    directions_H.emplace_back(std::cos(bearing_rad) * side.axis_H + std::sin(bearing_rad) * side.right_H);
  }
  return directions_H;
}

/// Standard deviation of a flow vector per axis, px. Chosen: some hundredths on a plane, more across the edge of a
/// wall.
constexpr double kFlowNoisePx = 0.1;
/// Maximum relative error of the distance of a wall. Chosen: a worse fit may be wrong by a third, so patches replace
/// it.
constexpr double kRelativeError = 0.3;
/// Minimum range of a wall, m; keeps its inverse finite.
constexpr double kMinRangeM = 1e-3;
/// Cosine of the maximum angle between the direction of a wall and the axis of its camera: 45 deg, for four cameras.
constexpr double kSideCosine = 0.5 * std::numbers::sqrt2;

/// Returns whether the vehicle moves away from obstacles in a direction of H.
bool recedes(const Approach& approach, const Eigen::Vector2d& direction_H) {
  constexpr double kRecedesMps = 0.2;  // more than the error of the estimated velocity
  return approach.v_H.dot(direction_H) < -kRecedesMps;
}

vision::flow::WallFlowSample observe(const vision::flow::FlowVector& vector, const CameraFlow& camera,
                                     const Eigen::Vector3d& v_WC_C, double dt_s) {
  const vision::camera::PinholeCamera& lens = camera.pinhole();
  const Eigen::Isometry3d& X_BC = camera.camera().X_BC;
  const Eigen::Vector2d place = lens.ray_at_unit_depth(vector.center_px).head<2>();
  vision::flow::WallFlowSample observation;
  observation.ray_H = X_BC.linear().col(2).head<2>() + place.x() * X_BC.linear().col(0).head<2>();
  observation.p_BC_H = X_BC.translation().head<2>();
  observation.unit_flow = vision::flow::unit_flow(place, v_WC_C);
  observation.flow = vision::flow::flow_per_s(vector, lens, dt_s);
  observation.noise = kFlowNoisePx / (lens.focal_x_px * dt_s);
  return observation;
}

}  // namespace

double stopping_distance_m(double closing_mps, double reversing_mps, const Stopping& stopping) {
  return std::max(0.0, closing_mps) * (stopping.reaction_s + 0.5 * std::abs(reversing_mps) / stopping.braking_mps2);
}

double inverse_range_left_per_m(double inverse_range_per_m, double distance_m) {
  constexpr double kContactPerM = 1e3;  // 1 mm: finer than any range from flow
  const double share_left = 1.0 - inverse_range_per_m * distance_m;
  return inverse_range_per_m < kContactPerM * share_left ? inverse_range_per_m / share_left : kContactPerM;
}

void MeanRanging::update(const SideCameras& cameras, const NavigationState& navigation) {
  const Eigen::Vector2d v_H = velocity_H(navigation);
  for (size_t i = 0; i < kSideCount; ++i) {
    const InverseRanges inverse = inverse_ranges(cameras.flows()[i], v_H);
    nearest_per_m_[i] = std::max(inverse.from_flow_per_m, inverse.from_loom_per_m);
  }
}

const std::vector<double>& RangeMemory::update(std::span<const Measurement> measurements, double dt_s) {
  constexpr double kMinShare = 0.5;  // no range halves from one image to the next
  inverse_ranges_per_m_.resize(measurements.size(), std::numeric_limits<double>::quiet_NaN());
  const double retained = time_constant_s_ > 0.0 ? std::exp(-dt_s / time_constant_s_) : 0.0;
  for (size_t i = 0; i < measurements.size(); ++i) {
    const Measurement& measured = measurements[i];
    double& inverse_per_m = inverse_ranges_per_m_[i];
    const double share_left =
        1.0 - inverse_per_m * measured.closing_mps * dt_s;  // remaining share of the range after this step
    const double expected = retained * inverse_per_m / (share_left > kMinShare ? share_left : kMinShare);
    if (std::isnan(measured.inverse_range_per_m)) {
      inverse_per_m = retained > 0.0 ? expected : measured.inverse_range_per_m;
    } else {
      inverse_per_m = std::isnan(expected) ? measured.inverse_range_per_m
                                           : measured.inverse_range_per_m + (1.0 - measured.weight) * expected;
    }
  }
  return inverse_ranges_per_m_;
}

void LastingRanges::add(std::vector<double> inverse_ranges_per_m) {
  latest_[next_] = std::move(inverse_ranges_per_m);
  next_ = (next_ + 1) % latest_.size();
}

std::vector<double> LastingRanges::lasting_per_m() const {
  std::vector<double> least(latest_.front().size(), std::numeric_limits<double>::infinity());
  std::vector<size_t> known(least.size(), 0);
  for (const std::vector<double>& image : latest_) {
    for (size_t i = 0; i < image.size(); ++i) {
      if (std::isnan(image[i])) continue;
      least[i] = std::min(least[i], image[i]);
      ++known[i];
    }
  }
  for (size_t i = 0; i < least.size(); ++i) {
    if (2 * known[i] <= latest_.size()) least[i] = 0.0;
  }
  return least;
}

PatchRanging::PatchRanging(const Options& options)
    : options_(options),
      sides_(kSideCount, Side{RangeMemory(options.memory_s), LastingRanges(options.images), {}, {}, 0}) {}

void PatchRanging::update(const SideCameras& cameras, const NavigationState& navigation) {
  for (size_t i = 0; i < kSideCount; ++i) {
    Side& side = sides_[i];
    if (side.directions_H.empty()) side.directions_H = patch_directions_H(cameras.cameras()[i], cameras.flows()[i]);
    nearest_per_m_[i] = 0.0;
    const auto& measure = cameras.measure(i);
    if (!measure) continue;
    if (cameras.fresh(i)) add_image(cameras.cameras()[i], navigation, measure->dt_s, side);
    nearest_per_m_[i] = vision::flow::nearest_inverse_range_per_m(side.lasting.lasting_per_m(), kNearestShare);
  }
}

void PatchRanging::add_image(const CameraFlow& camera, const NavigationState& navigation, double dt_s,
                             Side& side) const {
  const vision::camera::PinholeCamera& lens = camera.pinhole();
  const Eigen::Vector3d v_WC_C = velocity_in_camera(camera.camera().X_BC, navigation);
  const std::vector<double> inverse_ranges_per_m =
      vision::flow::inverse_ranges_per_m(camera.field(), lens, v_WC_C, dt_s, options_.floor_mps);
  const std::vector<double> weights = vision::flow::parallax_weights(camera.field(), lens, v_WC_C, options_.floor_mps);
  const std::vector<double> bearings_rad = vision::flow::bearings_rad(camera.field(), lens);
  const Eigen::Vector3d down_C =
      camera.camera().X_BC.linear().transpose() * (navigation.q_WB_est.conjugate() * Eigen::Vector3d::UnitZ());
  side.weights.assign(weights.size(), kNotCounted);
  std::vector<RangeMemory::Measurement> measurements;
  measurements.reserve(weights.size());
  for (size_t i = 0; i < weights.size(); ++i) {
    const vision::flow::FlowVector& vector = camera.field().vectors[i];
    const double sine_below = lens.ray_at_unit_depth(vector.center_px).normalized().dot(down_C);
    const bool counts = sine_below >= -std::sin(options_.max_elevation_rad);
    const double closing_mps = v_WC_C.z() * std::cos(bearings_rad[i]) + v_WC_C.x() * std::sin(bearings_rad[i]);
    measurements.push_back({counts ? inverse_ranges_per_m[i] : kNotCounted, weights[i], closing_mps});
    if (counts) side.weights[i] = vector.valid ? weights[i] : 0.0;
  }
  side.lasting.add(side.memory.update(measurements, dt_s));
  side.cols = camera.field().cols;
}

std::vector<RangeColumn> PatchRanging::columns(size_t side) const {
  constexpr double kNearestRows = 0.25;
  const auto& [memory, lasting, directions_H, weights, cols] = sides_[side];
  std::vector<RangeColumn> columns;
  if (cols == 0) return columns;
  const std::vector<double> lasting_per_m = lasting.lasting_per_m();
  const auto count = static_cast<size_t>(cols);
  for (size_t col = 0; col < count; ++col) {
    RangeColumn column{.direction_H = directions_H[col]};
    std::vector<double> near_per_m, counting;
    for (size_t i = col; i < weights.size(); i += count) {
      if (std::isnan(weights[i])) continue;
      near_per_m.push_back(lasting_per_m[i]);
      counting.push_back(weights[i]);
    }
    for (const double weight : counting) column.weight += weight / static_cast<double>(counting.size());
    column.inverse_range_per_m = vision::flow::nearest_inverse_range_per_m(std::move(near_per_m), kNearestRows);
    columns.push_back(column);
  }
  return columns;
}

PerSide PatchRanging::left_once_stopped_per_m(const Approach& approach) const {
  PerSide result{};
  for (size_t i = 0; i < kSideCount; ++i) {
    std::vector<double> left_per_m = sides_[i].lasting.lasting_per_m();
    for (size_t patch = 0; patch < left_per_m.size(); ++patch) {
      const Eigen::Vector2d& direction_H = sides_[i].directions_H[patch];
      const bool on_path = direction_H.dot(approach.v_cmd_H) >= std::cos(kPathAngleRad) * approach.v_cmd_H.norm() &&
                           !recedes(approach, direction_H);
      const double closing_mps = std::max(approach.v_H.dot(direction_H), approach.v_cmd_H.dot(direction_H));
      const double stops_m = stopping_distance_m(closing_mps, closing_mps, approach.stopping);
      left_per_m[patch] = on_path ? inverse_range_left_per_m(left_per_m[patch], stops_m) : 0.0;
    }
    result[i] = vision::flow::nearest_inverse_range_per_m(std::move(left_per_m), kNearestShare);
  }
  return result;
}

std::vector<vision::flow::WallEstimate> fit_walls(std::span<const CameraFlow> cameras,
                                                  const NavigationState& navigation, int64_t now_ns) {
  using std::numbers::pi;
  std::vector<std::pair<double, vision::flow::WallFlowSample>> by_bearing;
  for (const CameraFlow& camera : cameras) {
    const auto measure = camera.measure(now_ns);
    if (!measure) continue;
    const Eigen::Vector3d v_WC_C = velocity_in_camera(camera.camera().X_BC, navigation);
    for (const vision::flow::FlowVector& vector : camera.field().vectors) {
      if (!vector.valid) continue;
      const vision::flow::WallFlowSample observation = observe(vector, camera, v_WC_C, measure->dt_s);
      // Counted from a direction between the rear and the left camera, so that no image is split.
      const double bearing_rad =
          std::fmod(std::atan2(observation.ray_H.y(), observation.ray_H.x()) + 2.75 * pi, 2.0 * pi);
      by_bearing.emplace_back(bearing_rad, observation);
    }
  }
  std::ranges::stable_sort(by_bearing, {}, [](const auto& item) { return item.first; });
  std::vector<vision::flow::WallFlowSample> observations;
  for (const auto& [bearing_rad, observation] : by_bearing) observations.push_back(observation);
  return vision::flow::walls_from_flow(observations, kRelativeError);
}

void WallRanging::update(const SideCameras& cameras, const NavigationState& navigation) {
  patches_.update(cameras, navigation);
  axes_H_ = cameras.axes_H();
  walls_ = fit_walls(cameras.cameras(), navigation, cameras.now_ns());
}

PerSide WallRanging::left_once_stopped_per_m(const Approach& approach) const {
  if (walls_.empty()) return patches_.left_once_stopped_per_m(approach);
  PerSide result{};
  for (size_t i = 0; i < kSideCount; ++i) result[i] = left_on_side_per_m(axes_H_[i], approach);
  return result;
}

double WallRanging::left_on_side_per_m(const Eigen::Vector2d& axis_H, const Approach& approach) const {
  double nearest_per_m = 0.0;
  for (const vision::flow::WallEstimate& wall : walls_) {
    const Eigen::Vector2d to_wall_H = wall.inverse_range_per_m.normalized();
    if (to_wall_H.dot(axis_H) < kSideCosine) continue;  // on another side
    if (approach.v_cmd_H.dot(to_wall_H) <= 0.0 || recedes(approach, to_wall_H)) continue;
    const double closing_mps = std::max(approach.v_H.dot(to_wall_H), approach.v_cmd_H.dot(to_wall_H));
    const double tail_m = approach.tail_m * std::max(0.0, -to_wall_H.x());
    const double range_m = std::max(1.0 / wall.inverse_range_per_m.norm() - tail_m, kMinRangeM);
    const double reversing_mps =
        approach.reverses_both ? std::max(approach.v_H.norm(), approach.v_cmd_H.norm()) : closing_mps;
    const double stops_m = stopping_distance_m(closing_mps, reversing_mps, approach.stopping);
    nearest_per_m = std::max(nearest_per_m, inverse_range_left_per_m(1.0 / range_m, stops_m));
  }
  return nearest_per_m;
}

}  // namespace hedgehop::avoidance::flow_balance
