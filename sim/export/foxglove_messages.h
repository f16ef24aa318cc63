#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <opencv2/core.hpp>

#include "sim/export/lens_model.h"
#include "sim/export/log_sink.h"
#include "sim/export/scene_surfaces.h"
#include "sim/logfile/protobuf_writer.h"

namespace hedgehop::sim {

// Messages with the schemas of Foxglove; field numbers as in foxglove_messages(). Times in ns, poses in the frame that
// the message names.

ProtobufWriter time_message(int64_t t_ns);
ProtobufWriter compressed_image(int64_t t_ns, const std::string& frame, std::string_view data, std::string_view format);
/// @param depth_mm  CV_16UC1.
ProtobufWriter raw_depth_image(int64_t t_ns, const std::string& frame, const cv::Mat& depth_mm);
ProtobufWriter calibration_message(int64_t t_ns, const std::string& frame, const LoggedCamera& camera,
                                   const LensModel& lens);
ProtobufWriter transform_message(int64_t t_ns, const std::string& parent, const std::string& child,
                                 const Eigen::Isometry3d& X_parent_child);
ProtobufWriter pose_in_frame(int64_t t_ns, const std::string& frame, const Eigen::Isometry3d& X);
ProtobufWriter odometry_message(int64_t t_ns, const std::string& frame, const std::string& body,
                                const LoggedMotion& motion, const LoggedSigmas& sigmas);
ProtobufWriter log_message(int64_t t_ns, EventLevel level, const std::string& name, const std::string& message);
ProtobufWriter scene_entity(int64_t t_ns, const std::string& frame, const SurfaceMesh& mesh, bool frame_locked);
/// @param corners  N x 1, CV_64FC2, px from the center of pixel (0, 0).
ProtobufWriter corner_annotations(int64_t t_ns, const cv::Mat& corners);
/// @param status  of the module. @param goal_px  place of the goal in the image, from the center of pixel (0, 0).
ProtobufWriter flight_annotations(int64_t t_ns, const std::string& status,
                                  const std::optional<Eigen::Vector2d>& goal_px, double goal_distance_m);

}  // namespace hedgehop::sim
