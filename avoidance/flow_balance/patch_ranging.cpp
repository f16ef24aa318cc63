#include "avoidance/flow_balance/patch_ranging.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Of a camera's patches. Fewer follow single wrong vectors; more dilute a narrow obstacle by what lies behind it.
constexpr double kNearestShare = 0.1;
/// From the path's direction. Walls farther aside are passed, not approached.
constexpr double kPathAngleRad = std::numbers::pi / 3;

std::vector<Eigen::Vector2d> patch_directions_H(const CameraFlow& camera, const SideFlow& side) {
  std::vector<Eigen::Vector2d> directions_H;
  for (const double bearing_rad : vision::flow::bearings_rad(camera.field(), camera.pinhole())) {
    directions_H.emplace_back(std::cos(bearing_rad) * side.axis_H + std::sin(bearing_rad) * side.right_H);
  }
  return directions_H;
}

}  // namespace

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
  std::vector<RangeMemory::Measurement> measurements;
  measurements.reserve(weights.size());
  for (size_t i = 0; i < weights.size(); ++i) {
    const double closing_mps = v_WC_C.z() * std::cos(bearings_rad[i]) + v_WC_C.x() * std::sin(bearings_rad[i]);
    measurements.push_back({inverse_ranges_per_m[i], weights[i], closing_mps});
  }
  side.lasting.add(side.memory.update(measurements, dt_s));
  side.weights = weights;
  for (size_t i = 0; i < weights.size(); ++i) side.weights[i] *= camera.field().vectors[i].valid ? 1.0 : 0.0;
  side.cols = camera.field().cols;
}

std::vector<RangeColumn> PatchRanging::columns(size_t side) const {
  constexpr double kNearestRows = 0.25;
  const auto& [memory, lasting, directions_H, weights, cols] = sides_[side];
  std::vector<RangeColumn> columns;
  if (cols == 0) return columns;
  const std::vector<double> lasting_per_m = lasting.lasting_per_m();
  const auto count = static_cast<size_t>(cols), rows = weights.size() / count;
  for (size_t col = 0; col < count; ++col) {
    RangeColumn column{.direction_H = directions_H[col]};
    std::vector<double> near_per_m;
    for (size_t i = col; i < weights.size(); i += count) {
      near_per_m.push_back(lasting_per_m[i]);
      column.weight += weights[i] / static_cast<double>(rows);
    }
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
      const bool on_path = direction_H.dot(approach.v_cmd_H) >= std::cos(kPathAngleRad) * approach.v_cmd_H.norm();
      const double closing_mps = std::max(approach.v_H.dot(direction_H), approach.v_cmd_H.dot(direction_H));
      const double stops_m = stopping_distance_m(closing_mps, closing_mps, approach.stopping);
      left_per_m[patch] = on_path ? inverse_range_left_per_m(left_per_m[patch], stops_m) : 0.0;
    }
    result[i] = vision::flow::nearest_inverse_range_per_m(std::move(left_per_m), kNearestShare);
  }
  return result;
}

}  // namespace hedgehop::avoidance::flow_balance
