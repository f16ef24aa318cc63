#include "scenes/worlds/room.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/textures/room_textures.h"
#include "scenes/textures/street_textures.h"
#include "scenes/world_config.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

// Streams of the scene's seed.
constexpr uint64_t kFurnitureStream = 0;
constexpr uint64_t kRoomImageStream = 1;
constexpr uint64_t kSurfaceStream = 2;

constexpr int kWallVariants = 3;
constexpr double kGrassMarginM = 1000.0;

void validate(const RoomConfig& c) {
  fields::require_bounds(c);
  require_texture_size(c.texture_size_px);
}

Eigen::AlignedBox2d free_plan_NE(const RoomConfig& c) {
  const Eigen::Vector2d half(0.5 * c.length_m, 0.5 * c.width_m);
  return {-half, half};
}

// Returns the walls in the order north, east, south, west. The north and south walls include the corners.
std::vector<Eigen::AlignedBox3d> wall_boxes(const RoomConfig& c) {
  const double n = 0.5 * c.length_m, e = 0.5 * c.width_m, t = c.wall_thickness_m, top = -c.height_m;
  using Eigen::Vector3d;
  return {{Vector3d(n, -e - t, top), Vector3d(n + t, e + t, 0.0)},
          {Vector3d(-n, e, top), Vector3d(n, e + t, 0.0)},
          {Vector3d(-n - t, -e - t, top), Vector3d(-n, e + t, 0.0)},
          {Vector3d(-n, -e - t, top), Vector3d(n, -e, 0.0)}};
}

// Draws one piece, against a wall or away from it; std::nullopt if it is too close to another piece or to a clearing.
std::optional<Eigen::AlignedBox3d> draw_piece(const RoomConfig& c, bool at_wall,
                                              const std::vector<Eigen::AlignedBox3d>& pieces, Random& random) {
  const Eigen::AlignedBox2d plan_NE = free_plan_NE(c);
  const double grain = 64.0;
  const auto snapped = [grain](double x_m) { return std::round(x_m * grain) / grain; };
  const Eigen::Vector2d size(snapped(uniform(random, 0.5, 1.6)), snapped(uniform(random, 0.4, 1.0)));
  const int side = uniform_index(random, 4);
  const Eigen::Vector2d rotated = side % 2 == 0 ? Eigen::Vector2d(size.y(), size.x()) : size;
  const double height = std::min(snapped(uniform(random, 0.6, 2.2)), c.height_m);

  Eigen::Vector2d low;
  for (int axis = 0; axis < 2; ++axis) {
    const double first = plan_NE.min()[axis] + c.furniture_gap_m;
    const double last = plan_NE.max()[axis] - c.furniture_gap_m - rotated[axis];
    if (last < first) return std::nullopt;
    low[axis] = std::clamp(snapped(uniform(random, first, last)), first, last);
  }
  if (at_wall && side == 0) low.x() = plan_NE.max().x() - rotated.x();
  if (at_wall && side == 1) low.y() = plan_NE.max().y() - rotated.y();
  if (at_wall && side == 2) low.x() = plan_NE.min().x();
  if (at_wall && side == 3) low.y() = plan_NE.min().y();

  const Eigen::AlignedBox2d footprint_NE(low, Eigen::Vector2d(low + rotated));
  for (const Eigen::AlignedBox3d& other : pieces) {
    const Eigen::AlignedBox2d other_NE(Eigen::Vector2d(other.min().head<2>()), Eigen::Vector2d(other.max().head<2>()));
    if (footprint_NE.exteriorDistance(other_NE) < c.furniture_gap_m) return std::nullopt;
  }
  for (const Clearing& clearing : c.keep_clear) {
    if (footprint_NE.exteriorDistance(clearing.center_NE_m()) < clearing.radius_m) return std::nullopt;
  }
  return Eigen::AlignedBox3d(Eigen::Vector3d(low.x(), low.y(), -height),
                             Eigen::Vector3d(low.x() + rotated.x(), low.y() + rotated.y(), 0.0));
}

std::vector<Eigen::AlignedBox3d> place_furniture(const RoomConfig& c, Random& random) {
  constexpr int kTriesPerPiece = 2000;
  std::vector<Eigen::AlignedBox3d> pieces;
  const auto wanted = static_cast<size_t>(c.furniture);
  for (int64_t tries = 0; pieces.size() < wanted && tries < kTriesPerPiece * c.furniture; ++tries) {
    const bool at_wall = pieces.size() % 2 == 0 || tries > kTriesPerPiece * c.furniture / 2;
    if (const auto piece = draw_piece(c, at_wall, pieces, random)) pieces.push_back(*piece);
  }
  if (pieces.size() < wanted) {
    std::ostringstream line;
    line << wanted << "; valid: at most " << pieces.size() << ", the number that fits with furniture_gap "
         << c.furniture_gap_m << " m and these clearings";
    throw fields::InvalidField("furniture", line.str());
  }
  return pieces;
}

