#pragma once

#include <Eigen/Core>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "vision/stereo/disparity.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo_corridor {

/// The step of [Andert2007] sec. 4.3.4 that found a target. Not in the paper: `goal`, and `approach` to a goal above or
/// below the view.
enum class FoundBy { goal, approach, keep, track, near, search };
/// Returns the name of a step for decisions and images.
const char* name_of(FoundBy step);

/// Returns whether a velocity is large enough to have a direction. Below the threshold, estimation errors dominate.
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

/// Required size of a corridor. Both numbers are symbols of the paper: r and tau_target.
struct CorridorSize {
  double radius_m = 2.5;
  double target_m = 30.0;  ///< [Andert2007] sec. 5
};

/// The search for a flight target in one depth image. Source: [Andert2007] sec. 4.
class CorridorSearch {
 public:
  /// Maximum length of the path to a target point, m. Farther obstacles do not change the current command.
  static constexpr double kLookAheadM = 30.0;
  /// Levels of the pyramid that divide the image: blocks of 32 px down to 8 px. The paper does not specify them.
  static constexpr int kCoarsestLevel = 5, kFinestLevel = 3;

  /// Returns whether a direction in C may be flown; an empty function allows all directions.
  using Allowed = std::function<bool(const Eigen::Vector3d& ray_C)>;

  /// @param pyramid  of the filtered disparity, with at least kCoarsestLevel levels; must outlive the search.
  CorridorSearch(const vision::stereo::DepthPyramid& pyramid, const vision::stereo::StereoGeometry& geometry,
                 const CorridorSize& size, Allowed allowed = {});

  /// The whole published law: steps 1 to 4 of [Andert2007] sec. 4.3.4. Empty if step 5, hover and turn, is due.
  /// @param flight_C  direction of flight in C. @param followed  current pixel of the last target, if known.
  std::optional<Target> join(const Eigen::Vector3d& flight_C, const std::optional<cv::Point>& followed);

  /// Step 1 for any direction: the target at its pixel, if the pixel is in the image and its corridor is free.
  std::optional<Target> along(const Eigen::Vector3d& direction_C, FoundBy step);
  /// Returns the target towards a position above or below the view, but not to the side: the target at the nearest
  /// pixel of the image edge. Its corridor must be free only up to the distance of the position. Not in the paper.
  /// @param p_C  the position, m.
  std::optional<Target> below_or_above(const Eigen::Vector3d& p_C);
  /// Steps 2 and 3: the followed target, otherwise the best target near it.
  std::optional<Target> near(const std::optional<cv::Point>& followed);
  /// Step 4: the best target of the whole image. @param reference_C  direction relative to which a change has a cost.
  std::optional<Target> anywhere(const Eigen::Vector3d& reference_C);

  /// Candidates of step 4. [Andert2007] sec. 4.3.1.
  std::vector<cv::Point> far_blocks() const;
  /// The pixel of a direction, if it is in the image.
  std::optional<cv::Point> pixel_of(const Eigen::Vector3d& direction_C) const;
  /// Whether the corridor around the ray of a pixel is free.
  bool is_free(const cv::Point& pixel) const { return corridor(pixel, size_.target_m).has_value(); }
  /// Number of pixels and blocks tested so far.
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
  /// Returns the pixel in this image that corresponds to a pixel of the last image; empty if it is lost, has left the
  /// image, or if there was no last image. This image becomes the last image. @param grey  CV_8UC1.
  std::optional<cv::Point> follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey);

 private:
  cv::Mat last_;
};

}  // namespace hedgehop::avoidance::stereo_corridor
