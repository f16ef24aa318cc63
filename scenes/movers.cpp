#include "scenes/movers.h"

#include <algorithm>
#include <cmath>

#include "scenes/bodies.h"
#include "scenes/canvas.h"
#include "scenes/plant_textures.h"
#include "scenes/require.h"
#include "scenes/tree_mesh.h"

namespace hedgehop::scenes {
namespace {

using Eigen::Vector3d;
using Shape = MoverConfig::Shape;

constexpr double kSignalTile_m = 2.0;
constexpr double kPoleRadius_m = 0.03;  // that a balloon is carried on
constexpr int kPostSides = 16;

// Red and white bands with specks: seen well against anything.
cv::Mat paint_signal(int size_px, uint64_t seed) {
  Random random(seed);
  const double tile = kSignalTile_m;
  Canvas canvas(size_px, tile, {0.86f, 0.84f, 0.80f});
  for (int k = 0; k < 4; ++k) canvas.fill({0.0, 0.25 * k * tile, tile, 0.125 * tile}, {0.75f, 0.10f, 0.08f});
  for (int k = 0; k < 60; ++k) {
    canvas.disc(uniform(random, 0.0, tile), uniform(random, 0.0, tile), uniform(random, 0.02, 0.08),
                varied(chance(random, 0.5) ? Colour{0.15f, 0.15f, 0.45f} : Colour{0.85f, 0.70f, 0.15f}, 0.3, random));
  }
  canvas.shade(fractal_noise(size_px, {4, 4, 7, 0.8}, random), 0.12);
  return canvas.finished();
}

// The pictures of movers in the scene's list, painted when first asked for.
class MoverPictures {
 public:
  MoverPictures(uint64_t seed, std::vector<cv::Mat>& pictures) : seed_(seed), pictures_(pictures) {}

  Cover signal() { return {index(signal_, paint_signal, 0), kSignalTile_m}; }
  Cover bark() { return {index(bark_, paint_bark, 1), kBarkTile_m}; }
  Cover leaves() {
    const auto paint = [](int size_px, uint64_t seed) { return paint_leaves(Leaves::broad, size_px, seed); };
    return {index(leaves_, paint, 2), kLeafTile_m};
  }

 private:
  template <class Paint>
  uint32_t index(int& known, Paint paint, uint64_t stream) {
    constexpr int kSizePx = 512;  // where the scene has no pictures
    const int size_px = pictures_.empty() ? kSizePx : pictures_.front().cols;
    if (known < 0) {
      known = static_cast<int>(pictures_.size());
      pictures_.push_back(paint(size_px, derived_seed(seed_, stream)));
    }
    return static_cast<uint32_t>(known);
  }

  uint64_t seed_;
  std::vector<cv::Mat>& pictures_;
  int signal_ = -1, bark_ = -1, leaves_ = -1;
};

void validate(const MoverConfig& c) {
  require(std::isfinite(c.radius_m) && c.radius_m > 0.0, "movers.radius", c.radius_m, "above 0 m");
  require(std::isfinite(c.height_m) && c.height_m > 0.0, "movers.height", c.height_m, "above 0 m");
  require_motion(c.motion);
}

Mover make_mover(const MoverConfig& c, uint64_t seed, MoverPictures& pictures) {
  MeshBuilder mesh("opaque");
  Mover mover{.name = c.name, .mesh = {}, .solids = {}, .motion = c.motion};
  const auto add_standing = [&](const Post& post, int sides) {
    add_post(post, sides, pictures.signal(), mesh);
    mover.solids.push_back(solid_of(c.name, post));
  };

  mesh.begin_chunk(false);
  if (c.shape == Shape::tree) {
    Random random(seed);
    const std::vector<Polyhedron> lumps{convex_lump(42, 0.2, random)};
    const TreeShape tree{.height_m = c.height_m,
                         .clear_height_m = 0.25 * c.height_m,
                         .crown_radius_m = c.radius_m,
                         .trunk_radius_m = std::min(0.04 * c.height_m, 0.5 * c.radius_m),
                         .lobes = 10,
                         .trunk_sides = 10};
    mover.solids = add_tree(c.name, tree, lumps, pictures.leaves(), pictures.bark(), random, mesh);
  }
  if (c.shape == Shape::pole) add_standing({Vector3d::Zero(), c.radius_m, c.height_m}, kPostSides);
  if (c.shape == Shape::box) {
    const Eigen::AlignedBox3d box_M(Vector3d(-c.radius_m, -c.radius_m, -c.height_m),
                                    Vector3d(c.radius_m, c.radius_m, 0.0));
    add_box(box_M, Eigen::Isometry3d::Identity(), pictures.signal(), mesh);
    mesh.add_tiled(bottom_panel(box_M), kSignalTile_m, Eigen::Vector2d::Zero(),
                   pictures.signal().texture);  // it may rise
    mover.solids.push_back(solid_of(c.name, box_M));
  }
  if (c.shape == Shape::balloon) {
    const Vector3d center_M(0.0, 0.0, -c.height_m);
    const Eigen::Affine3d place = Eigen::Translation3d(center_M) * Eigen::Scaling(c.radius_m);
    add_polyhedron(moved(place, ball(3)), Shading::smooth, pictures.signal(), mesh);
    mover.solids.push_back(ball_of(c.name, center_M, c.radius_m));
    const double pole_m = c.height_m - c.radius_m;
    if (pole_m > 0.0) add_standing({Vector3d::Zero(), kPoleRadius_m, pole_m}, kPostSides);
  }
  mover.mesh = mesh.finish();
  return mover;
}

}  // namespace

void add_movers(const std::vector<MoverConfig>& movers, uint64_t seed, Scene& scene) {
  MoverPictures pictures(derived_seed(seed, 0), scene.textures);
  for (size_t k = 0; k < movers.size(); ++k) {
    validate(movers[k]);
    scene.movers.push_back(make_mover(movers[k], derived_seed(seed, k + 1), pictures));
  }
}

}  // namespace hedgehop::scenes
