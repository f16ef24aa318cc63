#include "sim/render/tiles/sun_blocks.h"

#include <algorithm>

namespace hedgehop::sim::tiles {

namespace {

size_t index(int row, int column, int across) {
  return static_cast<size_t>(row) * static_cast<size_t>(across) + static_cast<size_t>(column);
}

/// Columns or rows of a block, both ends included.
struct Side {
  int first, last;

  Side(int block, int log2, int stride) : first(block << log2), last(std::min(((block + 1) << log2), stride) - 1) {}
};

SunBlock block_of(const float* depths, int stride, const Side& rows, const Side& columns) {
  const int row = std::min((rows.first + rows.last) / 2, stride - 2);
  const int column = std::min((columns.first + columns.last) / 2, stride - 2);
  const float here = depths[index(row, column, stride)];
  SunBlock block{1.0f, -1e9f, depths[index(row, column + 1, stride)] - here,
                 depths[index(row + 1, column, stride)] - here};
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const float depth = depths[index(y, x, stride)];
      block.least = std::min(block.least, depth);
      block.most = std::max(block.most,
                            depth - block.right * static_cast<float>(x - 1) - block.down * static_cast<float>(y - 1));
    }
  }
  return block;
}

/// Widens a block to hold what one of its quarters does.
void widen(SunBlock& block, const SunBlock& part, const Side& rows, const Side& columns) {
  block.least = std::min(block.least, part.least);
  for (const int y : {rows.first, rows.last}) {
    for (const int x : {columns.first, columns.last}) {
      block.most = std::max(block.most, part.most + (part.right - block.right) * static_cast<float>(x - 1) +
                                            (part.down - block.down) * static_cast<float>(y - 1));
    }
  }
}

}  // namespace

SunBlocks make_sun_blocks(const float* depths, int stride, std::vector<SunBlock> (&blocks)[SunBlocks::kLevels]) {
  SunBlocks result{};
  for (int level = 0, log2 = SunBlocks::kFirstLog2; level < SunBlocks::kLevels; ++level, ++log2) {
    const int across = (stride + (1 << log2) - 1) >> log2;
    blocks[level].clear();
    for (int row = 0; row < across; ++row) {
      for (int column = 0; column < across; ++column) {
        if (level == 0) {
          blocks[0].push_back(block_of(depths, stride, {row, log2, stride}, {column, log2, stride}));
          continue;
        }
        const int parts = result.across[level - 1];
        SunBlock block = blocks[level - 1][index(2 * row, 2 * column, parts)];
        for (int y = 2 * row; y < std::min(2 * row + 2, parts); ++y) {
          for (int x = 2 * column; x < std::min(2 * column + 2, parts); ++x) {
            widen(block, blocks[level - 1][index(y, x, parts)], {y, log2 - 1, stride}, {x, log2 - 1, stride});
          }
        }
        blocks[level].push_back(block);
      }
    }
    result.levels[level] = blocks[level].data();
    result.across[level] = across;
  }
  return result;
}

}  // namespace hedgehop::sim::tiles
