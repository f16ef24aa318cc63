#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <opencv2/core.hpp>

#include "sim/export/lens_model.h"
#include "sim/export/level_scan.h"
#include "sim/export/log_sink.h"
#include "sim/export/scene_surfaces.h"
#include "sim/logfile/cdr_writer.h"

namespace hedgehop::sim {

// Messages of ROS 2 in CDR. A header's time counts from kStartTimeNs.

struct RosHeader {
  int64_t t_ns = 0;  ///< of the flight
  std::string frame;
};

CdrWriter ros_image(const RosHeader& header, const cv::Mat& image);
CdrWriter ros_compressed_image(const RosHeader& header, std::string_view format, std::string_view data);
CdrWriter ros_camera_info(const RosHeader& header, const LoggedCamera& camera, const LensModel& lens);
CdrWriter ros_imu(const RosHeader& header, const RecordedReading& reading, const dynamics::sensors::ImuConfig& config);
CdrWriter ros_odometry(const RosHeader& header, const std::string& child, const LoggedMotion& motion,
                       const LoggedSigmas& sigmas);
/// @param p_W_m  measured position, north, east, down of the geodetic origin.
CdrWriter ros_fix(const RosHeader& header, const Eigen::Vector3d& p_W_m, const dynamics::sensors::GpsConfig& config);
CdrWriter ros_laser_scan(const RosHeader& header, const LevelScan& scan, double scan_time_s, double min_m,
                         double max_m);

struct RosTransform {
  RosHeader header;
  std::string child;
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();  ///< pose of the child in the header's frame
};
CdrWriter ros_transforms(std::span<const RosTransform> transforms);

/// An array of markers, added one by one.
class RosMarkers {
 public:
  void add(const RosHeader& header, const SurfaceMesh& mesh, bool frame_locked);
  size_t count() const { return markers_.size(); }
  CdrWriter message() const;

 private:
  struct Marker {
    RosHeader header;
    SurfaceMesh mesh;
    bool frame_locked = false;
  };
  std::vector<Marker> markers_;
};

/// Place of the origin of E in fixes: latitude and longitude, deg, and altitude, m. It is that of PX4's simulators.
inline constexpr double kOriginLatitudeDeg = 47.397742, kOriginLongitudeDeg = 8.545594, kOriginAltitudeM = 488.0;

}  // namespace hedgehop::sim
