#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "scenes/worlds/urban.h"

namespace hedgehop::scenes::worlds {

/// Boxes standing on one another, each within the plan of the one below; the first stands on the ground. Corners are
/// multiples of 1/64 m, so that single-precision meshes and double-precision solids agree exactly.
struct Building {
  int cell = 0;  ///< row-major: south to north, then west to east
  std::vector<Eigen::AlignedBox3d> boxes_W;
  bool has_roof_housing = false;  ///< the last box is a small plant room
};

/// Where the buildings of a city stand, without how they look.
struct UrbanPlan {
  int cells_per_side = 0;
  double pitch_m = 0.0;
  double street_width_m = 0.0;
  std::vector<Building> buildings;

  /// South (or west) edge of cell row (or column) k in 0..cells_per_side, on the middle of a street.
  double cell_edge_m(int k) const { return (k - 0.5 * cells_per_side) * pitch_m; }
};

/// Returns the plan of a city. A cell's building depends on the seed, the cell and the clearings that reach it; where
/// no place is found outside the clearings the cell stays vacant.
/// @throws std::invalid_argument naming the field, its value and what is valid.
UrbanPlan plan_urban(const UrbanConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
