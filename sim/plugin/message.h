#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>
#include <cstring>
#include <opencv2/core.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "avoidance/module.h"

/// Values as bytes, for two processes of one program. Each struct lists its fields once, for both directions.
namespace hedgehop::sim {

template <class T, class Struct>
concept Either = std::same_as<std::remove_const_t<T>, Struct>;

namespace message_fields {

void list(auto& a, Either<avoidance::CameraNeed> auto& x) { a(x.role, x.channel, x.pinhole); }
void list(auto& a, Either<avoidance::Needs> auto& x) { a(x.cameras, x.commands); }
void list(auto& a, Either<avoidance::Signal> auto& x) { a(x.name, x.unit); }
void list(auto& a, Either<avoidance::MountedCamera> auto& x) { a(x.role, x.model, x.X_BC, x.rate_hz); }
void list(auto& a, Either<avoidance::VehicleLimits> auto& x) {
  a(x.speed_mps, x.acceleration_mps2, x.radius_m, x.outline_B);
}
void list(auto& a, Either<avoidance::AltitudeBand> auto& x) { a(x.min_m, x.max_m); }
void list(auto& a, Either<avoidance::Setup> auto& x) { a(x.cameras, x.limits, x.seed, x.altitude_band); }
void list(auto& a, Either<avoidance::NavigationState> auto& x) {
  a(x.p_WB_est, x.q_WB_est, x.v_WB_B_est, x.w_WB_B_est, x.q_WB_gyro, x.height_above_ground_m, x.range_m);
}
void list(auto& a, Either<avoidance::Goal> auto& x) { a(x.p_WG, x.heading_rad); }
void list(auto& a, Either<avoidance::VelocityCommand> auto& x) { a(x.v_WB_W, x.altitude_m, x.heading_rad); }
void list(auto& a, Either<avoidance::PositionCommand> auto& x) { a(x.p_WB, x.heading_rad); }
void list(auto& a, Either<avoidance::AttitudeCommand> auto& x) {
  a(x.roll_rad, x.pitch_rad, x.heading_rad, x.altitude_m);
}
void list(auto& a, Either<avoidance::HoverCommand> auto& x) { a(x.yaw_rate_radps); }
void list(auto& a, Either<avoidance::Decision> auto& x) { a(x.command, x.status, x.signals); }
void list(auto& a, Either<avoidance::Metric> auto& x) { a(x.name, x.value, x.unit, x.is_wall_time); }
void list(auto& a, Either<avoidance::MapPoint> auto& x) { a(x.p_W, x.covariance_W); }
void list(auto& a, Either<avoidance::Map> auto& x) { a(x.points, x.course_NE, x.path_NE); }

}  // namespace message_fields

/// Types that are copied byte by byte: numbers, and Eigen's matrices of fixed size.
template <class T>
inline constexpr bool kIsPlain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;
template <class T, int rows, int cols>
inline constexpr bool kIsPlain<Eigen::Matrix<T, rows, cols>> = rows > 0 && cols > 0;
template <class T>
inline constexpr bool kIsPlain<Eigen::Quaternion<T>> = true;
template <>
inline constexpr bool kIsPlain<Eigen::Isometry3d> = true;
template <>
inline constexpr bool kIsPlain<Eigen::AlignedBox3d> = true;

class MessageWriter {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (add(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void add_bytes(const void* from, size_t count) { bytes_.append(static_cast<const char*>(from), count); }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(list.size());
    for (const T& item : list) add(item);
  }
  template <class T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  void add(const avoidance::Command& command) {
    add(command.index());
    std::visit([this](const auto& c) { message_fields::list(*this, c); }, command);
  }
  void add(const cv::Mat& image) {
    const cv::Mat whole = image.isContinuous() ? image : image.clone();
    (*this)(image.rows, image.cols, image.type());
    add_bytes(whole.data, whole.total() * whole.elemSize());
  }
  template <class T>
  void add(const T& value) {
    if constexpr (kIsPlain<T>) {
      add_bytes(&value, sizeof value);
    } else {
      message_fields::list(*this, value);
    }
  }

  std::string bytes_;
};

/// Reads the bytes of a MessageWriter. Throws std::runtime_error if the bytes end early or a length is impossible.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}
  template <class... T>
  void operator()(T&... values) {
    (take(values), ...);
  }
  template <class T>
  T next() {
    T value{};
    take(value);
    return value;
  }

 private:
  std::string_view take_bytes(size_t count) {
    if (count > bytes_.size()) throw std::runtime_error("a message ends early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  void take(std::string& text) { text = take_bytes(next<size_t>()); }
  template <class T>
  void take(std::vector<T>& list) {
    const auto count = next<size_t>();
    if (count > bytes_.size()) throw std::runtime_error("a message announces too many items");
    list.resize(count);
    for (T& item : list) take(item);
  }
  template <class T>
  void take(std::optional<T>& value) {
    value.reset();
    if (next<bool>()) take(value.emplace());
  }
  void take(avoidance::Command& command) {
    switch (next<size_t>()) {
      case 0:
        return message_fields::list(*this, command.emplace<avoidance::VelocityCommand>());
      case 1:
        return message_fields::list(*this, command.emplace<avoidance::PositionCommand>());
      case 2:
        return message_fields::list(*this, command.emplace<avoidance::AttitudeCommand>());
      case 3:
        return message_fields::list(*this, command.emplace<avoidance::HoverCommand>());
      default:
        throw std::runtime_error("a message has an unknown command");
    }
  }
  void take(cv::Mat& image) {
    const auto rows = next<int>(), cols = next<int>(), type = next<int>();
    if (rows < 0 || cols < 0 || CV_MAT_TYPE(type) != type) throw std::runtime_error("a message has no valid image");
    const size_t count =
        static_cast<size_t>(rows) * static_cast<size_t>(cols) * static_cast<size_t>(CV_ELEM_SIZE(type));
    const std::string_view pixels = take_bytes(count);
    image.create(rows, cols, type);
    if (!pixels.empty()) std::memcpy(image.data, pixels.data(), pixels.size());
  }
  template <class T>
  void take(T& value) {
    if constexpr (kIsPlain<T>) {
      std::memcpy(static_cast<void*>(&value), take_bytes(sizeof value).data(), sizeof value);
    } else {
      message_fields::list(*this, value);
    }
  }

  std::string_view bytes_;
};

}  // namespace hedgehop::sim
