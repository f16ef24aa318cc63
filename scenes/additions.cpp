#include "scenes/additions.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "scenes/mesh/bodies.h"
#include "scenes/mesh/tree_mesh.h"
#include "scenes/textures/canvas.h"
#include "scenes/textures/park_textures.h"
#include "scenes/textures/stone_textures.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes {

namespace {

using Eigen::Vector3d;

/// Pose of the box's frame K: x along its heading, y across, z down; origin at the center of its bottom face.
Eigen::Isometry3d X_WK(const BoxConfig& c) {
  const Eigen::Translation3d foot_W(c.north_m, c.east_m, 0.0 - c.altitude_m);
  if (c.quaternion.empty()) return foot_W * Eigen::AngleAxisd(c.heading_rad, Vector3d::UnitZ());
  const Eigen::Quaterniond q_WK(c.quaternion[0], c.quaternion[1], c.quaternion[2], c.quaternion[3]);
  const Eigen::Translation3d center_K(0.0, 0.0, -0.5 * c.height_m);
  return foot_W * center_K * q_WK.normalized() * center_K.inverse();
}

void require_box(const BoxConfig& c, const std::string& path) {
  constexpr double kMaxError = 0.01;
  fields::require_bounds(c, path);
  if (c.quaternion.empty()) return;
  const std::string key = path + ".quaternion";
  const size_t count = c.quaternion.size();
  fields::require(count == 4, key, std::to_string(count) + " numbers; valid: 4 (w, x, y, z)");
  const double length = Eigen::Map<const Eigen::Vector4d>(c.quaternion.data()).norm();
  fields::require(std::abs(length - 1.0) <= kMaxError, key, "its length is " + std::to_string(length) + "; valid: 1");
  fields::require(c.heading_rad == 0.0, key, "a box has a heading or a quaternion, not both");
}

}  // namespace

std::vector<Eigen::Vector2d> BoxConfig::corners_NE_m() const {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& [along, across] : {std::pair{0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}, {-0.5, 0.5}}) {
    corners.push_back((X_WK(*this) * Vector3d(along * length_m, across * width_m, 0.0)).head<2>());
  }
  return corners;
}

void add_boxes(const std::vector<BoxConfig>& boxes, uint64_t seed, Scene& scene) {
  if (boxes.empty()) return;
  const auto paint = [size_px = scene.textures.size_px(), seed] { return textures::paint_brick_wall(size_px, seed); };
  const mesh::Cover brick{scene.textures.add(paint), textures::kWallTileM};
  mesh::MeshBuilder builder("opaque");
  for (size_t k = 0; k < boxes.size(); ++k) {
    const BoxConfig& c = boxes[k];
    require_box(c, "boxes." + std::to_string(k));
    const Eigen::AlignedBox3d box_K(Vector3d(-0.5 * c.length_m, -0.5 * c.width_m, -c.height_m),
                                    Vector3d(0.5 * c.length_m, 0.5 * c.width_m, 0.0));
    builder.begin_instance(c.name, SemanticClass::building);
    const bool stands = c.altitude_m == 0.0 && c.quaternion.empty();
    builder.begin_chunk(stands && c.heading_rad == 0.0);  // a rotated box does not fill the bounds of its chunk
    mesh::add_box(box_K, X_WK(c), brick, builder);
    scene.solids.push_back(mesh::solid_of(c.name, box_K, X_WK(c)));
  }
  scene.meshes.push_back(builder.finish());
}

namespace {

using Eigen::Vector3d;
using Shape = MoverConfig::Shape;

constexpr double kSignalTileM = 2.0;
constexpr double kPoleRadiusM = 0.03;  // of the pole that carries a balloon
constexpr int kPostSides = 16;

// Red and white bands with specks, which contrast with every background.
cv::Mat paint_signal(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kSignalTileM;
  textures::Canvas canvas(size_px, tile, {0.86f, 0.84f, 0.80f});
  for (int k = 0; k < 4; ++k) canvas.fill({0.0, 0.25 * k * tile, tile, 0.125 * tile}, {0.75f, 0.10f, 0.08f});
  for (int k = 0; k < 60; ++k) {
    canvas.disc(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.02, 0.08),
                textures::varied(
                    chance(random, 0.5) ? textures::Color{0.15f, 0.15f, 0.45f} : textures::Color{0.85f, 0.70f, 0.15f},
                    0.3, random));
  }
  canvas.shade(textures::fractal_noise(size_px, {4, 4, 7, 0.8}, random), 0.12);
  return canvas.finished();
}

// Textures of the movers, which are added to the scene on first use.
class MoverImages {
 public:
  MoverImages(uint64_t seed, Scene& scene) : seed_(seed), scene_(scene) {}

  mesh::Cover signal() { return {index(signal_, paint_signal, 0), kSignalTileM}; }
  mesh::Cover bark() { return {index(bark_, textures::paint_bark, 1), textures::kBarkTileM}; }
  mesh::Cover leaves() {
    const auto paint = [](int size_px, uint64_t seed) {
      return textures::paint_leaves(textures::Leaves::broad, size_px, seed);
    };
    return {index(leaves_, paint, 2), textures::kLeafTileM};
  }