struct RoomTextures {
  TextureList images;
  std::vector<uint32_t> first_wall;  // of kWallVariants, for each of the four walls
  uint32_t floor = 0, ceiling = 0, grass = 0;
  std::vector<uint32_t> furniture;
};

RoomTextures room_textures(const RoomConfig& c, uint64_t seed) {
  const int size_px = static_cast<int>(c.texture_size_px);
  RoomTextures room{.images = TextureList(size_px)};
  const auto add = [&](cv::Mat (*paint)(int, uint64_t), uint64_t stream) {
    const uint64_t image_seed = derived_seed(seed, stream);
    return room.images.add([=] { return paint(size_px, image_seed); });
  };
  Random random(derived_seed(seed, 0));
  room.floor = add(chance(random, 0.5) ? textures::paint_parquet : textures::paint_carpet, 1);
  if (c.ceiling) {
    room.ceiling = add(textures::paint_ceiling, 2);
  } else {
    room.grass = add(textures::paint_grass, 2);
  }
  if (c.furniture > 0) room.furniture = {add(textures::paint_shelves, 3), add(textures::paint_drawers, 4)};

  // A different wallpaper for each wall.
  std::vector<textures::WallPaper> papers = {textures::WallPaper::stripes, textures::WallPaper::brick,
                                             textures::WallPaper::damask, textures::WallPaper::plaster};
  for (uint64_t wall = 0; wall < 4; ++wall) {
    const auto pick = papers.begin() + uniform_index(random, static_cast<int>(papers.size()));
    const textures::WallPaper paper = *pick;
    const uint64_t image_seed = derived_seed(seed, 5 + wall);
    const auto paint = [=] { return textures::paint_room_walls(paper, size_px, kWallVariants, image_seed); };
    room.first_wall.push_back(room.images.add(kWallVariants, paint));
    papers.erase(pick);
  }
  return room;
}

// Covers a face of a wall with textures side by side, each a random variant, aligned with the floor.
void paper_wall(const mesh::TexturedPanel& wall, uint32_t first_image, Random& random, mesh::MeshBuilder& mesh) {
  const double width = wall.right_m.norm(), height = wall.down_m.norm();
  const int count = std::max(1, static_cast<int>(std::lround(width / textures::kRoomTileM)));
  const double share =
      width / (count * textures::kRoomTileM) < 0.5 ? width / textures::kRoomTileM : 1.0;  // of the texture's width
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d start = wall.top_left_W + wall.right_m * k / count;
    const Eigen::Vector3d end = wall.top_left_W + wall.right_m * (k + 1) / count;
    mesh.add({start, end - start, wall.down_m}, {0.0, 1.0 - height / textures::kRoomTileM, share, 1.0},
             first_image + static_cast<uint32_t>(uniform_index(random, kWallVariants)));
  }
}

void add_box(const Eigen::AlignedBox3d& box_W, uint32_t image, Random& random, mesh::MeshBuilder& mesh) {
  mesh.begin_chunk(true);
  const Eigen::Vector2d shift(0.05 * uniform_index(random, 20), 0.1 * uniform_index(random, 10));
  for (const mesh::TexturedPanel& panel : mesh::side_panels(box_W)) {
    const double foot = panel.down_m.norm() / textures::kRoomTileM;
    mesh.add_tiled(panel, textures::kRoomTileM, {shift.x(), shift.y() - foot}, image);
  }
  mesh.add_tiled(mesh::top_panel(box_W), textures::kRoomTileM, shift, image);
}

void add_ceiling(const Eigen::AlignedBox3d& box_W, uint32_t image, mesh::MeshBuilder& mesh) {
  mesh.begin_chunk(false);
  mesh.add_tiled(mesh::bottom_panel(box_W), textures::kRoomTileM, Eigen::Vector2d::Zero(), image);
  mesh.add_tiled(mesh::top_panel(box_W), textures::kRoomTileM, Eigen::Vector2d::Zero(), image);
  for (const mesh::TexturedPanel& side : mesh::side_panels(box_W))
    mesh.add_tiled(side, textures::kRoomTileM, Eigen::Vector2d::Zero(), image);
}

