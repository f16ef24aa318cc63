#include "vision/mapping/upright_columns.h"

#include <Eigen/Geometry>
#include <cmath>

namespace hedgehop::vision::mapping {
namespace {

cv::Point middle_px(int row, int col) {
  return {col * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx / 2,
          row * DepthBlocks::kBlockPx + DepthBlocks::kBlockPx / 2};
}

/// Returns the column at which a vertical plane through C crosses one block row; it may be outside the image.
/// @param across_C  normal of the plane.
int upright_col(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& across_C, int row) {
  constexpr double kMaxCol = 1e6;  // exceeded if the row is parallel to the plane
  const double y = geometry.ray_at_unit_depth(middle_px(row, 0)).y();
  const double x = -(across_C.y() * y + across_C.z()) / across_C.x();
  const double col = (geometry.center_u_px + geometry.focal_px * x) / DepthBlocks::kBlockPx;
  return std::abs(col) < kMaxCol ? static_cast<int>(std::floor(col)) : -1;
}

}  // namespace

UprightColumn::UprightColumn(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C,
                             const DepthBlocks& blocks, int col)
    : geometry_(&geometry), down_C_(&down_C), blocks_(&blocks) {
  const Eigen::Vector3d across_C = down_C.cross(geometry.ray_at_unit_depth(middle_px(blocks.rows() / 2, col)));
  for (int row = 0; row < blocks.rows(); ++row) cols_.push_back(upright_col(geometry, across_C, row));
}

int UprightColumn::lowest() const {
  int row = blocks_->rows() - 1;
  while (row >= 0 && !in_image(row)) --row;
  return row;
}

Eigen::Vector3d UprightColumn::ray(int row) const { return geometry_->ray_at_unit_depth(middle_px(row, col(row))); }

int UprightColumn::upright16(int row, double distance_m) const {
  return static_cast<int>(std::ceil(geometry_->disparity16(distance_m / horizontal_per_z(row))));
}

UprightColumns::UprightColumns(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C,
                               const DepthBlocks& blocks)
    : geometry_(geometry), down_C_(down_C), rows_(blocks.rows()), first_(-blocks.rows()) {
  // At a tilt of 45 degrees, columns enter the image from as many blocks outside it as it has rows.
  for (int col = first_; col < blocks.cols() + blocks.rows(); ++col) {
    columns_.emplace_back(geometry, down_C, blocks, col);
  }
}

int UprightColumns::of(int row, int col) const {
  const Eigen::Vector3d across_C = down_C_.cross(geometry_.ray_at_unit_depth(middle_px(row, col)));
  const int index = upright_col(geometry_, across_C, rows_ / 2) - first_;
  return index >= 0 && index < static_cast<int>(columns_.size()) ? index : -1;
}

}  // namespace hedgehop::vision::mapping
