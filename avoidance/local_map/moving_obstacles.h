#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hedgehop::avoidance::local_map {

/// The recently observed surface points of a moving obstacle, seen from above and moved with it. A tree crown is no
/// disc, and an obstacle that is cut by the edge of the view, or too near to be matched, is hardly visible in the last
/// image.
class VisibleSurface {
 public:
  /// Moves the points with the obstacle, m.
  void move(const Eigen::Vector2d& by_W);
  /// Adds the points of an image and deletes points that are 2 s old. @param t_s  increases from call to call.
  void see(double t_s, std::span<const Eigen::Vector2d> points_W);
  /// Returns the convex hull of all points, in the order from north to east; empty without points.
  std::vector<Eigen::Vector2d> hull_W() const;

 private:
  struct Corner {
    Eigen::Vector2d p_W;
    double t_s;
  };
  std::vector<Corner> corners_;  ///< of the hulls of images
};

/// Returns the distance from a point to a convex polygon of at least one corner, m; 0 inside.
double away_m(std::span<const Eigen::Vector2d> convex, const Eigen::Vector2d& p);

/// A point of the surface of an obstacle, in the plane of flight.
struct SurfacePoint {
  Eigen::Vector2d p_W;
  bool was_free;  ///< whether the space at the point was observed as free before
};

/// The sector of the plane of flight that an image shows.
struct ViewSector {
  Eigen::Vector2d camera_W, left_W, right_W;  ///< position of the camera; unit vectors along the edges

  /// Distance from an edge to a point, m: positive inside.
  double inside_left_m(const Eigen::Vector2d& p_W) const { return cross(left_W, p_W - camera_W); }
  double inside_right_m(const Eigen::Vector2d& p_W) const { return cross(p_W - camera_W, right_W); }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
};

/// A moving obstacle: a disc and its observed surface.
struct MovingObstacle {
  Eigen::Vector2d p_W, v_W;  ///< of the center, at the last image of the tracker, m, m/s
  double radius_m = 0.0;
  double p_sigma_m = 0.0, v_sigma_mps = 0.0;  ///< maximum 1-sigma error over both components
  std::vector<Eigen::Vector2d> surface_W =
      {};  ///< convex hull of the recently observed points, moved with the obstacle
};

/// Detects and tracks moving obstacles: surfaces that appear in space that was observed as free. Each cluster of such
/// points is tracked by a constant-velocity filter. It counts as a moving obstacle after it has appeared repeatedly and
/// its velocity significantly exceeds the error of the velocity.
class MovingObstacleTracker {
 public:
  struct Config {
    double sigma_per_m2 = 0.002;  ///< 1-sigma error of depth divided by the squared depth, 1/m
    double spacing_m = 0.3;       ///< spacing of the points: voxel size
    double nearest_m = 0.0;       ///< minimum measurable depth, >= 0
  };
  explicit MovingObstacleTracker(const Config& config) : config_(config) {}

  /// Adds the points of an image. @param t_s  increases from call to call.
  void update(double t_s, const ViewSector& view, std::span<const SurfacePoint> points);

  /// Moving obstacles at the time of the last image. Empty while several appeared suddenly: a real obstacle comes into
  /// view from its edge, from afar or from behind others, whereas wrong matches of repeated patterns, such as a row of
  /// equal posts, appear in free space as a whole.
  std::vector<MovingObstacle> moving_obstacles() const;

 private:
  struct Cluster {
    /// Camera position, center of the visible surface, and unit vector from the camera.
    Eigen::Vector2d camera_W, near_W, sight_W;
    Eigen::Vector2d left_end_W, right_end_W;  ///< outermost points
    double radius_m = 0.0;                    ///< half the width across the line of sight
    double nearest_m = 0.0;                   ///< distance from the camera to the nearest point
    std::vector<Eigen::Vector2d> points_W;
    int appeared = 0;                          ///< number of points that appeared in free space
    bool cut_left = false, cut_right = false;  ///< whether the edge of the view cuts the cluster

    Eigen::Vector2d middle_W(double disc_m) const;
  };
  struct Track {
    Eigen::Vector4d state;  ///< p_W, v_W
    Eigen::Matrix4d covariance;
    double radius_m;
    int evidence = 1, unseen = 0;  ///< number of images
    bool is_moving = false;
    bool sudden = false;  ///< whether its first image showed it whole, and mostly in space that was free
    VisibleSurface surface = {};
  };

  std::vector<Cluster> clusters_of(const ViewSector& view, std::span<const SurfacePoint> points) const;
  void predict(double dt_s);
  void correct(Track& track, const Cluster& cluster, const ViewSector& view) const;
  /// Returns whether the near surface of a track is too near to be measured, so that only farther parts are visible.
  bool hides(const Track& track, const Eigen::Vector2d& camera_W) const;
  /// Covariance of the center of a cluster: precise across the line of sight, imprecise along it.
  Eigen::Matrix2d covariance_m2(const Eigen::Vector2d& p_W, const Eigen::Vector2d& camera_W) const;

  Config config_;
  std::vector<Track> tracks_;
  double mean_sudden_ = 0.0;  ///< number of moving tracks that appeared suddenly, averaged over time
  double t_s_ = 0.0;
};

}  // namespace hedgehop::avoidance::local_map