// Adds grass around a room without a ceiling, in four strips.
void add_lawn(const Eigen::AlignedBox2d& house_NE, uint32_t image, mesh::MeshBuilder& mesh) {
  const double far_n = house_NE.max().x() + kGrassMarginM, far_e = house_NE.max().y() + kGrassMarginM;
  const double n = house_NE.max().x(), e = house_NE.max().y();
  using Eigen::Vector3d;
  const Eigen::AlignedBox3d strips[] = {{Vector3d(n, -far_e, 0.0), Vector3d(far_n, far_e, 0.0)},
                                        {Vector3d(-far_n, -far_e, 0.0), Vector3d(-n, far_e, 0.0)},
                                        {Vector3d(-n, e, 0.0), Vector3d(n, far_e, 0.0)},
                                        {Vector3d(-n, -far_e, 0.0), Vector3d(n, -e, 0.0)}};
  for (const Eigen::AlignedBox3d& strip : strips) {
    mesh.begin_chunk(false);
    mesh.add_tiled(mesh::top_panel(strip), textures::kGrassTileM, Eigen::Vector2d::Zero(), image);
  }
}

}  // namespace

Scene make_room(const RoomConfig& config, uint64_t seed) {
  validate(config);
  Random furniture_random(derived_seed(seed, kFurnitureStream));
  const std::vector<Eigen::AlignedBox3d> furniture = place_furniture(config, furniture_random);
  RoomTextures room = room_textures(config, derived_seed(seed, kRoomImageStream));
  Random random(derived_seed(seed, kSurfaceStream));

  Scene scene;
  scene.name = "room";
  scene.bounds_NE_m = free_plan_NE(config);
  scene.lights.ambient = 0.70f;
  scene.lights.sun = 0.30f;
  mesh::MeshBuilder mesh("opaque");

  // The floor ends under the center of the walls, so that no seam is visible.
  const Eigen::Vector2d floor_half = scene.bounds_NE_m.max() + Eigen::Vector2d::Constant(0.5 * config.wall_thickness_m);
  const Eigen::AlignedBox3d floor_W(Eigen::Vector3d(-floor_half.x(), -floor_half.y(), 0.0),
                                    Eigen::Vector3d(floor_half.x(), floor_half.y(), 0.0));
  const uint32_t ground = mesh.begin_instance("ground", SemanticClass::ground);
  mesh.begin_chunk(false);
  mesh.add_tiled(mesh::top_panel(floor_W), textures::kRoomTileM, Eigen::Vector2d::Zero(), room.floor);

  static constexpr const char* kNames[] = {"north wall", "east wall", "south wall", "west wall"};
  const std::vector<Eigen::AlignedBox3d> walls = wall_boxes(config);
  for (size_t k = 0; k < walls.size(); ++k) {
    mesh.begin_instance(kNames[k], SemanticClass::wall);
    mesh.begin_chunk(false);
    for (const mesh::TexturedPanel& face : mesh::side_panels(walls[k]))
      paper_wall(face, room.first_wall[k], random, mesh);
    mesh.add_tiled(mesh::top_panel(walls[k]), textures::kRoomTileM, Eigen::Vector2d::Zero(), room.first_wall[k]);
    scene.solids.push_back(mesh::solid_of(kNames[k], walls[k]));
  }

  if (config.ceiling) {
    const Eigen::Vector3d lift(0.0, 0.0, config.height_m);
    Eigen::AlignedBox3d ceiling_W(walls[2].min(), walls[0].max() - lift);
    ceiling_W.min().z() -= config.wall_thickness_m;
    mesh.begin_instance("ceiling", SemanticClass::ceiling);
    add_ceiling(ceiling_W, room.ceiling, mesh);
    scene.solids.push_back(mesh::solid_of("ceiling", ceiling_W));
  } else {
    mesh.resume_instance(ground);
    add_lawn({Eigen::Vector2d(-floor_half), floor_half}, room.grass, mesh);
  }
  for (size_t k = 0; k < furniture.size(); ++k) {
    const std::string name = "furniture " + std::to_string(k + 1);
    mesh.begin_instance(name, SemanticClass::furniture);
    add_box(furniture[k], room.furniture[static_cast<size_t>(uniform_index(random, 2))], random, mesh);
    scene.solids.push_back(mesh::solid_of(name, furniture[k]));
  }
  scene.meshes.push_back(mesh.finish());
  scene.textures = std::move(room.images);
  return scene;
}

}  // namespace hedgehop::scenes::worlds
