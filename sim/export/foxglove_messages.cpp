#include "sim/export/foxglove_messages.h"

#include <fmt/format.h>

#include <array>

namespace hedgehop::sim {
namespace {

ProtobufWriter vector_message(const Eigen::Vector3d& v) {
  ProtobufWriter out;
  out.add_double(1, v.x()).add_double(2, v.y()).add_double(3, v.z());
  return out;
}

ProtobufWriter rotation_message(const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  ProtobufWriter out;
  out.add_double(1, q.x()).add_double(2, q.y()).add_double(3, q.z()).add_double(4, q.w());
  return out;
}

ProtobufWriter pose_message(const Eigen::Isometry3d& X) {
  ProtobufWriter out;
  out.add_message(1, vector_message(X.translation())).add_message(2, rotation_message(X.linear()));
  return out;
}

/// Returns a 6 x 6 covariance, row by row, with the squares of these on its diagonal.
std::array<double, 36> diagonal(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  std::array<double, 36> covariance = {};
  for (size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    covariance[7 * i] = first[axis] * first[axis];
    covariance[7 * (i + 3)] = second[axis] * second[axis];
  }
  return covariance;
}

ProtobufWriter stamped(int64_t t_ns) {
  ProtobufWriter out;
  out.add_message(1, time_message(t_ns));
  return out;
}

ProtobufWriter text_annotation(int64_t t_ns, const Eigen::Vector2d& at_px, const std::string& text) {
  constexpr double kFontPx = 12.0;
  ProtobufWriter out = stamped(t_ns);
  out.add_numbers(2, {at_px.x(), at_px.y()}).add_bytes(3, text).add_double(4, kFontPx);
  out.add_numbers(5, {1.0, 1.0, 0.2, 1.0}).add_numbers(6, {0.0, 0.0, 0.0, 0.5});
  return out;
}

constexpr double kToCorner = 0.5;  // Foxglove counts pixels from the corner of pixel (0, 0)

}  // namespace

ProtobufWriter time_message(int64_t t_ns) {
  constexpr int64_t kSecond = 1'000'000'000;
  ProtobufWriter out;
  out.add_integer(1, static_cast<uint64_t>(t_ns / kSecond)).add_integer(2, static_cast<uint64_t>(t_ns % kSecond));
  return out;
}

ProtobufWriter compressed_image(int64_t t_ns, const std::string& frame, std::string_view data,
                                std::string_view format) {
  ProtobufWriter out = stamped(t_ns);
  out.add_bytes(2, data).add_bytes(3, format).add_bytes(4, frame);
  return out;
}

ProtobufWriter raw_depth_image(int64_t t_ns, const std::string& frame, const cv::Mat& depth_mm) {
  CV_Assert(depth_mm.type() == CV_16UC1 && depth_mm.isContinuous());
  ProtobufWriter out = stamped(t_ns);
  const auto cols = static_cast<uint32_t>(depth_mm.cols), rows = static_cast<uint32_t>(depth_mm.rows);
  out.add_fixed32(2, cols).add_fixed32(3, rows).add_bytes(4, "16UC1").add_fixed32(5, 2 * cols);
  out.add_bytes(6, {depth_mm.ptr<char>(), size_t{2} * cols * rows}).add_bytes(7, frame);
  return out;
}

ProtobufWriter calibration_message(int64_t t_ns, const std::string& frame, const LoggedCamera& camera,
                                   const LensModel& lens) {
  ProtobufWriter out = stamped(t_ns);
  out.add_fixed32(2, static_cast<uint32_t>(camera.width_px)).add_fixed32(3, static_cast<uint32_t>(camera.height_px));
  out.add_bytes(4, lens.model).add_doubles(5, lens.D).add_doubles(6, lens.K).add_doubles(7, lens.R);
  out.add_doubles(8, lens.P).add_bytes(9, frame);
  return out;
}

ProtobufWriter transform_message(int64_t t_ns, const std::string& parent, const std::string& child,
                                 const Eigen::Isometry3d& X_parent_child) {
  ProtobufWriter out = stamped(t_ns);
  out.add_bytes(2, parent).add_bytes(3, child);
  out.add_message(4, vector_message(X_parent_child.translation()));
  out.add_message(5, rotation_message(X_parent_child.linear()));
  return out;
}

ProtobufWriter pose_in_frame(int64_t t_ns, const std::string& frame, const Eigen::Isometry3d& X) {
  ProtobufWriter out = stamped(t_ns);
  out.add_bytes(2, frame).add_message(3, pose_message(X));
  return out;
}

ProtobufWriter odometry_message(int64_t t_ns, const std::string& frame, const std::string& body,
                                const LoggedMotion& motion, const LoggedSigmas& sigmas) {
  ProtobufWriter out = stamped(t_ns);
  out.add_bytes(2, frame).add_bytes(3, body).add_message(4, pose_message(motion.X_EF));
  out.add_message(5, vector_message(motion.v_EF_F)).add_message(6, vector_message(motion.w_EF_F));
  out.add_doubles(7, diagonal(sigmas.p_E_m, sigmas.attitude_F_rad));
  out.add_doubles(8, diagonal(sigmas.v_F_mps, sigmas.w_F_radps));
  return out;
}

ProtobufWriter log_message(int64_t t_ns, EventLevel level, const std::string& name, const std::string& message) {
  constexpr uint64_t kInfo = 2;  // WARNING and ERROR follow
  ProtobufWriter out = stamped(t_ns);
  out.add_integer(2, kInfo + static_cast<uint64_t>(level)).add_bytes(3, message).add_bytes(4, name);
  return out;
}

ProtobufWriter scene_entity(int64_t t_ns, const std::string& frame, const SurfaceMesh& mesh, bool frame_locked) {
  ProtobufWriter triangles;
  triangles.add_message(1, pose_message(Eigen::Isometry3d::Identity()));
  for (const Eigen::Vector3f& p : mesh.points_E) triangles.add_numbers(2, {p.x(), p.y(), p.z()});
  triangles.add_numbers(3, {0.5, 0.5, 0.5, 1.0});
  for (const Eigen::Vector3f& c : mesh.colors) triangles.add_numbers(4, {c.x(), c.y(), c.z(), 1.0});
  triangles.add_fixed32s(5, mesh.indices);
  ProtobufWriter kind;
  kind.add_bytes(1, "class").add_bytes(2, scenes::kSemanticClassNames[static_cast<size_t>(mesh.kind)]);
  ProtobufWriter out = stamped(t_ns);
  out.add_bytes(2, frame).add_bytes(3, mesh.id).add_message(4, time_message(0)).add_integer(5, frame_locked);
  out.add_message(6, kind).add_message(12, triangles);
  return out;
}

ProtobufWriter corner_annotations(int64_t t_ns, const cv::Mat& corners) {
  constexpr uint64_t kPoints = 1;
  constexpr double kThicknessPx = 4.0;
  ProtobufWriter points = stamped(t_ns);
  points.add_integer(2, kPoints);
  for (int i = 0; i < corners.rows; ++i) {
    const auto& px = corners.at<cv::Vec2d>(i);
    points.add_numbers(3, {px[0] + kToCorner, px[1] + kToCorner});
  }
  points.add_numbers(4, {1.0, 0.2, 0.2, 1.0}).add_numbers(6, {0.0, 0.0, 0.0, 0.0}).add_double(7, kThicknessPx);
  ProtobufWriter out;
  out.add_message(2, points).add_message(5, time_message(t_ns));
  return out;
}

ProtobufWriter flight_annotations(int64_t t_ns, const std::string& status,
                                  const std::optional<Eigen::Vector2d>& goal_px, double goal_distance_m) {
  constexpr double kMarginPx = 4.0, kLinePx = 16.0, kDiameterPx = 20.0, kThicknessPx = 2.0;
  ProtobufWriter out;
  if (goal_px) {
    const Eigen::Vector2d at = goal_px->array() + kToCorner;
    ProtobufWriter circle = stamped(t_ns);
    circle.add_numbers(2, {at.x(), at.y()}).add_double(3, kDiameterPx).add_double(4, kThicknessPx);
    circle.add_numbers(5, {0.0, 0.0, 0.0, 0.0}).add_numbers(6, {0.2, 1.0, 0.2, 1.0});
    out.add_message(1, circle);
    out.add_message(3, text_annotation(t_ns, at, fmt::format("goal {:.0f} m", goal_distance_m)));
  }
  if (!status.empty()) out.add_message(3, text_annotation(t_ns, {kMarginPx, kLinePx}, status));
  return out.add_message(5, time_message(t_ns));
}

}  // namespace hedgehop::sim
