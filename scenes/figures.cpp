#include "scenes/figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/fields/quantities.h"

namespace hedgehop::scenes {
namespace {

constexpr double kTouchingM = 1e-6;

// A rectangle or a disc in the plan. A disc is a point with a radius.
struct PlanOutline {
  Eigen::AlignedBox2d core_NE;
  double radius_m = 0.0;

  double south_m() const { return core_NE.min().x() - radius_m; }
  double north_m() const { return core_NE.max().x() + radius_m; }
};

PlanOutline outline(const Solid& solid, const Eigen::AlignedBox3d& box_W) {
  const bool is_upright = std::abs(solid.X_WS.linear()(2, 2)) > 1.0 - 1e-12;
  if (solid.shape == Solid::Shape::sphere || (solid.shape == Solid::Shape::cylinder && is_upright)) {
    const Eigen::Vector2d center_NE = solid.X_WS.translation().head<2>();
    return {{center_NE, center_NE}, solid.half_extents_m.x()};
  }
  return {{Eigen::Vector2d(box_W.min().head<2>()), Eigen::Vector2d(box_W.max().head<2>())}};
}

double gap_m(const PlanOutline& a, const PlanOutline& b) {
  return a.core_NE.exteriorDistance(b.core_NE) - a.radius_m - b.radius_m;
}

// Returns the gap of each outline by a sweep from south to north. A later outline can reduce the gap only if its south
// edge lies within the gap. An earlier one can only if its south edge lies within the gap plus the longest outline.
std::vector<double> gaps_m(std::vector<PlanOutline> outlines) {
  std::ranges::sort(outlines, {}, &PlanOutline::south_m);
  double longest_m = 0.0;
  for (const PlanOutline& each : outlines) longest_m = std::max(longest_m, each.north_m() - each.south_m());
  std::vector<double> gaps;
  for (size_t i = 0; i < outlines.size(); ++i) {
    double min_m = kInfinity;
    const auto consider = [&](size_t j) {
      const double gap = gap_m(outlines[i], outlines[j]);
      if (gap > kTouchingM) min_m = std::min(min_m, gap);
    };
    for (size_t j = i + 1; j < outlines.size() && outlines[j].south_m() - outlines[i].north_m() < min_m; ++j)
      consider(j);
    for (size_t j = i; j-- > 0 && outlines[i].south_m() - outlines[j].south_m() - longest_m < min_m;) consider(j);
    gaps.push_back(min_m);
  }
  return gaps;
}

}  // namespace

SceneFigures scene_figures(const Scene& scene, const AltitudeRange& band) {
  std::vector<PlanOutline> outlines;
  double covered_m2 = 0.0;
  size_t on_ground = 0;
  for (const Solid& solid : scene.solids) {
    const Eigen::AlignedBox3d box_W = bounds_W(solid);
    if (-box_W.min().z() < band.lowest_m || -box_W.max().z() > band.highest_m) continue;
    const PlanOutline& added = outlines.emplace_back(outline(solid, box_W));
    const Eigen::AlignedBox2d inside_NE = added.core_NE.intersection(scene.bounds_NE_m);
    if (box_W.max().z() < -kTouchingM || inside_NE.isEmpty()) continue;
    const double disc_m2 = std::numbers::pi * added.radius_m * added.radius_m;
    const double inside_m2 = added.radius_m > 0.0 ? disc_m2 : inside_NE.volume();
    covered_m2 += inside_m2;
    if (inside_m2 > 0.0) ++on_ground;  // a wall on the border lies outside
  }
  std::vector<double> gaps = gaps_m(outlines);
  std::ranges::sort(gaps);
  SceneFigures figures;
  figures.solids = outlines.size();
  figures.smallest_gap_m = gaps.empty() ? kInfinity : gaps.front();
  figures.median_gap_m = gaps.empty() ? kInfinity : gaps[gaps.size() / 2];
  figures.covered_share = covered_m2 / scene.bounds_NE_m.volume();
  figures.density_pm2 = static_cast<double>(on_ground) / scene.bounds_NE_m.volume();
  return figures;
}

}  // namespace hedgehop::scenes
