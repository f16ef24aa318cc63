#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

struct GroundPlane;

/// Depth of a square block of pixels in the left image.
struct DepthBlock {
  enum class Kind : uint8_t {
    unknown,  ///< too few matched pixels: neither far nor free
    matched,
    smeared,  ///< matched, but so close to an untextured area that the disparity may belong to another surface
    sky,      ///< unmatched or smeared, and recognized by find_sky()
    line,     ///< sky with a thin dark object of unknown distance in it
    plain,    ///< unmatched, and recognized by find_plain() as a plain surface on the ground, or as farther
  };
  Kind kind = Kind::unknown;
  int16_t near16 = -1;  ///< disparity x 16 of its nearest surface; -1 if no pixels are matched
  int16_t sigma16 =
      -1;  ///< mean 1-sigma error of the disparity x 16; -1 if all pixels have the same, which is not given
  int16_t foot16 =
      -1;            ///< of sky, line and plain: disparity x 16 of a vertical surface at the end of the column's ground
  uint8_t grey = 0;  ///< mean
  uint8_t range = 0;    ///< range of the mean grey of its four quarters
  bool lined = false;   ///< contains a thin object darker than both sides
  bool stands = false;  ///< of plain: whether a surface at foot16 is likely
  bool thin = false;    ///< whether the nearest surface is a matched line
};

/// A disparity image in square blocks, each with its nearest surface. This gives a few thousand rays instead of a
/// quarter of a million, and no ray passes a nearer surface. Inverse depth has equal uncertainty at all pixels and
/// distances, [Matthies2014] sec. III; it is converted to a length only at the end of free space. Differs: the paper
/// plans in the image; here a map stores the observations, because the vehicle turns away from them.
class DepthBlocks {
 public:
  static constexpr int kBlockPx = 8;

  /// Computes the blocks. @param disparity16  CV_16SC1, disparity x 16, negative at unmatched pixels.
  /// @param grey  CV_8UC1 of equal size, or empty; without it no sky is found.
  /// @param smear_px  half the side of the matcher's window, >= 0. If one half of the window is untextured, the other
  /// half determines the match. Within this distance of an untextured area, free space is therefore uncertain.
  /// @param sigma16  CV_16SC1, 1-sigma error of the disparity x 16 at matched pixels, or empty if it is the same at
  /// all.
  void build(const cv::Mat& disparity16, const cv::Mat& grey, int smear_px, const cv::Mat& sigma16 = {});

  /// Adds thin lines that are as near as the nearest surface of their block, or nearer. Their error is that of
  /// a pair without `sigma16`.
  /// @param lines16  CV_16SC1, disparity x 16 of the line in each block, negative without one. It may have fewer
  /// blocks.
  void add_lines(const cv::Mat& lines16);

  int rows() const { return rows_; }
  int cols() const { return cols_; }
  const DepthBlock& at(int row, int col) const { return blocks_[static_cast<size_t>(row * cols_ + col)]; }
  DepthBlock& at(int row, int col) { return blocks_[static_cast<size_t>(row * cols_ + col)]; }
  /// Returns the share of blocks of a kind, in [0, 1].
  double share(DepthBlock::Kind kind) const;

 private:
  int rows_ = 0, cols_ = 0;
  std::vector<DepthBlock> blocks_;
  cv::Mat valleys_;  ///< CV_8UC1, grey levels by which a pixel is darker than both sides
  cv::Mat smeared_;  ///< 255 at pixels close to an untextured area, otherwise 0
};

/// Recognizes sky, which stereo cannot match, so that open space above the horizon is free. A column is vertical in the
/// world for every tilt of the camera. A block is sky if:
/// - below the horizon predicted from the attitude, its column ends in ground matched at a horizontal distance of at
/// least
///   15 m, without gaps from the image's border, or next to the upper edge of a plain surface in front of it;
/// - above that ground, no match in the column is closer than 15 m;
/// - above all matches, the column is smooth and as bright as the sky in the same row of columns near ground at 25 m or
///   more. Without such columns there is no sky.
/// Thin dark objects in front of the sky, such as wires or bare branches, are matched only at short range, if at all.
/// Up to three blocks of a column that contain one are marked as `line`. Blocks between that ground and the horizon are
/// also marked as sky. An untextured wall rises from closer ground, and an untextured box in the air has edges or a
/// different brightness; both remain unknown. A wall could rise at the end of the ground: `foot16` gives the minimum
/// free distance of sky. Limitation: an untextured ceiling over far ground without sky next to it is taken for sky.
/// Differs from [Andert2007] eq. (6) to (8), in which every bright pixel without texture is infinitely far.
/// @param down_C  unit vector of the vertical in C. @param ground  plane of level ground; without it, ground beyond
/// plain surfaces is not recognized. @return number of sky blocks found.
int find_sky(const stereo::StereoGeometry& geometry, const Eigen::Vector3d& down_C, DepthBlocks& blocks,
             const GroundPlane* ground = nullptr);

}  // namespace hedgehop::vision::mapping
