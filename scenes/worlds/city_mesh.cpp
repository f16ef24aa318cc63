#include "scenes/worlds/city_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/textures/city_textures.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/worlds/wear.h"

namespace hedgehop::scenes::worlds {

namespace {

enum class GroundUse { country, near_country, street, lot };

// A strip of the plan between two grid lines along one axis.
struct GroundStrip {
  GroundUse band;
  double low_m;
  double high_m;
  int field = 0;  // strips with equal numbers belong to one field
};

// Strips from the far south (west) to the far north (east): grass, alternating streets and lots, grass.
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

// Returns the panel that covers a rectangle of the ground; if `rotated`, up in the image is east instead of north.
mesh::TexturedPanel ground_panel(const GroundStrip& north, const GroundStrip& east, bool rotated) {
  const double size_north = north.high_m - north.low_m, size_east = east.high_m - east.low_m;
  if (rotated) return {{north.high_m, east.high_m, 0.0}, {-size_north, 0.0, 0.0}, {0.0, -size_east, 0.0}};
  return {{north.high_m, east.low_m, 0.0}, {0.0, size_east, 0.0}, {-size_north, 0.0, 0.0}};
}

bool in_country(GroundUse band) { return band == GroundUse::country || band == GroundUse::near_country; }

bool on_road(const GroundStrip& north, const GroundStrip& east) {
  if (in_country(north.band) || in_country(east.band)) return false;
  return north.band == GroundUse::street || east.band == GroundUse::street;
}

// Crop on a third of the fields away from the city; grass elsewhere.
uint32_t country_image(const GroundStrip& north, const GroundStrip& east, const textures::CityTextures& city,
                       uint64_t seed) {
  if (north.band != GroundUse::country && east.band != GroundUse::country) return city.grass;
  const uint64_t row_seed = derived_seed(seed, static_cast<uint64_t>(north.field));
  return derived_seed(row_seed, static_cast<uint64_t>(east.field)) % 3 == 0 ? city.field : city.grass;
}

constexpr double kStreetInsetM = 1.9;  // of repairs, from the sides of a street

void add_cell(const GroundStrip& north, const GroundStrip& east, const textures::CityTextures& city,
              uint64_t field_seed, Random& random, Wear* wear, mesh::MeshBuilder& mesh) {
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
    const mesh::ImageArea area{0.0, shift, 1.0, shift + repeats};
    if (wear) {
      add_worn(panel, area, kStreetInsetM, *wear, mesh);
    } else {
      mesh.add(panel, area, city.streets[static_cast<size_t>(choice % 2)]);
    }
  }
}

}  // namespace

void add_city_ground(const UrbanPlan& plan, const textures::CityTextures& city, uint64_t seed, bool wear,
                     mesh::MeshBuilder& mesh) {
  Random random(derived_seed(seed, 0));
  const uint64_t field_seed = derived_seed(seed, 1);
  Wear repairs{
      {city.streets.begin(), city.streets.end()}, city.repairs, textures::kGrassTileM, Random(derived_seed(seed, 2))};
  constexpr size_t kStripsPerChunk = 4;  // two cells of the city
  const std::vector<GroundStrip> strips = strips_along_axis(plan);
  const uint32_t ground = mesh.begin_instance("ground", SemanticClass::ground);
  const uint32_t road = mesh.begin_instance("road", SemanticClass::road);
  for (size_t row = 0; row < strips.size(); row += kStripsPerChunk) {
    for (size_t column = 0; column < strips.size(); column += kStripsPerChunk) {
      mesh.begin_chunk(false);
      for (size_t r = row; r < std::min(row + kStripsPerChunk, strips.size()); ++r) {
        for (size_t c = column; c < std::min(column + kStripsPerChunk, strips.size()); ++c) {
          mesh.resume_instance(on_road(strips[r], strips[c]) ? road : ground);
          add_cell(strips[r], strips[c], city, field_seed, random, wear ? &repairs : nullptr, mesh);
        }
      }
    }
  }
}

