#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "vision/mapping/depth_blocks.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::vision::mapping {

/// Size and sensor model of an occupancy map.
struct OccupancyMapConfig {
  double voxel_m = 0.3;   ///< edge, > 0
  int across = 160;       ///< number of voxels north and east, > 0
  int layers = 12;        ///< number of voxels down, > 0
  double noise_px = 0.5;  ///< 1-sigma of a disparity whose block does not give it, > 0
  double far_m = 22.0;    ///< range up to which sky marks voxels as free, > 0
};

/// Occupancy of the space around the vehicle: log-odds in a voxel grid that moves with the vehicle.
/// - Log-odds are accumulated over images and clamped, so that the map adapts to changes: [Hornung2013] eq. (2) and
/// (4).
/// - The voxels are stored in a ring buffer. A move clears the voxels that enter and copies no data: [Usenko2017] sec.
/// IV. Differs from both: there is no ray casting. Each voxel in view looks up the depth block that it projects to, so
/// that the cost does not depend on range and rays leave no gaps. A voxel is free only up to the measured depth of its
/// block minus two sigma of the inverse depth. Voxels without observations keep their value, which fades over time.
class OccupancyMap {
 public:
  enum class State : uint8_t { unknown, free, occupied };
  using Index = Eigen::Vector3i;  ///< of a voxel of the world: floor(p_W / voxel_m)

  /// Throws std::invalid_argument on an invalid config.
  explicit OccupancyMap(const OccupancyMapConfig& config);

  /// Clears the map and centers it on a point.
  void reset(const Eigen::Vector3d& center_W);
  /// Moves the window to a new center. Voxels that enter are unknown.
  void move(const Eigen::Vector3d& center_W);
  /// A vertical cylinder around a moving obstacle.
  struct MovingDisc {
    Eigen::Vector2d p_W;
    double radius_m;
  };
  /// Whether an image is of the same instant as the one before. Free space in it then does not outweigh a thin object
  /// in the other image.
  enum class Instant : uint8_t { next, same };
  /// Adds an image. @param X_WC  estimated pose of the left camera at exposure. @param moving  moving obstacles: their
  /// surfaces are not added to the map, because they would leave a trail.
  void integrate(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC,
                 std::span<const MovingDisc> moving = {}, Instant instant = Instant::next);
  /// A surface point of the last image inside the window, including points too uncertain for the map.
  struct Hit {
    Eigen::Vector3d p_W;  ///< m
    bool was_free;        ///< whether its voxel was free before; a fixed obstacle does not appear in free space
  };
  /// Without thin lines, which count as fixed: they are seen late, in space that was free.
  const std::vector<Hit>& hits() const { return hits_; }
  /// Moves all voxels one step toward unknown.
  void fade();
  /// Marks the voxels of a vertical cylinder as free, because the vehicle occupies it: in each layer that it touches,
  /// those with centers within its radius.
  void clear_cylinder(const Eigen::Vector3d& center_W, double radius_m, double half_height_m);

  State state(const Index& voxel) const;
  /// Returns whether a voxel has more evidence for occupied than for free.
  bool is_suspect(const Index& voxel) const { return contains(voxel) && log_odds_[slot(voxel)] > 0; }
  Index index(const Eigen::Vector3d& p_W) const;
  Eigen::Vector3d center(const Index& voxel) const;
  /// Returns the start of the window, which is [first, first + size) in each direction.
  const Index& first() const { return first_; }
  Index size() const { return {config_.across, config_.across, config_.layers}; }
  const OccupancyMapConfig& config() const { return config_; }
  /// Reads the states of the voxels (north i, east 0 ... across - 1) of a layer, relative to first().
  void read_row(int layer, int north, std::vector<State>& row) const;

 private:
  size_t slot(const Index& voxel) const;
  bool contains(const Index& voxel) const;
  /// Returns the 1-sigma error of the disparity of a block, px.
  double noise_px(const DepthBlock& block) const;
  void find_clear(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry);
  void add_hits(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC,
                std::span<const MovingDisc> moving);
  void add_misses(const DepthBlocks& blocks, const stereo::StereoGeometry& geometry, const Eigen::Isometry3d& X_WC,
                  std::span<const MovingDisc> moving);

  OccupancyMapConfig config_;
  Index first_ = Index::Zero();
  std::vector<int8_t> log_odds_;  ///< in steps of 0.4; 0: unknown
  std::vector<uint8_t> marks_;    ///< hit in this image; doubted in an image of this instant
  std::vector<size_t> hit_slots_, doubted_slots_;
  std::vector<Hit> hits_;
  std::vector<float> clear_m_;  ///< of each block
  /// Range of z in C in which a thin object reduces the evidence for free space; empty if from >= to.
  struct Doubt {
    float from_m, to_m;
    bool matched = false;  ///< whether the object has a depth
  };
  std::vector<Doubt> doubts_;  ///< of each block
};

}  // namespace hedgehop::vision::mapping
