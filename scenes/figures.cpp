#include "scenes/figures.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace hedgehop::scenes {
SceneFigures scene_figures(const Scene& scene) {
  constexpr double kTouching_m = 1e-6;
  std::vector<Eigen::AlignedBox2d> plans_NE;
  SceneFigures figures;
  figures.solids = scene.solids.size();
  double covered_m2 = 0.0;
  for (const Solid& solid : scene.solids) {
    const Eigen::AlignedBox3d box_W = bounds_W(solid);
    plans_NE.emplace_back(Eigen::Vector2d(box_W.min().head<2>()), Eigen::Vector2d(box_W.max().head<2>()));
    const Eigen::AlignedBox2d inside_NE = plans_NE.back().intersection(scene.bounds_NE_m);
    if (box_W.max().z() >= -kTouching_m && !inside_NE.isEmpty()) covered_m2 += inside_NE.volume();
  }
  figures.covered_share = covered_m2 / scene.bounds_NE_m.volume();

  // Sweep from south to north: a later outline can only come nearer while its south edge is within the best gap.
  std::sort(plans_NE.begin(), plans_NE.end(), [](const auto& a, const auto& b) { return a.min().x() < b.min().x(); });
  figures.smallest_gap_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < plans_NE.size(); ++i) {
    for (size_t j = i + 1; j < plans_NE.size(); ++j) {
      if (plans_NE[j].min().x() - plans_NE[i].max().x() >= figures.smallest_gap_m) break;
      const double gap = plans_NE[i].exteriorDistance(plans_NE[j]);
      if (gap > kTouching_m) figures.smallest_gap_m = std::min(figures.smallest_gap_m, gap);
    }
  }
  return figures;
}

}  // namespace hedgehop::scenes
