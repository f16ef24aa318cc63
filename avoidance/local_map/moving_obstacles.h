#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace hedgehop::avoidance::local_map {

/// What was seen lately of a obstacle's surface, from above, moving along with it: a crown is no disc, and of one that
/// the view cuts, or that is too near to be matched, the last image shows the least.
class VisibleSurface {
 public:
  /// By what its obstacle has moved, m.
  void move(const Eigen::Vector2d& by_W);
  /// Adds an image's points, and forgets those that were seen 2 s before or earlier. @param t_s  rises from call to
  /// call.
  void see(double t_s, std::span<const Eigen::Vector2d> points_W);
  /// The convex hull of all that is remembered, turning from north to east; empty before anything was seen.
  std::vector<Eigen::Vector2d> hull_W() const;

 private:
  struct Corner {
    Eigen::Vector2d p_W;
    double t_s;
  };
  std::vector<Corner> corners_;  ///< of the hulls of images
};

/// From a point to a convex polygon of any number of corners, one at least, m; 0 inside.
double away_m(std::span<const Eigen::Vector2d> convex, const Eigen::Vector2d& p);

/// A point of an obstacle's surface, in the plane of flight.
struct SurfacePoint {
  Eigen::Vector2d p_W;
  bool was_free;  ///< lies where free space was seen before
};

/// What an image shows of the plane of flight: a sector.
struct ViewSector {
  Eigen::Vector2d camera_W, left_W, right_W;  ///< its corner; along its edges, of length 1

  /// From an edge to a point, m: positive inside.
  double inside_left_m(const Eigen::Vector2d& p_W) const { return cross(left_W, p_W - camera_W); }
  double inside_right_m(const Eigen::Vector2d& p_W) const { return cross(p_W - camera_W, right_W); }

 private:
  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }
};

/// What moves: a disc, and what was seen of it.
struct MovingObstacle {
  Eigen::Vector2d p_W, v_W;  ///< of its middle, at MovingObstacleTracker' last image, m, m/s
  double radius_m = 0.0;
  double p_sigma_m = 0.0, v_sigma_mps = 0.0;    ///< 1-sigma of either component, the larger one
  std::vector<Eigen::Vector2d> surface_W = {};  ///< convex hull of what was seen lately, moved along
};

/// Finds and follows what moves: surfaces that appear in space seen to be free. Lumps of them are followed by a filter
/// of constant velocity each, and count as moving_obstacles once they went on appearing and their velocity stands out
/// of its error.
class MovingObstacleTracker {
 public:
  struct Config {
    double sigma_per_m2 = 0.002;  ///< 1-sigma of depth over its square, 1/m
    double spacing_m = 0.3;       ///< of the points: voxels
    double nearest_m = 0.0;       ///< depth from which on surfaces are measured, >= 0
  };
  explicit MovingObstacleTracker(const Config& config) : config_(config) {}

  /// Takes an image's points. @param t_s  rises from call to call.
  void update(double t_s, const ViewSector& view, std::span<const SurfacePoint> points);

  /// At the time of the last image.
  std::vector<MovingObstacle> moving_obstacles() const;

 private:
  struct Cluster {
    Eigen::Vector2d camera_W, near_W,
        sight_W;                              ///< near_W: the middle of the surface; sight_W: from the eye, of length 1
    Eigen::Vector2d left_end_W, right_end_W;  ///< its outermost points
    double radius_m = 0.0;                    ///< half as much as it is wide, across
    double nearest_m = 0.0;                   ///< from the eye to its nearest point
    std::vector<Eigen::Vector2d> points_W;
    int appeared = 0;                          ///< of the points
    bool cut_left = false, cut_right = false;  ///< by the view's edge

    Eigen::Vector2d middle_W(double disc_m) const;
  };
  struct Track {
    Eigen::Vector4d state;  ///< p_W, v_W
    Eigen::Matrix4d covariance;
    double radius_m;
    int evidence = 1, unseen = 0;  ///< images
    bool is_moving = false;
    VisibleSurface surface = {};
  };

  std::vector<Cluster> clusters_of(const ViewSector& view, std::span<const SurfacePoint> points) const;
  void predict(double dt_s);
  void correct(Track& track, const Cluster& cluster, const ViewSector& view) const;
  /// Whether a track's near surface is too near to be measured: what is seen of it is farther.
  bool hides(const Track& track, const Eigen::Vector2d& camera_W) const;
  /// Of a cluster's middle: exact across the line of sight, vague along it.
  Eigen::Matrix2d covariance_m2(const Eigen::Vector2d& p_W, const Eigen::Vector2d& camera_W) const;

  Config config_;
  std::vector<Track> tracks_;
  double t_s_ = 0.0;
};

}  // namespace hedgehop::avoidance::local_map
