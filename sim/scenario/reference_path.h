#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// A position at a time of a flight.
struct TimedPoint {
  double t_s = 0.0;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< m
};

/// A flight's path that a person accepted as the reference for later flights.
struct ReferencePath {
  std::string reason;   ///< why it is good, one line
  std::string version;  ///< of Hedgehop
  uint64_t seed = 0;
  double step_s = 0.1;  ///< between points, the last pair aside, > 0
  std::vector<TimedPoint> points;
};

/// Every `step_s` a point, and the last one. @param points  times rise.
std::vector<TimedPoint> thinned(const std::vector<TimedPoint>& points, double step_s);

/// Text of a reference file: `# key: value` lines, then a table of t_s, north_m, east_m, altitude_m with milliseconds
/// and millimeters. Of points in the same millisecond, it has the last one.
std::string reference_text(const ReferencePath& reference);

/// Reads it back. Throws std::invalid_argument naming the file and the line when it cannot be read, holds no point, or
/// when its times do not rise.
ReferencePath read_reference_path(const std::filesystem::path& file);

}  // namespace hedgehop::sim
