#include "scenes/map/building_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scenes/map/building_body.h"
#include "scenes/map/footprint_shape.h"
#include "scenes/mesh/bodies.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/stone_textures.h"
#include "scenes/textures/street_textures.h"

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

constexpr double kWindowM = 1.5;  // the far detail of a wall has other windows

/// The texture of a building's walls.
struct WallStyle {
  int style = 0;  ///< index into textures::facade_styles()
  int first_bay = 0, first_floor = 0, first_variant = 0;
};

WallStyle random_walls(Random& random) {
  WallStyle walls;
  walls.style = uniform_index(random, static_cast<int>(textures::facade_styles().size()));
  const textures::FacadeStyle& style = textures::facade_styles()[static_cast<size_t>(walls.style)];
  walls.first_bay = uniform_index(random, style.bays);
  walls.first_floor = uniform_index(random, style.floors);
  walls.first_variant = uniform_index(random, textures::CityTextures::kFacadeVariants);
  return walls;
}

/// Adds a wall with complete windows. @param vary  whether neighboring repeats of the texture differ.
void add_wall(const mesh::TexturedPanel& wall, const WallStyle& walls, bool vary, const TownTextures& town,
              mesh::MeshBuilder& mesh) {
  const textures::FacadeStyle& style = textures::facade_styles()[static_cast<size_t>(walls.style)];
  const auto cells = [](double length_m, double cell_m) {
    return std::max(1, static_cast<int>(std::lround(length_m / cell_m)));
  };
  const int bays = cells(wall.right_m.norm(), style.bay_m()), floors = cells(wall.down_m.norm(), style.floor_m());
  const int bays_each = vary ? style.bays : bays, floors_each = vary ? style.floors : floors;
  int variant = walls.first_variant;
  for (int bay = 0; bay < bays; bay += bays_each, ++variant) {
    for (int floor = 0; floor < floors; floor += floors_each, ++variant) {
      const int bays_here = std::min(bays_each, bays - bay), floors_here = std::min(floors_each, floors - floor);
      const mesh::TexturedPanel part{wall.top_left_W + wall.right_m * bay / bays + wall.down_m * floor / floors,
                                     wall.right_m * bays_here / bays, wall.down_m * floors_here / floors};
      const double u = static_cast<double>(walls.first_bay + bay) / style.bays,
                   v = static_cast<double>(walls.first_floor + floor) / style.floors;
      mesh.add(
          part,
          {u, v, u + static_cast<double>(bays_here) / style.bays, v + static_cast<double>(floors_here) / style.floors},
          town.city.facade(walls.style, variant % textures::CityTextures::kFacadeVariants));
    }
  }
}

/// Adds the walls of a footprint. @param bottom_m, top_m  heights above the building's ground.
void add_walls(const std::vector<PlanRing>& rings, const Vector3d& origin_W, double bottom_m, double top_m,
               const WallStyle& walls, bool vary, const TownTextures& town, mesh::MeshBuilder& mesh) {
  WallStyle own = walls;
  for (const PlanRing& ring : rings) {
    for (size_t i = 0; i < ring.size(); ++i, ++own.first_bay) {
      const Vector2d right = ring[i], left = ring[(i + 1) % ring.size()];
      const mesh::TexturedPanel wall{origin_W + Vector3d(left.x(), left.y(), -top_m),
                                     {right.x() - left.x(), right.y() - left.y(), 0.0},
                                     {0.0, 0.0, top_m - bottom_m}};
      add_wall(wall, own, vary, town, mesh);
    }
  }
}

/// Adds upright faces above the eaves, with the plain strip of the walls' texture between two windows.
void add_gables(const std::vector<BuildingBody::Triangle>& faces, const Vector3d& origin_W, const WallStyle& walls,
                const TownTextures& town, mesh::MeshBuilder& mesh) {
  constexpr double kStripM = 0.02, kBaysPerM = 0.002;  // a part of the strip is stretched over the face
  const textures::FacadeStyle& style = textures::facade_styles()[static_cast<size_t>(walls.style)];
  for (const BuildingBody::Triangle& face : faces) {
    const Vector3d n_W = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
    const Vector2d along(-n_W.y(), n_W.x());
    std::array<Vertex, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
      const double bay = walls.first_bay + kStripM + kBaysPerM * along.dot(face[k].head<2>());
      corners[k].p_W = (origin_W + face[k]).cast<float>();
      corners[k].n_W = n_W.cast<float>();
      corners[k].uv = Vector2d(bay / style.bays, face[k].z() / textures::FacadeStyle::kTileM).cast<float>();
      corners[k].texture = town.city.facade(walls.style, walls.first_variant);
    }
    mesh.add(corners, std::array<std::array<uint32_t, 3>, 1>{{{0, 1, 2}}});
  }
}

