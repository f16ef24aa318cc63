#pragma once

#include "sim/export/sensor_record.h"

namespace hedgehop::sim {

/// Returns the text files of a data set in the EuRoC layout, after [BurriNikolicGohl2016]: mav0/ with cam0.., imu0 and
/// state_groundtruth_estimate0, each with sensor.yaml and data.csv. R is E, S of the IMU is F, times count from
/// kStartTimeNs. Throws InputError for a lens that the format cannot represent (k3 of a pinhole).
std::vector<DataFile> euroc_files(const SensorRecord& record);

/// Returns the file of an image, relative to the folder of the data set.
std::filesystem::path euroc_image(size_t camera, int64_t t_ns);

/// Returns the text files of a data set in the odometry layout, after [GeigerLenzUrtasun2012]: sequences/00 with
/// image_0.., calib.txt and times.txt, and poses/00.txt. Poses are those of the first camera relative to its first
/// pose. calib.txt has P0 to P3 (from the frame of the first camera to each image; two cameras repeat as P2 and P3) and
/// Tr, the pose of F in the first camera: KITTI stores the pose of its laser scanner there, whose axes are F's. Times
/// are s of flight. imu.txt has the readings, which the odometry layout lacks: t, w_F, f_F.
/// @param record  with undistorted pinholes of one rate. Throws InputError otherwise.
std::vector<DataFile> kitti_files(const SensorRecord& record);

std::filesystem::path kitti_image(size_t camera, size_t number);

/// Units per meter of the 16-bit depth images; 0: unknown, or more than 13.1 m.
inline constexpr double kTumDepthPerMeter = 5000.0;

/// Returns the text files of a data set with one pinhole in the TUM layout, after [SturmEngelhardEndres2012]: rgb.txt,
/// depth.txt, groundtruth.txt (X_EC of the camera: t x y z qx qy qz qw), accelerometer.txt (of the IMU, along F). In
/// addition: gyroscope.txt, and calibration.yaml for OpenCV. Times count from kStartTimeNs.
/// @param record  with one camera, a pinhole.
std::vector<DataFile> tum_files(const SensorRecord& record);

std::filesystem::path tum_image(int64_t t_ns);
std::filesystem::path tum_depth(int64_t t_ns);

}  // namespace hedgehop::sim