namespace {

// A sequence of complete cells (bays or floors) within one repeat of the texture.
struct CellSpan {
  int first_cell;  // within the texture
  int cell_count;
  double start;  // as a share of the wall's width or height, 0..1
  double end;
};

// Returns spans of `size` of `count` cells, each with a random part of the texture.
std::vector<CellSpan> random_spans(int count, int size, int cells_per_image, Random& random) {
  std::vector<CellSpan> result;
  for (int done = 0; done < count;) {
    const int cells = std::min({size, count - done, cells_per_image});
    const double start = static_cast<double>(done) / count, end = static_cast<double>(done + cells) / count;
    result.push_back({uniform_index(random, cells_per_image - cells + 1), cells, start, end});
    done += cells;
  }
  return result;
}

// Divides `count` cells, starting with cell `offset` of the texture, at the repeats of the texture.
std::vector<CellSpan> cell_spans(int count, int offset, int cells_per_image) {
  std::vector<CellSpan> result;
  for (int done = 0; done < count;) {
    const int first = (offset + done) % cells_per_image;
    const int cells = std::min(cells_per_image - first, count - done);
    result.push_back({first, cells, static_cast<double>(done) / count, static_cast<double>(done + cells) / count});
    done += cells;
  }
  return result;
}

// Returns the part of a panel between two shares of its width and two distances below its top.
mesh::TexturedPanel part(const mesh::TexturedPanel& wall, double left, double right, double top_m, double bottom_m) {
  const Eigen::Vector3d down = wall.down_m.normalized();
  const auto at = [&](double share) -> Eigen::Vector3d { return wall.top_left_W + share * wall.right_m; };
  return {at(left) + top_m * down, at(right) - at(left), (bottom_m - top_m) * down};
}

// Floors of a box, equal on its four walls.
struct Elevation {
  int style = 0;
  double cornice_m = textures::kCorniceM;  // height at the top
  double shop_m = 0.0;                     // height of the shops at the bottom, 0: no shops
  int first_floor = 0;                     // within the texture
};

void add_wall(const mesh::TexturedPanel& wall, const Elevation& elevation, const textures::CityTextures& city,
              Random& random, Random* wear, mesh::MeshBuilder& mesh) {
  const textures::FacadeStyle& style = textures::facade_styles()[static_cast<size_t>(elevation.style)];
  const double width = wall.right_m.norm(), height = wall.down_m.norm();
  const double floors_top = elevation.cornice_m, floors_bottom = height - elevation.shop_m;
  const int bays = std::max(1, static_cast<int>(std::lround(width / style.bay_m())));
  const int floors = std::max(1, static_cast<int>(std::lround((floors_bottom - floors_top) / style.floor_m())));
  auto columns = cell_spans(bays, uniform_index(random, style.bays), style.bays);
  auto rows = cell_spans(floors, elevation.first_floor, style.floors);
  if (wear) columns = random_spans(bays, 2, style.bays, *wear);

  // Complete shops across the wall.
  const double shops = std::max(1.0, std::round(width * textures::kShopBays / textures::kTrimTileM));
  const double shop_u = static_cast<double>(uniform_index(random, textures::kShopBays)) / textures::kShopBays;
  const double shop_v = uniform_index(random, textures::kShopStrips) * textures::kShopM / textures::kTrimTileM;
  const uint32_t trim = city.trims[static_cast<size_t>(uniform_index(random, 2))];
  const double cornice_v = textures::kShopStrips * textures::kShopM / textures::kTrimTileM;

  int first_variant = uniform_index(random, textures::CityTextures::kFacadeVariants);
  for (const CellSpan& column : columns) {
    int variant = first_variant++;  // horizontal and vertical neighbors always differ
    if (wear) rows = random_spans(floors, 1, style.floors, *wear);
    for (const CellSpan& row : rows) {
      const double depth = floors_bottom - floors_top;
      const mesh::TexturedPanel panel =
          part(wall, column.start, column.end, floors_top + row.start * depth, floors_top + row.end * depth);
      const int bay = wear ? uniform_index(*wear, style.bays - column.cell_count + 1) : column.first_cell;
      const mesh::ImageArea area{static_cast<double>(bay) / style.bays,
                                 static_cast<double>(row.first_cell) / style.floors,
                                 static_cast<double>(bay + column.cell_count) / style.bays,
                                 static_cast<double>(row.first_cell + row.cell_count) / style.floors};
      if (wear) variant = uniform_index(*wear, textures::CityTextures::kFacadeVariants);
      mesh.add(panel, area, city.facade(elevation.style, variant++ % textures::CityTextures::kFacadeVariants));
    }
    if (elevation.cornice_m > 0.0) {
      mesh.add(part(wall, column.start, column.end, 0.0, floors_top),
               {column.start * width / textures::kTrimTileM, cornice_v, column.end * width / textures::kTrimTileM, 1.0},
               trim);
    }
    if (elevation.shop_m > 0.0) {
      mesh.add(part(wall, column.start, column.end, floors_bottom, height),
               {shop_u + column.start * shops / textures::kShopBays, shop_v,
                shop_u + column.end * shops / textures::kShopBays, shop_v + textures::kShopM / textures::kTrimTileM},
               trim);
    }
  }
}

}  // namespace

void add_building(const Building& building, const textures::CityTextures& city, Random& random, Random* wear,
                  mesh::MeshBuilder& mesh) {
  constexpr double kMinFloorM = 2.0;
  const int style = uniform_index(random, static_cast<int>(textures::facade_styles().size()));
  for (size_t k = 0; k < building.boxes_W.size(); ++k) {
    const Eigen::AlignedBox3d& box_W = building.boxes_W[k];
    const bool housing = building.has_roof_housing && k + 1 == building.boxes_W.size();
    const uint32_t roof = city.roofs[static_cast<size_t>(uniform_index(random, 2))];
    const Eigen::Vector2d roof_shift(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    mesh.begin_chunk(true);
    mesh.add_tiled(mesh::top_panel(box_W), textures::kRoofTileM, roof_shift, roof);
    if (housing) {
      for (const mesh::TexturedPanel& wall : mesh::side_panels(box_W))
        mesh.add_tiled(wall, textures::kRoofTileM, roof_shift, roof);
      continue;
    }
    Elevation elevation;
    elevation.style = style;
    elevation.first_floor = uniform_index(random, textures::facade_styles()[static_cast<size_t>(style)].floors);
    const double height = box_W.sizes().z();
    if (height < textures::kCorniceM + kMinFloorM) elevation.cornice_m = 0.0;
    if (k == 0 && height > textures::kShopM + textures::kCorniceM + kMinFloorM) elevation.shop_m = textures::kShopM;
    for (const mesh::TexturedPanel& wall : mesh::side_panels(box_W))
      add_wall(wall, elevation, city, random, wear, mesh);
  }
}

}  // namespace hedgehop::scenes::worlds
