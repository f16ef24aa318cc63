#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/scenario/rig.h"

namespace hedgehop::sim {

/// A camera of a calibration file.
struct CalibratedCamera {
  std::string name;  ///< of its entry: "cam0" of a chain, a role; empty if the format names no camera
  std::string role;  ///< the name, or that of the ROS topic: "left" for /left/image_raw
  /// The keys of the lens and of the pose. The size is 0 if the file has none.
  CameraConfig config;
  std::optional<double> rate_hz;
};

/// Reads a calibration of any supported format, which follows from the content:
/// - Kalibr's camera chain: pinhole with radtan, equidistant or none; omni with radtan; ds;
/// - sensor.yaml of EuRoC and TUM-VI;
/// - camera_info of ROS: plumb_bob, rational_polynomial, equidistant;
/// - FileStorage of OpenCV, YAML or XML: 4, 5, 8, 12 or 14 coefficients, fisheye, omnidir, one camera, a map of
/// cameras, or a pair with M1, D1, M2, D2 and perhaps R and T.
/// Throws InputError with file, line and the valid values, also for a model that is unknown or not implemented (thin
/// prism, tilted, extended unified, fov). @param file  name for messages.
std::vector<CalibratedCamera> parse_calibration(const std::string& text, const std::string& file);

}  // namespace hedgehop::sim
