#pragma once

#include <vector>

#include "scenes/terrain/surface_grid.h"

namespace hedgehop::scenes::terrain {

/// Fewer triangles for a block. They meet the surface at the border of the block, so that there is no gap next to
/// blocks with all triangles.
struct CoarseBlock {
  std::vector<GridTriangle> triangles;  ///< empty if the block is too small or has an unknown sample
  double error_m = 0.0;                 ///< maximum distance of the surface from these triangles
};

/// Returns a coarse form of a block: every fourth sample inside, and all samples of the border.
CoarseBlock coarse_block(const SurfaceGrid& grid, const GridBlock& block);

}  // namespace hedgehop::scenes::terrain
