#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace hedgehop::sim {

/// The elevation of the solid boxes around a viewpoint, by azimuth. Everything behind the boxes and below that
/// elevation is hidden. The result is conservative: a hidden box may be reported as visible, but never the reverse. The
/// azimuth is stored as a position along the sides of a square whose corners point north, east, south and west.
class Horizon {
 public:
  Horizon();

  /// Removes all boxes and covers all azimuths. @param eye_W  position of the camera, m.
  void reset(const Eigen::Vector3d& eye_W);

  /// Covers only the azimuths of an image. @param corner_rays_W  rays of any length through the corners of the image.
  void limit_to_view(const std::array<Eigen::Vector3d, 4>& corner_rays_W);

  /// Adds a box that is solid from its top down to the ground. A box below the camera, around it or closer than 1 m is
  /// ignored.
  void add_occluder(const Eigen::AlignedBox3f& box_W);

  /// Returns true if the boxes added so far hide the whole box at the azimuths that are covered.
  bool hides(const Eigen::AlignedBox3f& box_W) const;

 private:
  /// An interval of azimuths, in bins from north; first >= -kBins.
  struct AzimuthInterval {
    double first = 0.0, last = 0.0;
  };
  /// Hides everything below a slope, which is the tangent of the elevation, and at least as far away as the occluder.
  struct Occluder {
    double slope = 0.0, reciprocal_pm = 0.0;  ///< 1 / distance
  };
  struct Bin {
    Occluder highest, second;
  };

  static AzimuthInterval interval(const Eigen::Vector2d& middle, const std::array<Eigen::Vector2d, 4>& directions);
  /// Returns the azimuths of a rectangle as seen from the origin, which is outside of it.
  static AzimuthInterval interval(const Eigen::AlignedBox2d& plan);
  Eigen::AlignedBox2d plan(const Eigen::AlignedBox3f& box_W) const;
  double height_above_eye_m(float down_m) const { return eye_W_.z() - static_cast<double>(down_m); }
  bool covers(int bin) const;
  const Eigen::Array2d& edge(int bin) const;

  Eigen::Vector3d eye_W_ = Eigen::Vector3d::Zero();
  int first_bin_ = 0, bin_count_ = 0;
  std::vector<Bin> bins_;
  std::vector<Eigen::Array2d> edges_;  ///< unit vector of the first edge of each bin
};

}  // namespace hedgehop::sim
