#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "vision/mapping/depth_blocks.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

struct OccupancyMapConfig {
  double voxel_m = 0.3;   ///< edge, > 0
  int across = 160;       ///< voxels north and east, > 0
  int layers = 12;        ///< voxels down, > 0
  double noise_px = 0.5;  ///< 1-sigma of a disparity, > 0
  double far_m = 22.0;    ///< up to which sky clears, > 0
};

/// What is known of the space around the vehicle: log-odds in voxels that move along with it.
/// - Log-odds are added image by image and clamped, so that the map follows what changes: [Hornung2013] eq. (2) and
/// (4).
/// - The voxels lie in a ring buffer: moving on clears what comes in, and copies nothing: [Usenko2017] sec. IV.
/// Differs from both: rays are not walked; each voxel within the view looks up the block it is seen in, which costs the
/// same for every range and leaves no gaps between rays. It is free only where that block was seen through, up to the
/// measured depth less two sigma of its inverse. What no ray meets keeps its value, and forgets it with time.
class OccupancyMap {
 public:
  enum class State : uint8_t { unknown, free, occupied };
  using Index = Eigen::Vector3i;  ///< of a voxel of the world: floor(p_W / voxel_m)

  /// Throws std::invalid_argument on a bad config.
  explicit OccupancyMap(const OccupancyMapConfig& config);

  /// Forgets everything and centers on a point.
  void reset(const Eigen::Vector3d& center_W);
  /// Moves the window to a new center; what enters it is unknown.
  void move(const Eigen::Vector3d& center_W);
  /// An upright cylinder.
  struct MovingDisc {
    Eigen::Vector2d p_W;
    double radius_m;
  };
  /// Adds an image. @param X_WC  the left camera's pose when it was exposed, as estimated. @param moving  what moves:
  /// surfaces in it are not placed in the map, where they would stay behind as a wake.
  void integrate(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC,
                 std::span<const MovingDisc> moving = {});
  /// A surface of the last image, whether it is near enough to be placed in the map or not.
  struct Hit {
    Eigen::Vector3d p_W;  ///< the point, m
    bool was_free;        ///< before: what stands still does not come where free space was seen
  };
  const std::vector<Hit>& hits() const { return hits_; }
  /// All voxels take one step towards unknown.
  void fade();
  /// The voxels with centers in an upright cylinder become free: no obstacle is where the vehicle is.
  void clear_cylinder(const Eigen::Vector3d& center_W, double radius_m, double half_height_m);

  State state(const Index& voxel) const;
  /// Whether a voxel was hit more than it was seen through.
  bool is_suspect(const Index& voxel) const { return contains(voxel) && log_odds_[slot(voxel)] > 0; }
  Index index(const Eigen::Vector3d& p_W) const;
  Eigen::Vector3d center(const Index& voxel) const;
  /// The window: [first, first + size) in each direction.
  const Index& first() const { return first_; }
  Index size() const { return {config_.across, config_.across, config_.layers}; }
  const OccupancyMapConfig& config() const { return config_; }
  /// States of the voxels (north i, east 0 ... across - 1) of a layer, from first() on.
  void read_row(int layer, int north, std::vector<State>& row) const;

 private:
  size_t slot(const Index& voxel) const;
  bool contains(const Index& voxel) const;
  void find_clear(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry);
  void add_hits(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC,
                std::span<const MovingDisc> moving);
  void add_misses(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC);

  OccupancyMapConfig config_;
  Index first_ = Index::Zero();
  std::vector<int8_t> log_odds_;  ///< in kStep; 0 is unknown
  std::vector<uint8_t> hit_;      ///< in this image
  std::vector<size_t> hit_slots_;
  std::vector<Hit> hits_;       ///< of hit_slots_
  std::vector<float> clear_m_;  ///< of each block
};

}  // namespace hedgehop::vision::mapping
