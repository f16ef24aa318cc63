#include "sim/dataset/pose_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"
#include "sim/export/sensor_record.h"
#include "sim/fields/utf8_mark.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kFormats =
    "trajectory.csv of a run, a table with columns t x y z qx qy qz qw, EuRoC, TUM, KITTI";

/// A line of a file, cut into words.
struct Line {
  int number = 0;  ///< from 1
  std::vector<std::string> words;
};

std::vector<std::string> words_of(std::string text) {
  const bool has_commas = text.find(',') != std::string::npos;
  std::vector<std::string> words;
  if (!has_commas) {
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
  }
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) {
    const size_t begin = word.find_first_not_of(" \t\r"), end = word.find_last_not_of(" \t\r");
    words.push_back(begin == std::string::npos ? "" : word.substr(begin, end - begin + 1));
  }
  if (text.ends_with(',')) words.emplace_back();  // an empty value at the end
  return words;
}

class PoseParser {
 public:
  PoseParser(const std::string& text, std::string file, const PoseReading& reading)
      : file_(std::move(file)), reading_(reading) {
    std::istringstream stream{std::string(without_utf8_mark(text))};
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      const size_t begin = line.find_first_not_of(" \t\r");
      if (begin == std::string::npos || line[begin] == '#') continue;
      lines_.push_back({number, words_of(line)});
    }
  }

  std::vector<TimedPose> parse() {
    if (lines_.empty()) throw InputError(fmt::format("{}: has no poses; valid: {}", file_, kFormats));
    const Line& first = lines_.front();
    if (parse_number(first.words[0], false).kind == ParsedNumber::Kind::not_a_number) return parse_table();
    if (first.words.size() == 12) return parse_kitti();
    const bool is_euroc = first.words.size() >= 8 && is_ns(first);
    if (!is_euroc && first.words.size() != 8) {
      refuse(first, fmt::format("{} numbers; valid: {}", first.words.size(), kFormats));
    }
    std::vector<TimedPose> poses;
    for (const Line& line : lines_) {
      if (line.words.size() < 8) refuse(line, fmt::format("expected 8 numbers, got {}", line.words.size()));
      const Eigen::Vector3d p(number(line, 1), number(line, 2), number(line, 3));
      const size_t w = is_euroc ? 4 : 7, x = is_euroc ? 5 : 4;
      poses.push_back(
          {0.0, from_E(line, p, {number(line, w), number(line, x), number(line, x + 1), number(line, x + 2)})});
      stamps_ns_.push_back(nanoseconds(line, is_euroc));
    }
    return timed(std::move(poses));
  }

 private:
  [[noreturn]] void refuse(const Line& line, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line.number, message));
  }

  double number(const Line& line, size_t column) const {
    const ParsedNumber parsed = parse_number(line.words[column], false);
    if (parsed.kind != ParsedNumber::Kind::number) {
      refuse(line, fmt::format("expected a number, got '{}'", line.words[column]));
    }
    return parsed.member;
  }

  /// Whether the time in the first column is in ns, not in s.
  bool is_ns(const Line& line) const {
    constexpr double kMinNs = 1e12;
    return std::abs(number(line, 0)) >= kMinNs && line.words[0].find('.') == std::string::npos;
  }

  /// Refuses a time that is out of range. @param t_s  converted from the unit of its column. @param word  the file's
  /// text. @param in_ns  unit of the column, else s.
  void require_near(const Line& line, double t_s, const std::string& word, bool in_ns) const {
    constexpr double kMaxS = 4e9;  // the difference of two such times in ns has 64 bits
    if (std::abs(t_s) <= kMaxS) return;
    refuse(line, fmt::format("the time {} {} is out of range; valid: -4e9 to 4e9 s{}", word, in_ns ? "ns" : "s",
                             in_ns ? "" : "; state the time in s"));
  }

  /// Returns the time in the first column, ns; a double would lose digits. @param in_ns  unit of the column, else s.
  int64_t nanoseconds(const Line& line, bool in_ns) const {
    const std::string& word = line.words[0];
    require_near(line, number(line, 0) * (in_ns ? 1e-9 : 1.0), word, in_ns);
    if (in_ns) {
      const auto parsed = parse_signed(word);
      if (!parsed) refuse(line, fmt::format("expected a time in whole ns, got '{}'", word));
      return *parsed;
    }
    const size_t point = word.find('.');
    const auto whole = parse_signed(word.substr(0, point));
    if (!whole || word.find_first_of("eE") != std::string::npos) {
      return std::llround(number(line, 0) * 1e9);
    }
    std::string fraction = point == std::string::npos ? "" : word.substr(point + 1, 9);
    fraction.resize(9, '0');
    const auto ns = parse_signed(fraction);
    if (!ns) refuse(line, fmt::format("expected a time in s, got '{}'", word));
    return *whole * 1'000'000'000 + (word.starts_with('-') ? -*ns : *ns);
  }

  /// Returns the pose in W of a pose in E: of the IMU or of a camera.
  Eigen::Isometry3d from_E(const Line& line, const Eigen::Vector3d& p_E, const Eigen::Quaterniond& q) const {
    constexpr double kMaxError = 1e-2;
    if (!(std::abs(q.norm() - 1.0) <= kMaxError)) refuse(line, "the quaternion does not have length 1");
    Eigen::Isometry3d pose_E = Eigen::Isometry3d::Identity();
    pose_E.linear() = q.normalized().toRotationMatrix();
    pose_E.translation() = p_E;
    Eigen::Isometry3d X_WE = Eigen::Isometry3d::Identity();
    X_WE.linear() = R_EW().transpose();
    if (reading_.of_camera) return X_WE * pose_E;
    dynamics::sensors::ImuConfig imu{.p_BI_m = reading_.p_BI_m};
    return X_WE * pose_E * X_FB(imu);
  }

  std::vector<TimedPose> timed(std::vector<TimedPose> poses) const {
    constexpr int64_t kDayNs = 86'400'000'000'000;
    const int64_t first = stamps_ns_.front();
    const int64_t begin = first >= kStartTimeNs && first < kStartTimeNs + kDayNs ? kStartTimeNs : first;
    for (size_t i = 0; i < poses.size(); ++i) {
      if (i > 0 && stamps_ns_[i] <= stamps_ns_[i - 1]) refuse(lines_[i], "the times must increase");
      poses[i].t_s = 1e-9 * static_cast<double>(stamps_ns_[i] - begin);
    }
    return poses;
  }

  std::vector<TimedPose> parse_kitti() const {
    if (!reading_.of_camera)
      throw InputError(fmt::format("{}: poses of KITTI are those of a camera; use --pose-of", file_));
    constexpr double kPeriodS = 0.1;
    std::vector<TimedPose> poses;
    for (const Line& line : lines_) {
      if (line.words.size() != 12) refuse(line, fmt::format("expected 12 numbers, got {}", line.words.size()));
      Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
      for (size_t i = 0; i < 12; ++i) {
        X.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = number(line, i);
      }
      constexpr double kMaxError = 1e-3;
      if (!((X.linear().transpose() * X.linear() - Eigen::Matrix3d::Identity()).norm() <= kMaxError)) {
        refuse(line, "the first three columns are no rotation");
      }
      X.linear() = Eigen::Quaterniond(X.linear()).normalized().toRotationMatrix();
      poses.push_back({kPeriodS * static_cast<double>(poses.size()), reading_.first_pose_W * X});
    }
    return poses;
  }

  std::vector<TimedPose> parse_table() {
    std::map<std::string, size_t> columns;
    const Line header = lines_.front();
    for (size_t i = 0; i < header.words.size(); ++i) columns.emplace(header.words[i], i);
    for (const char* name : {"time", "timestamp", "t_s"}) {
      if (columns.contains(name)) columns.emplace("t", columns[name]);
    }
    const bool is_own = columns.contains("north_m");
    const std::vector<std::string> names =
        is_own ? std::vector<std::string>{"t", "north_m", "east_m", "down_m", "roll_rad", "pitch_rad", "yaw_rad"}
               : std::vector<std::string>{"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
    for (const std::string& name : names) {
      if (!columns.contains(name)) refuse(header, fmt::format("has no column '{}'; valid: {}", name, kFormats));
    }
    if (is_own && reading_.of_camera) {
      throw InputError(fmt::format("{}: the poses of a trajectory.csv are those of the body; remove --pose-of", file_));
    }
    lines_.erase(lines_.begin());
    std::optional<bool> in_ns;  // as the first time
    std::vector<TimedPose> poses;
    for (Line& line : lines_) {
      if (line.words.size() != header.words.size()) {
        refuse(line, fmt::format("expected {} values, got {}", header.words.size(), line.words.size()));
      }
      const auto value = [&](size_t i) { return number(line, columns.at(names[i])); };
      const Eigen::Vector3d p(value(1), value(2), value(3));
      if (is_own) {
        Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();
        X_WB.linear() = (Eigen::AngleAxisd(value(6), Eigen::Vector3d::UnitZ()) *
                         Eigen::AngleAxisd(value(5), Eigen::Vector3d::UnitY()) *
                         Eigen::AngleAxisd(value(4), Eigen::Vector3d::UnitX()))
                            .toRotationMatrix();
        X_WB.translation() = p;
        require_near(line, value(0), line.words[columns.at("t")], false);
        poses.push_back({value(0), X_WB});
        continue;
      }
      poses.push_back({0.0, from_E(line, p, {value(7), value(4), value(5), value(6)})});
      std::swap(line.words[0], line.words[columns.at("t")]);
      in_ns = in_ns.value_or(is_ns(line));
      stamps_ns_.push_back(nanoseconds(line, *in_ns));
    }
    if (poses.empty()) throw InputError(fmt::format("{}: has no poses", file_));
    return is_own ? poses : timed(std::move(poses));
  }

  std::string file_;
  PoseReading reading_;
  std::vector<Line> lines_;
  std::vector<int64_t> stamps_ns_;
};

}  // namespace

std::vector<TimedPose> parse_poses(const std::string& text, const std::string& file, const PoseReading& reading) {
  return PoseParser(text, file, reading).parse();
}

}  // namespace hedgehop::sim
