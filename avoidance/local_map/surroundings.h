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

namespace hedgehop::avoidance::local_map {

/// What is known around the vehicle in a flight: a map of all images, what moves through it, and the slice of both that
/// the vehicle flies in.
class Surroundings {
 public:
  /// @param config, hull_discs  outlive it.
  Surroundings(const LocalMapConfig& config, const Setup& setup, const HullDiscs& hull_discs);

  /// @return whether the frames hold a new image of any pair.
  bool take(std::span<const CameraFrame> frames);
  /// Where the flight begins, the vehicle was put or took off: free up to where the camera sees all that it will fly
  /// through, its width and its height.
  void begin(const NavigationState& navigation);
  /// Puts the images that were taken into the map.
  void see(const NavigationState& navigation, double t_s);
  /// Takes what lies around a place for an obstacle.
  void close(const Eigen::Vector2d& p_W, double radius_m, double t_s) {
    closed_.close({p_W.x(), p_W.y(), height_W_}, radius_m, t_s);
  }
  /// From now on flies at another height; until the vehicle is there, slice() holds all that lies between.
  void change_height(double z_W) {
    from_W_ = height_W_;
    height_W_ = z_W;
  }
  bool changes_height() const { return from_W_.has_value(); }
  /// What is known from one height to another, z in W; nothing where the map does not reach as far.
  bool slice_between(double from_W, double to_W, LevelSlice& slice) const;

  const LevelSlice& slice() const { return slice_; }
  const std::vector<MovingObstacle>& moving_obstacles() const { return moving_obstacles_; }
  const vision::mapping::DepthBlocks& blocks() const { return pairs_.front().blocks; }  ///< of the first pair
  size_t closed_cells() const { return closed_.size(); }
  double height_W() const { return height_W_; }  ///< z that is flown at
  double blind_m() const { return blind_m_; }    ///< from B, within which images do not show all that is flown through
  /// From the middle of the first pair's images to their sides.
  double half_view_rad() const {
    const stereo::DisparitySource& source = pairs_.front().source;
    return std::atan(0.5 * source.image().width / source.geometry().focal_px);
  }
  /// Whether any pair sees what lies in a direction, level. @param azimuth_rad  from the nose to the right.
  bool looks_along(double azimuth_rad) const;

 private:
  struct CameraPair {
    stereo::DisparitySource source;
    vision::mapping::DepthBlocks blocks;
    bool fresh = false;  ///< has taken an image that is not in the map yet
  };

  HeightRange band(double z_W) const;
  HeightRange between(double from_W, double to_W) const;
  void clear(const Eigen::Vector3d& p_W, double radius_m);
  void integrate(CameraPair& pair, const NavigationState& navigation, double t_s);
  void fade(const NavigationState& navigation, double t_s);
  const std::vector<vision::mapping::OccupancyMap::MovingDisc>& predicted_discs(double t_s);
  void remember_occupied(double t_s);
  void track_moving_obstacles(double t_s, const CameraPair& pair, const Eigen::Isometry3d& X_WC);

  const LocalMapConfig& config_;
  const HullDiscs& hull_discs_;
  double radius_m_;                ///< of the hull
  HeightRange hull_;               ///< heights of the hull's top and bottom, from B
  std::vector<CameraPair> pairs_;  ///< the first pair, then the others
  vision::mapping::OccupancyMap map_;
  LevelSlice slice_;
  ClosedCells closed_;
  double remembered_s_ = 0.0;  ///< when what is occupied was put there last
  MovingObstacleTracker tracker_;
  std::vector<SurfacePoint> surface_;  ///< of the last image, at the heights that are flown through
  std::vector<MovingObstacle> moving_obstacles_;
  double obstacles_at_s_ = 0.0;
  std::vector<vision::mapping::OccupancyMap::MovingDisc> discs_;
  double blind_m_ = 0.0, height_W_ = 0.0;
  std::optional<double> from_W_;       ///< height that it comes from
  double age_s_ = 0.0, seen_s_ = 0.0;  ///< of the map since it faded last, and when the last image came
};

}  // namespace hedgehop::avoidance::local_map
