#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "avoidance/flow_balance/side_cameras.h"
#include "avoidance/module.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {

/// The stop of a vehicle: it continues for `reaction_s` (>= 0), then decelerates with `braking_mps2` (> 0).
struct Stopping {
  double reaction_s = 0.0;
  double braking_mps2 = 1.0;
};

/// Returns the distance that a vehicle covers towards an obstacle until it no longer approaches it, m: v_n (t + v / (2
/// a)), where v_n is `closing_mps`; 0 if the vehicle recedes.
/// @param reversing_mps  the part v of the velocity that is reversed. In a corner that is the whole velocity, and the
/// component towards a wall decreases as slowly as the whole.
double stopping_distance_m(double closing_mps, double reversing_mps, const Stopping& stopping);

/// Returns the inverse of the range minus a distance, 1/m; 1000 if the difference is not positive.
/// @param inverse_range_per_m  of the obstacle, >= 0.  @param distance_m  >= 0.
double inverse_range_left_per_m(double inverse_range_per_m, double distance_m);

/// One number per side, in the order of kSideRoles.
using PerSide = std::array<double, kSideCount>;

/// Motion of the vehicle towards obstacles, and the properties of its stop.
struct Approach {
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();      ///< velocity in H, m/s
  Eigen::Vector2d v_cmd_H = Eigen::Vector2d::Zero();  ///< commanded velocity in H, m/s
  Stopping stopping;
  double tail_m = 0.0;         ///< additional extent of the vehicle aft, compared with its other sides, >= 0
  bool reverses_both = false;  ///< whether both components of the velocity are reversed at once, as in a corner
};

/// Measurement of one column of patches of a camera.
struct RangeColumn {
  Eigen::Vector2d direction_H = Eigen::Vector2d::UnitX();  ///< level, length 1
  double inverse_range_per_m = 0.0;                        ///< of the nearest obstacles in the column; 0 if unknown
  double weight = 0.0;  ///< mean of vision::flow::parallax_weights() of the counted patches; 0 without flow
};

/// A method that computes ranges from the flow of four cameras.
class Ranging {
 public:
  virtual ~Ranging() = default;

  /// Adds the last measurements of the cameras.
  virtual void update(const SideCameras& cameras, const NavigationState& navigation) = 0;
  /// Returns the inverse range of the nearest obstacle on each side, 1/m; 0 if no obstacle is known.
  virtual PerSide nearest_per_m() const = 0;
  /// Returns the inverse range that remains after a stop on each side, 1/m. Only obstacles on the path count, and only
  /// when the vehicle no longer moves away from them: while it rolls to reverse, ranges from flow err by meters.
  virtual PerSide left_once_stopped_per_m(const Approach& approach) const = 0;
};

/// Ranges from the mean flow and loom of each camera: the nearer of the two. The method has no direction within an
/// image, so left_once_stopped_per_m() equals nearest_per_m(). Source: [Garratt2009] sec. 4.
class MeanRanging final : public Ranging {
 public:
  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  PerSide left_once_stopped_per_m(const Approach&) const override { return nearest_per_m_; }

 private:
  PerSide nearest_per_m_{};
};

/// Stores the inverse ranges of the patches of one camera while flow hardly measures them, for example around the focus
/// of expansion while a turn moves it across the image. A range that is not measured again changes with the motion of
/// the vehicle and decays.
class RangeMemory {
 public:
  /// @param time_constant_s  of the decay; 0 disables the memory.
  explicit RangeMemory(double time_constant_s) : time_constant_s_(time_constant_s) {}

  /// Measurement of one patch in one image.
  struct Measurement {
    double inverse_range_per_m = 0.0;  ///< inverse range times `weight`; NaN if the flow is not valid
    double weight = 0.0;               ///< 0 if the motion gives no range, 1 if it gives the full range
    double closing_mps = 0.0;          ///< speed towards the direction of the patch
  };

