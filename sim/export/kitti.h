#pragma once

#include "sim/export/sensor_record.h"

namespace hedgehop::sim {

/// The texts of a data set after [GeigerLenzUrtasun2012], in the layout of its odometry: sequences/00 with image_0..,
/// calib.txt and times.txt, poses/00.txt. Poses are those of the first camera in its own first frame. calib.txt has
/// P0.. (from the first camera's frame to each image) and, as the raw data's, Tr_imu_to_cam0; the readings, which the
/// odometry set lacks, are in imu.txt: t, w_F, f_F.
/// @param record  with undistorted pinholes of one rate. Throws InputError otherwise.
std::vector<DataFile> kitti_files(const SensorRecord& record);

std::filesystem::path kitti_image(size_t camera, size_t number);

}  // namespace hedgehop::sim
