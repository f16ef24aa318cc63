#include "scenes/worlds/city_ground.h"

#include <algorithm>
#include <vector>

#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::worlds {
namespace {

enum class GroundUse { country, near_country, street, lot };

// A strip of the plan between two grid lines, along one axis.
struct GroundStrip {
  GroundUse band;
  double low_m;
  double high_m;
  int field = 0;  // strips of one number make fields together
};

// From the far south (west) to the far north (east): grass, then streets and lots in turn, then grass.
std::vector<GroundStrip> strips_along_axis(const UrbanPlan& plan) {
  const double half_street = 0.5 * plan.street_width_m;
  const double city = plan.cell_edge_m(plan.cells_per_side) + half_street;
  const std::vector<double> rings = {city + kGroundMarginM, city + 1000.0, city + 250.0, city + 60.0, city};
  const auto band = [&](size_t ring) {
    return ring + 2 == rings.size() ? GroundUse::near_country : GroundUse::country;
  };
  std::vector<GroundStrip> strips;
  for (size_t k = 0; k + 1 < rings.size(); ++k) strips.push_back({band(k), -rings[k], -rings[k + 1]});
  for (int k = 0; k <= plan.cells_per_side; ++k) {
    const double edge = plan.cell_edge_m(k);
    strips.push_back({GroundUse::street, edge - half_street, edge + half_street});
    if (k < plan.cells_per_side) {
      strips.push_back({GroundUse::lot, edge + half_street, plan.cell_edge_m(k + 1) - half_street});
    }
  }
  for (size_t k = rings.size() - 1; k > 0; --k) strips.push_back({band(k - 1), rings[k], rings[k - 1]});

  constexpr int kStripsPerField = 6;  // three cells of the city
  for (size_t k = 0; k < strips.size(); ++k) {
    const bool country = strips[k].band == GroundUse::country;
    strips[k].field = country ? -static_cast<int>(k) : static_cast<int>(k) / kStripsPerField;
  }
  return strips;
}

// The panel that covers a rectangle of the ground; `rotated`: the image's up is east instead of north.
mesh::TexturedPanel ground_panel(const GroundStrip& north, const GroundStrip& east, bool rotated) {
  const double size_north = north.high_m - north.low_m, size_east = east.high_m - east.low_m;
  if (rotated) return {{north.high_m, east.high_m, 0.0}, {-size_north, 0.0, 0.0}, {0.0, -size_east, 0.0}};
  return {{north.high_m, east.low_m, 0.0}, {0.0, size_east, 0.0}, {-size_north, 0.0, 0.0}};
}

bool in_country(GroundUse band) { return band == GroundUse::country || band == GroundUse::near_country; }

// Crop on a third of the fields, from some way off the city; grass on the rest.
uint32_t country_image(const GroundStrip& north, const GroundStrip& east, const textures::CityTextures& city,
                       uint64_t seed) {
  if (north.band != GroundUse::country && east.band != GroundUse::country) return city.grass;
  const uint64_t row_seed = derived_seed(seed, static_cast<uint64_t>(north.field));
  return derived_seed(row_seed, static_cast<uint64_t>(east.field)) % 3 == 0 ? city.field : city.grass;
}

void add_cell(const GroundStrip& north, const GroundStrip& east, const textures::CityTextures& city,
              uint64_t field_seed, Random& random, mesh::MeshBuilder& mesh) {
  const double shift = uniform(random, 0.0, 1.0);
  const int choice = uniform_index(random, 6);
  const bool rotated = chance(random, 0.5);
  if (in_country(north.band) || in_country(east.band)) {
    const mesh::TexturedPanel panel = ground_panel(north, east, false);
    const Eigen::Vector2d offset(panel.top_left_W.y() / textures::kGrassTileM,
                                 -panel.top_left_W.x() / textures::kGrassTileM);
    mesh.add_tiled(panel, textures::kGrassTileM, offset, country_image(north, east, city, field_seed));
  } else if (north.band == GroundUse::street && east.band == GroundUse::street) {
    mesh.add(ground_panel(north, east, rotated), {}, city.crossing);
  } else if (north.band == GroundUse::lot && east.band == GroundUse::lot) {
    mesh.add_tiled(ground_panel(north, east, rotated), textures::kLotTileM, {shift, shift},
                   city.lots[static_cast<size_t>(choice % 3)]);
  } else {
    const bool runs_east = north.band == GroundUse::street;
    const mesh::TexturedPanel panel = ground_panel(north, east, runs_east);
    const double repeats = panel.down_m.norm() / panel.right_m.norm();
    mesh.add(panel, {0.0, shift, 1.0, shift + repeats}, city.streets[static_cast<size_t>(choice % 2)]);
  }
}

}  // namespace

void add_city_ground(const UrbanPlan& plan, const textures::CityTextures& city, uint64_t seed,
                     mesh::MeshBuilder& mesh) {
  Random random(derived_seed(seed, 0));
  const uint64_t field_seed = derived_seed(seed, 1);
  constexpr size_t kStripsPerChunk = 4;  // two cells of the city
  const std::vector<GroundStrip> strips = strips_along_axis(plan);
  for (size_t row = 0; row < strips.size(); row += kStripsPerChunk) {
    for (size_t column = 0; column < strips.size(); column += kStripsPerChunk) {
      mesh.begin_chunk(false);
      for (size_t r = row; r < std::min(row + kStripsPerChunk, strips.size()); ++r) {
        for (size_t c = column; c < std::min(column + kStripsPerChunk, strips.size()); ++c) {
          add_cell(strips[r], strips[c], city, field_seed, random, mesh);
        }
      }
    }
  }
}

}  // namespace hedgehop::scenes::worlds