 private:
  template <class Paint>
  uint32_t index(std::optional<uint32_t>& known, Paint paint, uint64_t stream) {
    const int size_px = scene_.textures.size_px();
    const uint64_t seed = derived_seed(seed_, stream);
    if (!known) known = scene_.textures.add([paint, size_px, seed] { return paint(size_px, seed); });
    return *known;
  }

  uint64_t seed_;
  Scene& scene_;
  std::optional<uint32_t> signal_, bark_, leaves_;
};

SemanticClass class_of(Shape shape) {
  if (shape == Shape::balloon) return SemanticClass::balloon;
  return shape == Shape::tree ? SemanticClass::tree : SemanticClass::pole;
}

/// Returns a mover with the table of its motion. Throws std::invalid_argument "movers.<k>.motion..." if the motion is
/// not valid.
MoverConfig loaded(const std::vector<MoverConfig>& movers, size_t k) {
  MoverConfig mover = movers[k];
  try {
    load_motion(mover.motion);
    require_motion(mover.motion);
  } catch (const fields::InvalidField& fault) {
    throw fields::InvalidField("movers." + std::to_string(k) + "." + fault.key(), fault.message());
  }
  return mover;
}

Mover make_mover(const MoverConfig& c, uint64_t seed, MoverImages& images) {
  mesh::MeshBuilder mesh("opaque");
  Mover mover{.name = c.name, .mesh = {}, .solids = {}, .motion = c.motion};
  const auto add_standing = [&](const mesh::Post& post, int sides) {
    mesh::add_post(post, sides, images.signal(), mesh);
    mover.solids.push_back(mesh::solid_of(c.name, post));
  };

  const auto add_bottom = [&](const Eigen::AlignedBox3d& box_M) {
    mesh.add_tiled(mesh::bottom_panel(box_M), kSignalTileM, Eigen::Vector2d::Zero(), images.signal().texture);
  };

  mesh.begin_instance(c.name, class_of(c.shape));
  mesh.begin_chunk(false);
  if (c.shape == Shape::tree) {
    Random random(seed);
    const std::vector<mesh::Polyhedron> lumps{mesh::convex_lump(42, 0.2, random)};
    const mesh::TreeShape tree{.height_m = c.height_m,
                               .clear_height_m = 0.25 * c.height_m,
                               .crown_radius_m = c.radius_m,
                               .trunk_radius_m = std::min(0.04 * c.height_m, 0.5 * c.radius_m),
                               .lobes = 10,
                               .trunk_sides = 10};
    mover.solids = mesh::add_tree(c.name, tree, lumps, images.leaves(), images.bark(), random, mesh);
  }
  if (c.shape == Shape::pole) add_standing({Vector3d::Zero(), c.radius_m, c.height_m}, kPostSides);
  if (c.shape == Shape::box) {
    const Eigen::AlignedBox3d box_M(Vector3d(-c.radius_m, -c.radius_m, -c.height_m),
                                    Vector3d(c.radius_m, c.radius_m, 0.0));
    mesh::add_box(box_M, Eigen::Isometry3d::Identity(), images.signal(), mesh);
    add_bottom(box_M);  // visible if the box rises
    mover.solids.push_back(mesh::solid_of(c.name, box_M));
  }
  if (c.shape == Shape::cuboid) {
    const Eigen::AlignedBox3d box_M(-0.5 * c.size_m, 0.5 * c.size_m);
    mesh::add_box(box_M, Eigen::Isometry3d::Identity(), images.signal(), mesh);
    add_bottom(box_M);
    mover.solids.push_back(mesh::solid_of(c.name, box_M));
  }
  if (c.shape == Shape::balloon) {
    const Vector3d center_M(0.0, 0.0, -c.height_m);
    const Eigen::Affine3d place = Eigen::Translation3d(center_M) * Eigen::Scaling(c.radius_m);
    mesh::add_polyhedron(mesh::moved(place, mesh::ball(3)), mesh::Shading::smooth, images.signal(), mesh);
    mover.solids.push_back(mesh::ball_of(c.name, center_M, c.radius_m));
    const double pole_m = c.height_m - c.radius_m;
    if (pole_m > 0.0) add_standing({Vector3d::Zero(), kPoleRadiusM, pole_m}, kPostSides);
  }
  mover.mesh = mesh.finish();
  return mover;
}

}  // namespace

void add_movers(const std::vector<MoverConfig>& movers, uint64_t seed, Scene& scene) {
  MoverImages images(derived_seed(seed, 0), scene);
  for (size_t k = 0; k < movers.size(); ++k) {
    fields::require_bounds(movers[k], "movers." + std::to_string(k));
    const MoverConfig mover = loaded(movers, k);
    scene.movers.push_back(make_mover(mover, derived_seed(seed, k + 1), images));
  }
}

std::vector<std::string> add_files(const SceneAdditions& added, uint64_t seed, Scene& scene) {
  for (size_t k = 0; k < added.movers.size(); ++k) loaded(added.movers, k);  // reports a faulty table before the flight
  scene.has_ground = added.has_plane();
  std::vector<std::string> lines = mesh::add_imports(added.imports, added.origin_ENU, scene);
  if (added.terrain) terrain::add_terrain(*added.terrain, added.origin_ENU, seed, scene);
  return lines;
}

}  // namespace hedgehop::scenes
