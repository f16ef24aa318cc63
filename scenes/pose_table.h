#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <string_view>
#include <vector>

namespace hedgehop::scenes {

/// Pose of a frame M in W at a time.
struct PoseRow {
  double t_s = 0.0;
  Eigen::Vector3d p_WM = Eigen::Vector3d::Zero();  ///< m
  Eigen::Quaterniond q_WM = Eigen::Quaterniond::Identity();
};

/// Poses at increasing times, the first at t = 0; at least one.
class PoseTable {
 public:
  /// @throws std::invalid_argument if there is no row, or the times do not increase.
  explicit PoseTable(std::vector<PoseRow> rows);

  /// Returns the pose at a time: positions linear, attitudes along the shortest arc (slerp). Before the first and after
  /// the last row it is that of the row.
  PoseRow at(double t_s) const;
  /// Velocities of M in W between two rows.
  struct Rates {
    Eigen::Vector3d v_mps = Eigen::Vector3d::Zero();
    double turn_radps = 0.0;
  };
  /// Returns the rates of the interval that begins at or before a time; 0 outside the table.
  Rates rates(double t_s) const;

  double duration_s() const { return rows_.back().t_s; }
  const std::vector<PoseRow>& rows() const { return rows_; }

 private:
  std::vector<PoseRow> rows_;
};

/// Parses rows "t, x, y, z, qw, qx, qy, qz", in s and m, about axes north, west, up. Lines that begin with # and empty
/// lines are skipped, and times count from the first row. Quaternions are normalized.
/// @throws std::invalid_argument with the line, the value and the valid values.
PoseTable parse_pose_table(std::string_view text);

/// Reads a file as parse_pose_table(). @throws std::invalid_argument also if it cannot be read.
PoseTable read_pose_table(const std::filesystem::path& file);

}  // namespace hedgehop::scenes