/// Returns a level roof over a convex outline.
std::vector<BuildingBody::Triangle> level_roof(const PlanRing& outline, double height_m) {
  const auto corner = [&](size_t i) { return Vector3d(outline[i].x(), outline[i].y(), -height_m); };
  std::vector<BuildingBody::Triangle> roof;
  for (size_t i = 2; i < outline.size(); ++i) roof.push_back({corner(0), corner(i), corner(i - 1)});
  return roof;
}

/// Returns the largest box with the proportions of the footprint's own that lies in a convex footprint; empty in
/// others.
Eigen::AlignedBox3f core_of(const BuildingBody& body, const Vector3d& origin_W) {
  if (body.walls.size() != 1 || !is_convex(body.walls[0])) return {};
  const PlanRing& ring = body.walls[0];
  Eigen::AlignedBox2d plan;
  for (const Vector2d& p : ring) plan.extend(p);
  const Vector2d middle = plan.center(), half = 0.5 * plan.sizes();
  double share = 1.0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Vector2d along = ring[(i + 1) % ring.size()] - ring[i], inwards(-along.y(), along.x());
    share = std::min(share, inwards.dot(middle - ring[i]) / inwards.cwiseAbs().dot(half));
  }
  if (!(share > 0.0)) return {};
  const Vector2d low = middle - share * half, high = middle + share * half;
  return Eigen::AlignedBox3d(origin_W + Vector3d(low.x(), low.y(), -body.eaves_m),
                             origin_W + Vector3d(high.x(), high.y(), 0.0))
      .cast<float>();
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
  const WallStyle walls = random_walls(random);
  const uint32_t flat_roof = town.city.roofs[static_cast<size_t>(uniform_index(random, 2))];
  const Vector2d shift(uniform(random, 0.0, 1.0), uniform(random, 0.0, 1.0));
  const mesh::Cover tiles{town.roof_tiles, textures::kWallTileM, shift}, plain{flat_roof, textures::kRoofTileM, shift};

  mesh.begin_instance(building.name, SemanticClass::building);
  for (const Footprint& footprint : building.footprints) {
    const BuildingBody body = body_of(footprint, building, faults);
    if (body.hulls.empty()) continue;
    const Vector3d origin_W(body.middle_NE.x(), body.middle_NE.y(), -*ground_m);
    const double bottom_m = building.min_height_m, roof_m = building.height_m - body.eaves_m;
    const mesh::Cover& roof = roof_m > 0.0 ? tiles : plain;
    mesh.begin_chunk(false);
    if (bottom_m <= 0.0) mesh.set_core(core_of(body, origin_W));
    add_walls(body.walls, origin_W, bottom_m, body.eaves_m, walls, true, town, mesh);
    add_faces(body.roof, origin_W, roof, mesh);
    add_gables(body.gables, origin_W, walls, town, mesh);
    add_faces(body.bottom, origin_W, plain, mesh);

    // From afar, a level roof at half its height.
    const size_t first_far = mesh.index_count();
    const double far_top_m = body.eaves_m + 0.5 * roof_m;
    add_walls(body.walls, origin_W, bottom_m, far_top_m, walls, false, town, mesh);
    add_faces(roof_m > 0.0 ? level_roof(body.walls.front(), far_top_m) : body.roof, origin_W, roof, mesh);
    add_faces(body.bottom, origin_W, plain, mesh);
    mesh.move_to_far(first_far, std::max(roof_m, kWindowM));
    for (const mesh::Polyhedron& hull : body.hulls) {
      Solid solid{.name = building.name, .shape = Solid::Shape::hull, .polyhedron = hull};
      solid.X_WS.translation() = origin_W;
      solids.push_back(std::move(solid));
    }
  }
}

}  // namespace hedgehop::scenes::map
