#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

#include "vision/camera/pinhole_camera.h"
#include "vision/flow/flow_velocity.h"
#include "vision/flow/image_interpolation_flow.h"

namespace hedgehop::vision::flow {

/// The aircraft's estimate of its motion at the exposure of an image.
struct ExposureMotion {
  int64_t t_ns = 0;
  Eigen::Quaterniond q_WB_est = Eigen::Quaterniond::Identity();
  Eigen::Quaterniond q_WB_gyro = Eigen::Quaterniond::Identity();  ///< integrated from the gyros alone
  double height_above_ground_m = 0.0;                             ///< of B, measured vertically
};

/// A velocity over ground, and the motion between the two images from which it was measured.
struct GroundVelocityReading {
  FlowVelocity velocity;
  FlowMotion motion;
};

/// Measures the velocity over ground from the images of a camera that looks down.
/// Source: [Garratt2009] sec. 4, after [GarrattChahl2007] sec. 2 (hover damping by optic flow).
class GroundVelocity {
 public:
  /// @param X_BC  pose of the camera in B. Throws std::invalid_argument if the image is too small for its patches.
  GroundVelocity(const camera::PinholeCamera& camera, const Eigen::Isometry3d& X_BC);

  /// Measures the velocity by the flow since the last image. @param grey  of the camera, CV_8UC1, later than the last.
  /// @return std::nullopt for the first image, and if the ground has too little texture.
  std::optional<GroundVelocityReading> measure(const cv::Mat& grey, const ExposureMotion& exposure);

 private:
  camera::PinholeCamera camera_;
  Eigen::Isometry3d X_BC_;
  ImageInterpolationFlow flow_;
  std::optional<ExposureMotion> last_;
};

}  // namespace hedgehop::vision::flow
