#include "scenes/mesh/ground.h"

namespace hedgehop::scenes::mesh {
namespace {

// Seen from 40 m up, the edge of the ground lies a fifth of a degree below the horizon.
constexpr double kFarM = 12000.0;

// Adds lines outside of those given, ever farther apart.
void extend_to_horizon(std::vector<double>& lines_m) {
  while (lines_m.back() < kFarM) lines_m.push_back(lines_m.back() + 0.5 * (lines_m.back() - lines_m.front()));
  while (lines_m.front() > -kFarM)
    lines_m.insert(lines_m.begin(), lines_m.front() - 0.5 * (lines_m.back() - lines_m.front()));
}

}  // namespace

void add_ground(std::vector<double> norths_m, std::vector<double> easts_m,
                const std::function<Cover(const Eigen::Vector2d& middle_NE)>& cover_at, MeshBuilder& mesh) {
  extend_to_horizon(norths_m);
  extend_to_horizon(easts_m);
  mesh.begin_chunk(false);
  for (size_t i = 1; i < norths_m.size(); ++i) {
    for (size_t j = 1; j < easts_m.size(); ++j) {
      const Eigen::Vector3d low(norths_m[i - 1], easts_m[j - 1], 0.0), high(norths_m[i], easts_m[j], 0.0);
      const Cover cover = cover_at(0.5 * (low + high).head<2>());
      const Eigen::Vector2d from_origin_m(low.y(), -high.x());  // the image's up is north
      mesh.add_tiled(top_panel({low, high}), cover.tile_m, cover.offset + from_origin_m / cover.tile_m, cover.texture);
    }
  }
}

void add_ground(double half_m, const Cover& cover, MeshBuilder& mesh) {
  std::vector<double> lines_m;
  for (int k = -4; k <= 4; ++k) lines_m.push_back(0.25 * k * half_m);
  add_ground(
      lines_m, lines_m, [&](const Eigen::Vector2d&) { return cover; }, mesh);
}

}  // namespace hedgehop::scenes::mesh