  /// Adds the patches of an image, always the same number.  @param dt_s  time since the last image, > 0.
  /// @return inverse range of every patch, 1/m; NaN if it has never been measured.
  const std::vector<double>& update(std::span<const Measurement> measurements, double dt_s);

 private:
  double time_constant_s_;
  std::vector<double> inverse_ranges_per_m_;
};

/// Keeps for every patch of one camera the range on which its last images agree. A wrong flow vector seldom lasts, and
/// one missing vector does not make a wall vanish.
class LastingRanges {
 public:
  /// @param images  number of images in the memory, at least 1.
  explicit LastingRanges(int images) : latest_(static_cast<size_t>(images)) {}

  /// Adds the inverse ranges of the patches of an image, 1/m, NaN if unknown; always the same number of patches.
  void add(std::vector<double> inverse_ranges_per_m);
  /// Minimum known inverse range of each patch over the last images, 1/m; 0 if at most half of the images have one.
  std::vector<double> lasting_per_m() const;

 private:
  std::vector<std::vector<double>> latest_;
  size_t next_ = 0;
};

/// Ranges of single patches, each from its own flow. The range of a side is the mean over its nearest tenth of patches.
/// The flow must be derotated. Not in the paper.
class PatchRanging final : public Ranging {
 public:
  struct Options {
    double floor_mps = 0.2;  ///< see vision::flow::inverse_depth_per_m(), > 0
    double memory_s = 0.0;   ///< see RangeMemory, >= 0
    int images = 3;          ///< see LastingRanges, at least 1
    /// Patches whose center is higher above the horizon than this are not counted.
    double max_elevation_rad = 0.5 * std::numbers::pi;
  };
  explicit PatchRanging(const Options& options);

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// A side without a measurement, or with one that is too old, counts as far.
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  /// Uses the patches within 60 degrees of the path.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;

  /// The columns of one camera, from left to right; empty before the first image. The range of a column is the mean
  /// over the nearest quarter of its counted patches, because sky, ground and far roofs must not hide a wall between
  /// them.
  std::vector<RangeColumn> columns(size_t side) const;

 private:
  struct Side {
    RangeMemory memory;
    LastingRanges lasting;
    std::vector<Eigen::Vector2d> directions_H;  ///< directions of the patches, level, length 1
    std::vector<double> weights;  ///< of the patches of the last image; 0 without flow, NaN if not counted
    int cols = 0;
  };
  void add_image(const CameraFlow& camera, const NavigationState& navigation, double dt_s, Side& side) const;

  Options options_;
  std::vector<Side> sides_;  ///< in the order of kSideRoles
  PerSide nearest_per_m_{};
};

/// Returns the vertical walls around a vehicle from the newest flow of all its cameras, in frame H. Tilt is neglected:
/// the camera axes are assumed level as they are mounted in B.
/// @param cameras  derotated, level.  @param now_ns  measurements that are too old at this time are omitted.
std::vector<vision::flow::WallEstimate> fit_walls(std::span<const CameraFlow> cameras,
                                                  const NavigationState& navigation, int64_t now_ns);

/// Ranges of vertical walls that are fitted to the flow of all cameras at once. If no wall fits, ranges of patches are
/// used instead. The flow must be derotated. Not in the paper.
class WallRanging final : public Ranging {
 public:
  explicit WallRanging(const PatchRanging::Options& patches) : patches_(patches) {}

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// Ranges of the nearest patches, which also measure obstacles that are narrower than a wall.
  PerSide nearest_per_m() const override { return patches_.nearest_per_m(); }
  /// Ranges of walls from the hull, independent of the camera positions.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;
  /// The walls of the last images, in H.
  std::span<const vision::flow::WallEstimate> walls() const { return walls_; }

 private:
  double left_on_side_per_m(const Eigen::Vector2d& axis_H, const Approach& approach) const;

  PatchRanging patches_;
  SideAxes axes_H_{};
  std::vector<vision::flow::WallEstimate> walls_;
};

}  // namespace hedgehop::avoidance::flow_balance
