#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "scenes/map/elevation.h"
#include "scenes/map/local_plane.h"
#include "scenes/terrain/surface_grid.h"

namespace hedgehop::scenes::map {

/// The ground of a map: a terrain, or the plane at altitude 0.
class Ground {
 public:
  Ground() = default;
  /// @param origin_m  height of W's origin in the samples; default: that of the terrain there.
  /// @throws std::invalid_argument if the samples have no height at the origin and none is given.
  Ground(const HeightSamples& samples, const LocalPlane& plane, std::optional<double> origin_m);

  /// Returns the altitude of the ground, m; nullopt if the terrain has no data there.
  std::optional<double> altitude_m(const Eigen::Vector2d& p_NE) const;

  /// Returns the lowest altitude at points, m; nullopt if the terrain has no data at one of them.
  std::optional<double> lowest_m(const std::vector<Eigen::Vector2d>& points_NE) const;

  /// Returns a polyline with further points such that it follows the ground: none is farther than `step_m` from the
  /// next. On the plane, it is the polyline itself.
  std::vector<Eigen::Vector2d> divided(const std::vector<Eigen::Vector2d>& line_NE, double step_m) const;

  const std::optional<terrain::SurfaceGrid>& terrain() const { return terrain_; }

 private:
  std::optional<terrain::SurfaceGrid> terrain_;
};

}  // namespace hedgehop::scenes::map
