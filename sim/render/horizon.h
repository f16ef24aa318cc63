#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace hedgehop::sim {

/// How high the solid boxes around an eye rise, by azimuth: what lies behind them and below is hidden. Conservative: it
/// may report hidden things as visible, never the reverse. Azimuth is stored as the angle on a square on its corner.
class Horizon {
 public:
  Horizon();

  /// Removes all boxes and covers all azimuths. @param eye_W  m.
  void reset(const Eigen::Vector3d& eye_W);

  /// Covers only the azimuths that an image shows. @param corner_rays_W  through its corners, of any length.
  void look(const std::array<Eigen::Vector3d, 4>& corner_rays_W);

  /// Adds a box that is solid from its top down to the ground. Ignored with the eye above, inside, or nearer than 1 m.
  void raise(const Eigen::AlignedBox3f& box_W);

  /// True when no point of the box can be seen past the boxes added so far, at the azimuths covered.
  bool hides(const Eigen::AlignedBox3f& box_W) const;

 private:
  /// A stretch of azimuths, in bins from north; first >= -kBins.
  struct Span {
    double first = 0.0, last = 0.0;
  };
  /// Hides what lies below a slope, the tangent of the elevation, and no nearer in plan than where the screen stands.
  struct Screen {
    double slope = 0.0, reciprocal_pm = 0.0;  ///< 1 / distance
  };
  struct Bin {
    Screen highest, second;
  };

  static Span span(const Eigen::Vector2d& middle, const std::array<Eigen::Vector2d, 4>& directions);
  /// Azimuths of a rectangle that does not hold the origin, as seen from there.
  static Span span(const Eigen::AlignedBox2d& plan);
  Eigen::AlignedBox2d plan(const Eigen::AlignedBox3f& box_W) const;
  double height_above_eye_m(float down_m) const { return eye_W_.z() - static_cast<double>(down_m); }
  bool covers(int bin) const;
  const Eigen::Array2d& edge(int bin) const;

  Eigen::Vector3d eye_W_ = Eigen::Vector3d::Zero();
  int first_bin_ = 0, bin_count_ = 0;
  std::vector<Bin> bins_;
  std::vector<Eigen::Array2d> edges_;  ///< unit vector of each bin's first edge
};

}  // namespace hedgehop::sim
