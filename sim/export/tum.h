#pragma once

#include "sim/export/sensor_record.h"

namespace hedgehop::sim {

/// Depth images hold 16-bit numbers, this many to a meter; 0: unknown, or beyond their range (13.1 m).
inline constexpr double kTumDepthPerMeter = 5000.0;

/// The texts of a data set after [SturmEngelhardEndres2012], in its layout, of one pinhole: rgb.txt, depth.txt,
/// groundtruth.txt (X_EC of the camera: t x y z qx qy qz qw), accelerometer.txt (of the IMU, along F); besides, gyros
/// in gyroscope.txt and calibration.yaml for OpenCV's reader. Times are s of flight.
/// @param record  with one camera, a pinhole.
std::vector<DataFile> tum_files(const SensorRecord& record);

std::filesystem::path tum_image(int64_t t_ns);
std::filesystem::path tum_depth(int64_t t_ns);

}  // namespace hedgehop::sim
