#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/scene.h"
#include "scenes/world_config.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::worlds {

/// A city of random sized buildings arranged approximately in a grid, with open space around it [Garratt2009] sec. 4.1,
/// figs. 4 and 5. Each cell of `pitch` x `pitch` contains one building inside its lot: the cell without half a street
/// on each side. Buildings are therefore at least `street_min_width` apart. Footprints are axis aligned. The paper
/// gives the extent, start and goal, but no sizes or heights.
struct UrbanConfig {
  static constexpr std::string_view kName = "urban";
  static constexpr std::string_view kMeaning =
      "a city of random sized buildings approximately on a grid, with open space around it";

  double extent_m = 300.0;  ///< floor(extent / pitch) cells in each direction
  double pitch_m = 30.0;
  double street_min_width_m = 8.0;
  double min_footprint = 0.55;  ///< share of the lot's side
  double max_footprint = 1.0;
  double jitter = 1.0;     ///< share of the free space inside the lot
  double occupancy = 1.0;  ///< probability that a cell has a building
  double min_height_m = 16.0;
  double max_height_m = 40.0;
  double setback_share = 0.3;  ///< of buildings with a narrower tower on top
  std::vector<Clearing> keep_clear = {{-130.0, 80.0, 6.0}, {110.0, -110.0, 6.0}};
  bool wear = true;
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<UrbanConfig> auto& c) {
  v("extent", c.extent_m,
    {.unit = "m", .above = 0.0, .meaning = "side of the square of cells, centered on the origin"});
  v("pitch", c.pitch_m,
    {.unit = "m", .above = 0.0, .meaning = "side of a cell: one building and half of each adjacent street"});
  v("street_min_width", c.street_min_width_m,
    {.unit = "m", .at_least = 1.0, .meaning = "minimum gap between buildings"});
  v("min_footprint", c.min_footprint,
    {.above = 0.0, .at_most = 1.0, .meaning = "minimum side of a building, as a share of pitch - street_min_width"});
  v("max_footprint", c.max_footprint,
    {.above = 0.0, .at_most = 1.0, .meaning = "maximum side of a building, as a share of pitch - street_min_width"});
  v("jitter", c.jitter,
    {.at_least = 0.0,
     .at_most = 1.0,
     .meaning = "random offset of buildings; 0: centered in their cells, 1: anywhere inside"});
  v("occupancy", c.occupancy,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a cell contains a building"});
  v("min_height", c.min_height_m,
    {.unit = "m", .at_least = 3.0, .at_most = 1000.0, .meaning = "minimum height of every roof"});
  v("max_height", c.max_height_m,
    {.unit = "m", .at_least = 3.0, .at_most = 1000.0, .meaning = "maximum height of every roof"});
  v("setback_share", c.setback_share,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "share of buildings with a narrower tower on top"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan free of buildings, such as start and goal"});
  v("wear", c.wear,
    {.meaning = "whether repairs of the streets and windows of the facades differ from place to place; without, they "
                "repeat"});
  describe_texture_size(v, c.texture_size_px);
  describe(v, c.added);
}

/// Returns the city of `config`. Depends on the arguments only.
/// @throws std::invalid_argument with the field, its value and the valid values.
Scene make_urban(const UrbanConfig& config, uint64_t seed);

/// A stack of boxes on the ground, each within the footprint of the box below. Corners are multiples of 1/64 m, so that
/// single-precision meshes and double-precision solids agree exactly.
struct Building {
  int cell = 0;  ///< row-major: south to north, then west to east
  std::vector<Eigen::AlignedBox3d> boxes_W;
  bool has_roof_housing = false;  ///< the last box is a small plant room
};

/// Layout and shapes of a city's buildings, without their appearance.
struct UrbanPlan {
  int cells_per_side = 0;
  double pitch_m = 0.0;
  double street_width_m = 0.0;
  std::vector<Building> buildings;

  /// Returns the south (west) edge of cell row (column) k in 0..cells_per_side, on the centerline of a street.
  double cell_edge_m(int k) const { return (k - 0.5 * cells_per_side) * pitch_m; }
};

/// Returns the plan of a city. A cell's building depends on the seed, the cell and the clearings that overlap it. If no
/// position outside the clearings is found, the cell remains vacant.
/// @throws std::invalid_argument with the field, its value and the valid values.
UrbanPlan plan_urban(const UrbanConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
