#include "scenes/mesh/building_mesh.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/textures/facade_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/textures/trim_textures.h"

namespace hedgehop::scenes::mesh {
namespace {

// A stretch of whole cells (bays or floors) within one repeat of the image.
struct CellSpan {
  int first_cell;  // within the image
  int cell_count;
  double start;  // share of the wall's side, 0..1
  double end;
};

// Cuts `count` cells, starting with the image's cell `offset`, where the image repeats.
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

// The part of a panel between two shares of its width and two depths below its top.
TexturedPanel part(const TexturedPanel& wall, double left, double right, double top_m, double bottom_m) {
  const Eigen::Vector3d down = wall.down_m.normalized();
  const auto at = [&](double share) -> Eigen::Vector3d { return wall.top_left_W + share * wall.right_m; };
  return {at(left) + top_m * down, at(right) - at(left), (bottom_m - top_m) * down};
}

// Storeys of a box, the same on its four walls.
struct Elevation {
  int style = 0;
  double cornice_m = textures::kCorniceM;  // height at the top
  double shop_m = 0.0;                     // height at the foot, 0: no shops
  int first_floor = 0;                     // within the image
};

void add_wall(const TexturedPanel& wall, const Elevation& elevation, const textures::CityTextures& city, Random& random,
              MeshBuilder& mesh) {
  const textures::FacadeStyle& style = textures::facade_styles()[static_cast<size_t>(elevation.style)];
  const double width = wall.right_m.norm(), height = wall.down_m.norm();
  const double floors_top = elevation.cornice_m, floors_bottom = height - elevation.shop_m;
  const int bays = std::max(1, static_cast<int>(std::lround(width / style.bay_m())));
  const int floors = std::max(1, static_cast<int>(std::lround((floors_bottom - floors_top) / style.floor_m())));
  const auto columns = cell_spans(bays, uniform_index(random, style.bays), style.bays);
  const auto rows = cell_spans(floors, elevation.first_floor, style.floors);

  // Whole shops across the wall.
  const double shops = std::max(1.0, std::round(width * textures::kShopBays / textures::kTrimTileM));
  const double shop_u = static_cast<double>(uniform_index(random, textures::kShopBays)) / textures::kShopBays;
  const double shop_v = uniform_index(random, textures::kShopStrips) * textures::kShopM / textures::kTrimTileM;
  const uint32_t trim = city.trims[static_cast<size_t>(uniform_index(random, 2))];
  const double cornice_v = textures::kShopStrips * textures::kShopM / textures::kTrimTileM;

  int first_variant = uniform_index(random, textures::CityTextures::kFacadeVariants);
  for (const CellSpan& column : columns) {
    const double u0 = static_cast<double>(column.first_cell) / style.bays;
    const double u1 = static_cast<double>(column.first_cell + column.cell_count) / style.bays;
    int variant = first_variant++;  // neighbors sideways and up and down always differ
    for (const CellSpan& row : rows) {
      const double depth = floors_bottom - floors_top;
      const TexturedPanel panel =
          part(wall, column.start, column.end, floors_top + row.start * depth, floors_top + row.end * depth);
      const ImageArea area{u0, static_cast<double>(row.first_cell) / style.floors, u1,
                           static_cast<double>(row.first_cell + row.cell_count) / style.floors};
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

void add_building(const worlds::Building& building, const textures::CityTextures& city, Random& random,
                  MeshBuilder& mesh) {
  constexpr double kMinStoreyM = 2.0;
  const int style = uniform_index(random, static_cast<int>(textures::facade_styles().size()));
  for (size_t k = 0; k < building.boxes_W.size(); ++k) {
    const Eigen::AlignedBox3d& box_W = building.boxes_W[k];
    const bool housing = building.has_roof_housing && k + 1 == building.boxes_W.size();
    const uint32_t roof = city.roofs[static_cast<size_t>(uniform_index(random, 2))];
    const Eigen::Vector2d roof_shift(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
    mesh.begin_chunk(true);
    mesh.add_tiled(top_panel(box_W), textures::kRoofTileM, roof_shift, roof);
    if (housing) {
      for (const TexturedPanel& wall : side_panels(box_W)) mesh.add_tiled(wall, textures::kRoofTileM, roof_shift, roof);
      continue;
    }
    Elevation elevation;
    elevation.style = style;
    elevation.first_floor = uniform_index(random, textures::facade_styles()[static_cast<size_t>(style)].floors);
    const double height = box_W.sizes().z();
    if (height < textures::kCorniceM + kMinStoreyM) elevation.cornice_m = 0.0;
    if (k == 0 && height > textures::kShopM + textures::kCorniceM + kMinStoreyM) elevation.shop_m = textures::kShopM;
    for (const TexturedPanel& wall : side_panels(box_W)) add_wall(wall, elevation, city, random, mesh);
  }
}

}  // namespace hedgehop::scenes::mesh
