#include "scenes/map/building_mesh.h"

#include <utility>

#include "scenes/map/building_body.h"
#include "scenes/mesh/bodies.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/worlds/city_mesh.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Adds triangles with a texture. @param origin_W  of the triangles' points.
void add_faces(const std::vector<BuildingBody::Triangle>& faces, const Vector3d& origin_W, const mesh::Cover& cover,
               mesh::MeshBuilder& mesh) {
  mesh::Polyhedron body;
  for (const BuildingBody::Triangle& face : faces) {
    const auto first = static_cast<uint32_t>(body.corners.size());
    for (const Vector3d& p : face) body.corners.push_back(origin_W + p);
    body.faces.push_back({first, first + 1, first + 2});
  }
  mesh::add_polyhedron(body, mesh::Shading::flat, cover, mesh);
}

/// Adds the walls of a ring up to the eaves.
void add_walls(const PlanRing& ring, const Vector3d& origin_W, double bottom_m, double eaves_m,
               const worlds::Elevation& elevation, const TownTextures& town, Random& random, mesh::MeshBuilder& mesh) {
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d right = ring[i], left = ring[(i + 1) % ring.size()];
    const mesh::TexturedPanel wall{origin_W + Vector3d(left.x(), left.y(), -eaves_m),
                                   {right.x() - left.x(), right.y() - left.y(), 0.0},
                                   {0.0, 0.0, eaves_m - bottom_m}};
    worlds::add_wall(wall, elevation, town.city, random, nullptr, mesh);
  }
}

}  // namespace

void add_map_building(const MapBuilding& building, const Ground& ground, const TownTextures& town, Random& random,
                      mesh::MeshBuilder& mesh, std::vector<Solid>& solids, std::vector<std::string>& faults) {
  std::vector<Vector2d> outline_NE;
  for (const Footprint& footprint : building.footprints)
    outline_NE.insert(outline_NE.end(), footprint.outer.begin(), footprint.outer.end());
  const std::optional<double> ground_m = ground.lowest_m(outline_NE);
  if (!ground_m) {
    faults.push_back(building.name + ": left out, since the terrain has no height at its outline");
    return;
  }
  const int style = uniform_index(random, static_cast<int>(textures::facade_styles().size()));
  const double wall_m = building.eaves_m() - building.min_height_m;
  const worlds::Elevation elevation = worlds::random_elevation(style, wall_m, building.min_height_m <= 0.0, random);
  const uint32_t flat_roof = town.city.roofs[static_cast<size_t>(uniform_index(random, 2))];
  const Vector2d shift(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
  const mesh::Cover tiles{town.roof_tiles, textures::kWallTileM, shift}, plain{flat_roof, textures::kRoofTileM, shift};

  mesh.begin_instance(building.name, SemanticClass::building);
  for (const Footprint& footprint : building.footprints) {
    const BuildingBody body = body_of(footprint, building, faults);
    if (body.hulls.empty()) continue;
    const Vector3d origin_W(body.middle_NE.x(), body.middle_NE.y(), -*ground_m);
    mesh.begin_chunk(false);
    for (const PlanRing& ring : body.walls)
      add_walls(ring, origin_W, building.min_height_m, body.eaves_m, elevation, town, random, mesh);
    add_faces(body.roof, origin_W, body.eaves_m < building.height_m ? tiles : plain, mesh);
    add_faces(body.gables, origin_W, plain, mesh);
    add_faces(body.bottom, origin_W, plain, mesh);
    for (const mesh::Polyhedron& hull : body.hulls) {
      Solid solid{.name = building.name, .shape = Solid::Shape::hull, .polyhedron = hull};
      solid.X_WS.translation() = origin_W;
      solids.push_back(std::move(solid));
    }
  }
}

}  // namespace hedgehop::scenes::map
