#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "avoidance/flow_balance/side_cameras.h"
#include "avoidance/module.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {

/// How a vehicle stops: it flies on for `reaction_s` (>= 0), then decelerates by `braking_mps2` (> 0).
struct Stopping {
  double reaction_s = 0.0;
  double braking_mps2 = 1.0;
};

/// Returns the distance that a vehicle still covers, m, towards an obstacle that it approaches at `closing_mps`, until
/// it approaches it no longer: v_n (t + v / (2 a)); 0 when it recedes.
/// @param reversing_mps  the part v of its velocity that is reversed. In a corner that is all of it, and the component
/// towards a wall falls as slowly as the whole.
double stopping_distance_m(double closing_mps, double reversing_mps, const Stopping& stopping);

/// Returns the inverse of the range less a distance, 1/m; 1000 where nothing is left.
/// @param inverse_range_per_m  of the obstacle, >= 0.  @param distance_m  >= 0.
double inverse_range_left_per_m(double inverse_range_per_m, double distance_m);

/// One number per side, in the order of kSideRoles.
using PerSide = std::array<double, kSideCount>;

/// How the vehicle moves towards obstacles and how it would stop.
struct Approach {
  Eigen::Vector2d v_H = Eigen::Vector2d::Zero();      ///< velocity in H, m/s
  Eigen::Vector2d v_cmd_H = Eigen::Vector2d::Zero();  ///< velocity that it is to fly, in H, m/s
  Stopping stopping;
  double tail_m = 0.0;         ///< the vehicle reaches so much farther aft than to its other sides, >= 0
  bool reverses_both = false;  ///< both components of the velocity are reversed at once, as in a corner
};

/// What a column of a camera's patches measures.
struct RangeColumn {
  Eigen::Vector2d direction_H = Eigen::Vector2d::UnitX();  ///< level, length 1
  double inverse_range_per_m = 0.0;                        ///< of what is near in it; 0 where nothing is known
  double weight = 0.0;  ///< mean of vision::flow::parallax_weights(), patches without flow counting 0
};

/// A method to get ranges from the flow of four cameras.
class Ranging {
 public:
  virtual ~Ranging() = default;

  /// Takes in what the cameras measured last.
  virtual void update(const SideCameras& cameras, const NavigationState& navigation) = 0;
  /// Returns the inverse range of the nearest obstacle on each side, 1/m; 0 where none is known.
  virtual PerSide nearest_per_m() const = 0;
  /// Returns the same, of obstacles that bar the path only, and of the range that is left once the vehicle has stopped.
  virtual PerSide left_once_stopped_per_m(const Approach& approach) const = 0;
};

/// Ranges from each camera's mean flow and loom: the nearer of the two. It knows no direction within an image, so that
/// left_once_stopped_per_m() equals nearest_per_m(). Source: [Garratt2009] sec. 4.
class MeanRanging final : public Ranging {
 public:
  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  PerSide left_once_stopped_per_m(const Approach&) const override { return nearest_per_m_; }

 private:
  PerSide nearest_per_m_{};
};

/// Remembers the inverse ranges of one camera's patches while flow hardly measures them, as around the focus of
/// expansion while a turn sweeps it across the image. A range that is not measured again changes with the vehicle's own
/// motion, and fades.
class RangeMemory {
 public:
  /// @param time_constant_s  of the fading; 0 remembers nothing.
  explicit RangeMemory(double time_constant_s) : time_constant_s_(time_constant_s) {}

  /// What one image measures of a patch.
  struct Measurement {
    double inverse_range_per_m = 0.0;  ///< times `weight`; NaN where the flow is not valid
    double weight = 0.0;               ///< 0 where the motion measures no range, 1 where it measures it in full
    double closing_mps = 0.0;          ///< speed towards the patch's direction
  };

  /// Takes in an image's patches, the same number every time.  @param dt_s  since the last image, > 0.
  /// @return inverse range of every patch, 1/m; NaN only where nothing has been measured yet.
  const std::vector<double>& update(std::span<const Measurement> measurements, double dt_s);

 private:
  double time_constant_s_;
  std::vector<double> inverse_ranges_per_m_;
};

/// Retains of every patch of one camera only what its last images agree on: a wrong flow vector seldom lasts, and a
/// vector missing from one image does not make a wall vanish.
class LastingRanges {
 public:
  /// @param images  how many are remembered, at least 1.
  explicit LastingRanges(int images) : latest_(static_cast<size_t>(images)) {}

  /// Takes in the inverse ranges of an image's patches, 1/m, NaN where unknown; the same number every time.
  void add(std::vector<double> inverse_ranges_per_m);
  /// The least known inverse range of each patch over the last images, 1/m; 0 where at most half know one.
  std::vector<double> lasting_per_m() const;

 private:
  std::vector<std::vector<double>> latest_;
  size_t next_ = 0;
};

/// Ranges of single patches, each by its own flow. A side is as near as the mean of its nearest tenth of patches.
/// The flow must be derotated. Ours.
class PatchRanging final : public Ranging {
 public:
  struct Options {
    double floor_mps = 0.2;  ///< see vision::flow::inverse_depth_per_m(), > 0
    double memory_s = 0.0;   ///< see RangeMemory, >= 0
    int images = 3;          ///< see LastingRanges, at least 1
  };
  explicit PatchRanging(const Options& options);

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// A side counts as far while its camera's measure is missing or too old.
  PerSide nearest_per_m() const override { return nearest_per_m_; }
  /// Counts the patches that lie within 60 degrees of the path.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;

  /// The columns of one camera, from left to right: of each the mean of its nearest quarter of patches, for sky, ground
  /// and far roofs must not hide a wall between them. Empty before the first image.
  std::vector<RangeColumn> columns(size_t side) const;

 private:
  struct Side {
    RangeMemory memory;
    LastingRanges lasting;
    std::vector<Eigen::Vector2d> directions_H;  ///< of the patches, level, length 1
    std::vector<double> weights;                ///< of the last image's patches, 0 for one without flow
    int cols = 0;
  };
  void add_image(const CameraFlow& camera, const NavigationState& navigation, double dt_s, Side& side) const;

  Options options_;
  std::vector<Side> sides_;  ///< in the order of kSideRoles
  PerSide nearest_per_m_{};
};

/// Returns the upright walls round a vehicle by the newest flow of all its cameras, in frame H. Tilt is left out: the
/// cameras' axes are taken level as they are mounted in B.
/// @param cameras  derotated, looking level.  @param now_ns  measures that are too old by then are left out.
std::vector<vision::flow::WallEstimate> fit_walls(std::span<const CameraFlow> cameras,
                                                  const NavigationState& navigation, int64_t now_ns);

/// Ranges of upright walls that are fitted to the flow of all cameras at once. Where no wall fits, ranges of patches
/// stand in. The flow must be derotated. Ours.
class WallRanging final : public Ranging {
 public:
  explicit WallRanging(const PatchRanging::Options& patches) : patches_(patches) {}

  void update(const SideCameras& cameras, const NavigationState& navigation) override;
  /// Of the nearest patches: they also measure what is narrower than a wall.
  PerSide nearest_per_m() const override { return patches_.nearest_per_m(); }
  /// Of walls, from the vehicle's side, so that the cameras' positions do not matter.
  PerSide left_once_stopped_per_m(const Approach& approach) const override;

 private:
  double left_on_side_per_m(const Eigen::Vector2d& axis_H, const Approach& approach) const;

  PatchRanging patches_;
  SideAxes axes_H_{};
  std::vector<vision::flow::WallEstimate> walls_;
};

}  // namespace hedgehop::avoidance::flow_balance
