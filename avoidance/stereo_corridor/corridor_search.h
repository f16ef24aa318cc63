#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo_corridor {

/// The step of [Andert2007] sec. 4.3.4 that found a target. Ours: `goal`, and `approach` to one above or below the
/// view.
enum class FoundBy { goal, approach, keep, track, near, search };
/// Its name in decisions and images.
const char* name_of(FoundBy step);

/// Whether a velocity is great enough to have a direction: below, the estimate's errors decide.
inline bool is_moving(const Eigen::Vector3d& v_WB) {
  constexpr double kStandingMps = 0.5;
  return v_WB.norm() > kStandingMps;
}

/// A pixel whose ray runs through a free corridor.
struct Target {
  cv::Point pixel;
  double z_m = 0.0;  ///< depth up to which the corridor is free, z in C; +infinity for sky
  FoundBy found_by = FoundBy::search;
};

/// What a corridor must be. Both numbers are the paper's symbols: r and tau_target.
struct CorridorSize {
  double radius_m = 2.5;
  double target_m = 30.0;  ///< [Andert2007] sec. 5
};

/// The search for a flight target in one depth image. Source: [Andert2007] sec. 4.
class CorridorSearch {
 public:
  /// Longest path to a target point, m: what is farther does not change where to fly now.
  static constexpr double kLookAheadM = 30.0;
  /// Levels of the pyramid between which the image is divided: blocks of 32 px down to 8 px. The paper leaves them
  /// open.
  static constexpr int kCoarsestLevel = 5, kFinestLevel = 3;

  /// Whether a direction in C may be flown at all; empty: every one.
  using Allowed = std::function<bool(const Eigen::Vector3d& ray_C)>;

  /// @param pyramid  of the filtered disparity, at least kCoarsestLevel high; it must outlive the search.
  CorridorSearch(const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
                 const CorridorSize& size, Allowed allowed = {});

  /// The whole law as printed: steps 1 to 4 of [Andert2007] sec. 4.3.4; nothing where step 5, to hover and turn, is
  /// due. @param flight_C  direction of flight in C. @param followed  where the last target is now, if it is known.
  std::optional<Target> join(const Eigen::Vector3d& flight_C, const std::optional<cv::Point>& followed);

  /// Step 1 for any direction: the target at its pixel, if that lies in the image and its corridor is free.
  std::optional<Target> along(const Eigen::Vector3d& direction_C, FoundBy step);
  /// Towards a place that lies above or below the view, but not aside: the target at the edge of the image that is
  /// nearest to it, whose corridor need be free only as far as the place. Ours. @param p_C  the place, m.
  std::optional<Target> below_or_above(const Eigen::Vector3d& p_C);
  /// Steps 2 and 3: the followed target, else the best one near it.
  std::optional<Target> near(const std::optional<cv::Point>& followed);
  /// Step 4: the best target of the whole image. @param reference_C  direction from which a change costs.
  std::optional<Target> anywhere(const Eigen::Vector3d& reference_C);

  /// Candidates of step 4. [Andert2007] sec. 4.3.1.
  std::vector<cv::Point> far_blocks() const;
  /// The pixel that shows a direction, if it lies in the image.
  std::optional<cv::Point> pixel_of(const Eigen::Vector3d& direction_C) const;
  /// Whether the corridor round a pixel's ray is free.
  bool is_free(const cv::Point& pixel) const { return corridor(pixel, size_.target_m).has_value(); }
  /// Pixels and blocks examined so far.
  int tests() const { return tests_; }

 private:
  std::optional<vision::stereo::Corridor> corridor(const cv::Point& pixel, double target_m, int* tests = nullptr) const;
  std::optional<Target> at(const cv::Point& pixel, FoundBy step);
  std::optional<Target> cheapest(const std::vector<cv::Point>& candidates, const Eigen::Vector3d& reference_C,
                                 FoundBy step);

  const vision::stereo::DepthPyramid& pyramid_;
  vision::stereo::StereoGeometry geometry_;
  CorridorSize size_;
  Allowed allowed_;
  int tests_ = 0;
};

/// Follows a pixel from image to image with the pyramidal Lucas-Kanade tracker. [Andert2007] sec. 4.3.2, eq. (15).
class TargetTracker {
 public:
  /// Returns where a pixel of the last image is in this one; nothing when it is lost or has left the image, or when
  /// there was no last image. This image becomes the last. @param grey  CV_8UC1.
  std::optional<cv::Point> follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey);

 private:
  cv::Mat last_;
};

}  // namespace hedgehop::avoidance::stereo_corridor
