#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "avoidance/local_map/hull_clearance.h"
#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/local_map.h"
#include "avoidance/local_map/moving_obstacles.h"
#include "avoidance/module.h"
#include "avoidance/stereo/disparity_source.h"
#include "vision/mapping/depth_blocks.h"
#include "vision/mapping/occupancy_map.h"
#include "vision/stereo/coarse_matcher.h"
#include "vision/stereo/line_matcher.h"

namespace hedgehop::avoidance::local_map {

/// Knowledge of the space around the vehicle during a flight: the map of all images, moving obstacles, and the slice of
/// both at the flight altitude.
class Surroundings {
 public:
  /// Returns the cameras of all pairs.
  static Needs needs(const LocalMapConfig& config);

  /// @param config, hull_discs  must outlive this object.
  Surroundings(const LocalMapConfig& config, const Setup& setup, const HullDiscs& hull_discs);

  /// @return whether the frames contain a new image of any pair.
  bool take(std::span<const CameraFrame> frames, const NavigationState& navigation);
  /// Starts a flight. The hull and a strip ahead count as free, up to the distance at which the camera sees the full
  /// width and height of the vehicle.
  void begin(const NavigationState& navigation);
  /// Adds the taken images to the map.
  void see(const NavigationState& navigation, double t_s);
  /// Marks the area around a position as an obstacle.
  void close(const Eigen::Vector2d& p_W, double radius_m, double t_s) {
    closed_.close({p_W.x(), p_W.y(), height_W_}, radius_m, t_s);
  }
  /// Changes the flight altitude. Until the vehicle is there, slice() contains all altitudes between.
  void change_height(double z_W) {
    from_W_ = height_W_;
    height_W_ = z_W;
  }
  bool changes_height() const { return from_W_.has_value(); }
  /// Builds the slice from one altitude to another, z in W. @return false if the map does not extend to them.
  bool slice_between(double from_W, double to_W, LevelSlice& slice) const;

  const LevelSlice& slice() const { return slice_; }
  const std::vector<MovingObstacle>& moving_obstacles() const { return moving_obstacles_; }
  const vision::mapping::DepthBlocks& blocks() const { return pairs_.front().blocks; }  ///< of the first pair
  size_t closed_cells() const { return closed_.size(); }
  double height_W() const { return height_W_; }  ///< z of the flight altitude
  double blind_m() const {
    return blind_m_;
  }  ///< distance from B within which images do not show the whole flight corridor
  /// Angle from the center of the images of the first pair to their sides.
  double half_view_rad() const {
    const stereo::DisparitySource& source = pairs_.front().source;
    return std::atan(0.5 * source.image().width / source.geometry().focal_px);
  }
  /// Whether any pair shows a direction, level. @param azimuth_rad  from the nose to the right.
  bool looks_along(double azimuth_rad) const;

 private:
  struct CameraPair {
    stereo::DisparitySource source;
    vision::stereo::CoarseMatcher coarse;
    vision::mapping::DepthBlocks blocks;
    vision::stereo::LineMatcher lines;
    cv::Mat lines16;     ///< disparity x 16 of the thin line in each block
    cv::Mat sigma16;     ///< as that of the source, of a pair that was matched coarsely, too
    bool fresh = false;  ///< has an image that is not in the map yet
  };

  HeightRange band(double z_W) const;
  HeightRange between(double from_W, double to_W) const;
  void clear(const Eigen::Vector3d& p_W, double radius_m);
  void integrate(CameraPair& pair, vision::mapping::OccupancyMap::Instant instant, const NavigationState& navigation,
                 double t_s);
  void build_blocks(CameraPair& pair, const cv::Mat& sigma16, const Eigen::Vector3d& down_C, double height_m) const;
  void fade(const NavigationState& navigation, double t_s);
  const std::vector<vision::mapping::OccupancyMap::MovingDisc>& predicted_discs(double t_s);
  void remember_occupied(double t_s);
  void track_moving_obstacles(double t_s, const CameraPair& pair, const Eigen::Isometry3d& X_WC);

  const LocalMapConfig& config_;
  const HullDiscs& hull_discs_;
  double radius_m_;                ///< of the hull
  HeightRange hull_;               ///< altitudes of the top and bottom of the hull, from B
  std::vector<CameraPair> pairs_;  ///< the first pair, then the others
  vision::mapping::OccupancyMap map_;
  LevelSlice slice_;
  ClosedCells closed_;
  double remembered_s_ = 0.0;  ///< last time at which occupied cells were stored
  MovingObstacleTracker tracker_;
  std::vector<SurfacePoint> surface_;  ///< points of the last image within the altitude range
  std::vector<MovingObstacle> moving_obstacles_;
  double obstacles_at_s_ = 0.0;
  std::vector<vision::mapping::OccupancyMap::MovingDisc> discs_;
  double blind_m_ = 0.0, height_W_ = 0.0;
  std::optional<double> from_W_;       ///< previous flight altitude
  double age_s_ = 0.0, seen_s_ = 0.0;  ///< age of the map since it last faded, and time of the last image
};

}  // namespace hedgehop::avoidance::local_map
