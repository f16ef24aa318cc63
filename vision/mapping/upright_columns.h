#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/mapping/depth_blocks.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// The blocks along a vertical line of the world, one per row of blocks, for every tilt of the camera.
class UprightColumn {
 public:
  /// @param geometry, down_C, blocks  must outlive this object. @param col  of its block in the middle row; may be
  /// outside the image, which a tilted column still crosses.
  UprightColumn(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks,
                int col);

  bool in_image(int row) const { return col(row) >= 0 && col(row) < blocks_->cols(); }
  int col(int row) const { return cols_[static_cast<size_t>(row)]; }
  const DepthBlock& at(int row) const { return blocks_->at(row, col(row)); }
  /// Returns the lowest row within the image; -1 if there is none.
  int lowest() const;
  /// Returns the ray in C of the middle of a block, scaled to z = 1.
  Eigen::Vector3d ray(int row) const;
  /// Returns the sine of a block's elevation above the horizon.
  double elevation(int row) const { return -down_C_->dot(ray(row).normalized()); }
  /// Returns the horizontal distance of a point in a block divided by its z in C.
  double horizontal_per_z(int row) const { return ray(row).cross(*down_C_).norm(); }
  /// Returns the horizontal distance of the nearest surface in a matched block, m.
  double horizontal_m(int row) const { return horizontal_per_z(row) * geometry_->z_m(at(row).near16); }
  /// Returns the disparity x 16, at the block of a row, of a vertical surface at a horizontal distance.
  int upright16(int row, double distance_m) const;

 private:
  const stereo::StereoGeometry* geometry_;
  const Eigen::Vector3d* down_C_;
  const DepthBlocks* blocks_;
  std::vector<int> cols_;  ///< of each row
};

/// All upright columns that cross an image.
class UprightColumns {
 public:
  /// @param geometry, blocks  must outlive this object. @param down_C  unit vector of the vertical in C; must outlive
  /// it too.
  UprightColumns(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, const DepthBlocks& blocks);

  const std::vector<UprightColumn>& all() const { return columns_; }
  /// Returns the index of the column through the middle of a block; -1 if there is none.
  int of(int row, int col) const;

 private:
  const stereo::StereoGeometry& geometry_;
  const Eigen::Vector3d& down_C_;
  int rows_, first_;  ///< block column, in the middle row, of the first upright column
  std::vector<UprightColumn> columns_;
};

}  // namespace hedgehop::vision::mapping
