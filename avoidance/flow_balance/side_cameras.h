#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <span>
#include <vector>

#include "avoidance/camera_flow.h"
#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/module.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::avoidance::flow_balance {

inline constexpr size_t kSideCount = 4;
inline constexpr std::array<const char*, kSideCount> kSideRoles = {"left", "right", "front", "rear"};

/// Level parts of the optical axes in H, in the order of kSideRoles.
using SideAxes = std::array<Eigen::Vector2d, kSideCount>;

/// Flow and loom of four level cameras that look to the left, right, front and rear. Both modules of this folder use
/// it. Tilt is neglected: the camera axes are assumed level as they are mounted in B.
class SideCameras {
 public:
  /// Cameras that a module with SideCameras requires.
  static Needs needs();
  /// Columns of signal_values().
  static std::vector<Signal> signals();

  /// @param setup  with a camera for each role. Throws as CameraFlow does.
  SideCameras(const Setup& setup, const vision::flow::ImageInterpolationConfig& flow, bool derotate);

  /// Adds the newest images.
  void update(const Observation& observation);

  /// In the order of kSideRoles.
  std::span<const CameraFlow> cameras() const { return cameras_; }
  const SideAxes& axes_H() const { return axes_H_; }
  /// Mean flow and loom at the last update, in the order of kSideRoles; 0 without a measurement.
  std::span<const SideFlow> flows() const { return flows_; }
  /// Measurement at the last update; empty before the second image of a camera, or if the last one is too old.
  const std::optional<CameraFlow::Measure>& measure(size_t side) const { return measures_[side]; }
  /// Whether the last update added a measurement.
  bool fresh(size_t side) const { return fresh_[side]; }
  /// Time of the last update.
  int64_t now_ns() const { return now_ns_; }
  /// Minimum share of valid patches over all images so far; 1 before the first.
  double least_valid_share() const { return least_valid_share_; }

  /// Returns flow, loom, share of valid patches and inverse range per side, NaN if unknown; then the target velocity.
  /// @param inverse_ranges_per_m  empty if the module measures no ranges. @param v_tgt_W  m/s.
  std::vector<double> signal_values(const std::optional<std::array<double, kSideCount>>& inverse_ranges_per_m,
                                    const Eigen::Vector2d& v_tgt_W) const;
  /// Returns the four images with their flow and a compass of velocities (CV_8UC3, RGB); empty before the first image.
  /// @param v_tgt_H, v_cmd_H  target and command in H, m/s.  @param speed_mps  drawn slightly shorter than the radius
  /// of the compass, > 0.
  cv::Mat annotate(const Eigen::Vector2d& v_tgt_H, const Eigen::Vector2d& v_cmd_H, double speed_mps) const;

 private:
  std::vector<CameraFlow> cameras_;
  SideAxes axes_H_;
  std::array<SideFlow, kSideCount> flows_;
  std::array<std::optional<CameraFlow::Measure>, kSideCount> measures_;
  std::array<bool, kSideCount> fresh_{};
  int64_t now_ns_ = 0;
  double least_valid_share_ = 1.0;
};

}  // namespace hedgehop::avoidance::flow_balance
