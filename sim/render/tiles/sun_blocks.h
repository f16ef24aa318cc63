#pragma once

#include <vector>

namespace hedgehop::sim::tiles {

/// Between what the depths in a block of the sun's map lie: all are at least `least`, and that of column x and row y is
/// at most most + right * x + down * y, which is close where the block shows one plane.
struct SunBlock {
  float least, most, right, down;
};

/// Blocks of the sun's map, level by level, each of twice the side of the one before: whether all of a region is lit or
/// in shadow is seen in few of them.
struct SunBlocks {
  static constexpr int kLevels = 6;
  static constexpr int kFirstLog2 = 3;  ///< side of the first level's blocks, texels

  const SunBlock* levels[kLevels];
  int across[kLevels];  ///< blocks in a row
};

/// @param depths  of a map with its border, which is column and row -1. @param stride  texels a side.
/// @param blocks  memory that the result points into.
SunBlocks make_sun_blocks(const float* depths, int stride, std::vector<SunBlock> (&blocks)[SunBlocks::kLevels]);

}  // namespace hedgehop::sim::tiles
