#pragma once

#include "sim/export/sensor_record.h"

namespace hedgehop::sim {

/// The texts of a data set after [BurriNikolicGohl2016], in its layout: mav0/ with cam0.., imu0 and
/// state_groundtruth_estimate0, each with sensor.yaml and data.csv. R is E, S of the IMU is F, times are ns of flight.
/// Throws InputError for a lens that the format cannot describe (k3 of a pinhole).
std::vector<DataFile> euroc_files(const SensorRecord& record);

/// File of an image, relative to the data set's folder.
std::filesystem::path euroc_image(size_t camera, int64_t t_ns);

}  // namespace hedgehop::sim
