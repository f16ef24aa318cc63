#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// What a square of pixels of the left image shows.
struct DepthBlock {
  enum class Kind : uint8_t {
    unknown,  ///< too few pixels were matched: neither far nor free
    matched,
    smeared,  ///< matched, but so near to what is plain that another surface may show
    sky,      ///< not matched, or smeared, and recognized by find_sky()
    line,     ///< as sky, but for something thin and dark in it, of unknown distance
  };
  Kind kind = Kind::unknown;
  int16_t near16 = -1;  ///< disparity x 16 of its nearest surface; -1 where nothing was matched
  int16_t foot16 = -1;  ///< of sky and line: of what would stand upright where the ground of its column ends
  uint8_t grey = 0;     ///< mean
  uint8_t range = 0;    ///< greatest less least grey of its four quarters
  bool lined = false;   ///< holds something thin that is darker than what is on both sides of it
};

/// A disparity image in squares, each with its nearest surface: a few thousand rays instead of a quarter of a million,
/// and none that passes by something nearer. Inverse depth has one uncertainty for all pixels and all distances,
/// [Matthies2014] sec. III; it becomes a length only where free space ends.
/// Differs: the paper plans in the image; we carry what was seen into a map, since the vehicle turns away from it.
class DepthBlocks {
 public:
  static constexpr int kBlockPx = 8;

  /// @param disparity16  CV_16SC1, disparity x 16, negative where nothing was matched.
  /// @param grey  CV_8UC1 of equal size, or empty: then there are no greys, and no sky is found.
  /// @param smear_px  half the edge of the matcher's window, >= 0. Where one half of the window is plain, the other
  /// half decides what is matched: so near to what is plain, nothing is seen through for certain.
  void build(const cv::Mat& disparity16, const cv::Mat& grey, int smear_px);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  const DepthBlock& at(int row, int col) const { return blocks_[static_cast<size_t>(row * cols_ + col)]; }
  DepthBlock& at(int row, int col) { return blocks_[static_cast<size_t>(row * cols_ + col)]; }
  /// Share of blocks of a kind, in [0, 1].
  double share(DepthBlock::Kind kind) const;

 private:
  int rows_ = 0, cols_ = 0;
  std::vector<DepthBlock> blocks_;
  cv::Mat valleys_;  ///< CV_8UC1, grey levels by which a pixel is darker than what is on both sides of it
  cv::Mat smeared_;  ///< 255 where a pixel is so near to what is plain, else 0
};

/// Recognizes sky: it cannot be matched, and without it nothing flies in the open. A block is sky only on evidence:
/// - below the horizon, which attitude predicts, its column ends in ground matched at 15 m or farther, level, without
///   a gap from the image's edge; a column is upright in the world, however the camera is tilted;
/// - from there up nothing was matched that is nearer than 15 m;
/// - above what was matched its column is smooth, and as bright as the sky of columns near to ground at 25 m is in
///   its row: where there are none, there is no sky.
/// What is thin and dark before it, a wire or a bare branch, is matched late or never, and stays apart as a line: up to
/// three blocks of a column.
/// With it goes what lies between that ground and the horizon. A plain wall stands on ground that is nearer, a plain
/// box in the air has edges or another brightness: both stay unknown. And a wall would stand at the end of
/// that ground: `foot16` says how far sky is free at least. A plain ceiling over far ground, with no sky beside it,
/// passes for sky. Differs from [Andert2007] eq. (6) to (8), where
/// all that is bright and without texture is infinitely far.
/// @param down_C  the vertical in C, of length 1. @return blocks of sky found.
int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks);

}  // namespace hedgehop::vision::mapping
