#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "scenes/additions.h"
#include "scenes/clearing.h"
#include "scenes/scene.h"

namespace hedgehop::scenes::worlds {

/// A city of random sized buildings arranged approximately in a grid, with open space around it [Garratt2009] sec. 4.1,
/// figs. 4 and 5. Each cell of `pitch` x `pitch` holds one building inside its lot, the cell less half a street on
/// every side, so that no two buildings are nearer to each other than `street_min_width`. Footprints are axis aligned.
/// The paper prints the extent, start and goal; sizes and heights are ours.
struct UrbanConfig {
  static constexpr std::string_view kName = "urban";
  static constexpr std::string_view kMeaning =
      "a city of random sized buildings roughly on a grid, open space around it";

  double extent_m = 300.0;  ///< floor(extent / pitch) cells each way
  double pitch_m = 30.0;
  double street_min_width_m = 8.0;
  double min_footprint = 0.55;  ///< share of the lot's side
  double max_footprint = 1.0;
  double jitter = 1.0;     ///< share of the free play inside the lot
  double occupancy = 1.0;  ///< probability that a cell has a building
  double min_height_m = 16.0;
  double max_height_m = 40.0;
  double setback_share = 0.3;  ///< of buildings that carry a narrower tower
  std::vector<Clearing> keep_clear = {{-130.0, 80.0, 6.0}, {110.0, -110.0, 6.0}};
  int64_t texture_size_px = 512;
  SceneAdditions added;
};

template <class Visitor>
void describe(Visitor& v, UrbanConfig& c) {
  v("extent", c.extent_m,
    {.unit = "m", .above = 0.0, .meaning = "side of the square of cells, centered on the origin"});
  v("pitch", c.pitch_m,
    {.unit = "m", .above = 0.0, .meaning = "side of a cell: one building and half of each street around it"});
  v("street_min_width", c.street_min_width_m,
    {.unit = "m", .at_least = 1.0, .meaning = "smallest gap between two buildings"});
  v("min_footprint", c.min_footprint,
    {.above = 0.0, .at_most = 1.0, .meaning = "smallest side of a building, as a share of pitch - street_min_width"});
  v("max_footprint", c.max_footprint,
    {.above = 0.0, .at_most = 1.0, .meaning = "largest side of a building, as a share of pitch - street_min_width"});
  v("jitter", c.jitter,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "0: buildings centered in their cells, 1: anywhere inside"});
  v("occupancy", c.occupancy, {.at_least = 0.0, .at_most = 1.0, .meaning = "probability that a cell holds a building"});
  v("min_height", c.min_height_m,
    {.unit = "m", .at_least = 3.0, .at_most = 1000.0, .meaning = "every point of a roof is at least this high"});
  v("max_height", c.max_height_m, {.unit = "m", .at_least = 3.0, .at_most = 1000.0, .meaning = "nothing is higher"});
  v("setback_share", c.setback_share,
    {.at_least = 0.0, .at_most = 1.0, .meaning = "share of the buildings that carry a narrower tower"});
  v("keep_clear", c.keep_clear, {.meaning = "discs of the plan without buildings: start, goal"});
  v("texture_size", c.texture_size_px,
    {.unit = "px",
     .at_least = 64.0,
     .at_most = 2048.0,
     .meaning = "side of the images on the surfaces, a power of two"});
  describe(v, c.added);
}

/// Returns the city of `config`, a function of its arguments alone.
/// @throws std::invalid_argument naming the field, its value and what is valid.
Scene make_urban(const UrbanConfig& config, uint64_t seed);

}  // namespace hedgehop::scenes::worlds
