#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace hedgehop::sim {

/// How high the solid boxes around an eye rise, by azimuth: what lies behind them and below is hidden. Conservative: it
/// may call hidden things visible, never the reverse. Azimuth is kept as the angle on a square standing on its corner.
class Horizon {
 public:
  Horizon();

  /// Forgets all boxes. @param eye_W  m.
  void reset(const Eigen::Vector3d& eye_W);

  /// Adds a box that is solid from its top down to the ground. Ignored with the eye above, inside, or nearer than 1 m.
  void raise(const Eigen::AlignedBox3f& box_W);

  /// True when no point of the box can be seen past the boxes raised so far, all of which must be nearer in plan: their
  /// farthest_m() at most this box's nearest_m().
  bool hides(const Eigen::AlignedBox3f& box_W) const;

  /// Plan distance from the eye to the box's nearest and farthest point, m.
  double nearest_m(const Eigen::AlignedBox3f& box_W) const;
  double farthest_m(const Eigen::AlignedBox3f& box_W) const;

 private:
  struct Span {
    double first = 0.0, last = 0.0;  ///< in bins from azimuth north, first <= last, first in (-kBins, kBins)
  };
  /// Azimuths of a rectangle that does not hold the origin, as seen from there.
  static Span span(const Eigen::AlignedBox2d& plan);
  Eigen::AlignedBox2d plan(const Eigen::AlignedBox3f& box_W) const;

  Eigen::Vector3d eye_W_ = Eigen::Vector3d::Zero();
  std::vector<double> slope_;              ///< tan of the elevation below which all is hidden, per bin
  std::vector<Eigen::Vector2d> edge_dir_;  ///< unit vector of each bin's first edge
};

}  // namespace hedgehop::sim
