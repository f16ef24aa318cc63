#include "avoidance/stereo_corridor/corridor_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "vision/opencv_library.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

constexpr vision::stereo::TargetCost kCost;        // [Andert2007] sec. 4.3.1: c_z = 0, c_x and c_y equal
constexpr vision::stereo::NearbyLattice kLattice;  // [Andert2007] fig. 11

}  // namespace

const char* name_of(FoundBy step) {
  switch (step) {
    case FoundBy::goal:
      return "cruise";
    case FoundBy::approach:
      return "approach";
    case FoundBy::keep:
      return "keep";
    case FoundBy::track:
      return "track";
    case FoundBy::near:
      return "near";
    case FoundBy::search:
      return "search";
  }
  throw std::logic_error("unknown step");
}

CorridorSearch::CorridorSearch(const vision::stereo::DepthPyramid& pyramid,
                               const vision::stereo::StereoGeometry& geometry, const CorridorSize& size,
                               Allowed allowed)
    : pyramid_(pyramid), geometry_(geometry), size_(size), allowed_(std::move(allowed)) {}

std::optional<Target> CorridorSearch::join(const Eigen::Vector3d& flight_C, const std::optional<cv::Point>& followed) {
  if (const auto kept = along(flight_C, FoundBy::keep)) return kept;  // 1.
  if (const auto found = near(followed)) return found;                // 2. and 3.
  return anywhere(flight_C);                                          // 4.
}

std::optional<Target> CorridorSearch::along(const Eigen::Vector3d& direction_C, FoundBy step) {
  const std::optional<cv::Point> pixel = pixel_of(direction_C);
  return pixel ? at(*pixel, step) : std::nullopt;
}

std::optional<Target> CorridorSearch::below_or_above(const Eigen::Vector3d& p_C) {
  if (!(p_C.z() > 0.0)) return std::nullopt;
  const double last_row = pyramid_.image().height - 1;
  const double v = geometry_.center_v_px + geometry_.focal_px * p_C.y() / p_C.z();
  const double edge_C = (std::clamp(v, 0.0, last_row) - geometry_.center_v_px) / geometry_.focal_px;
  const std::optional<cv::Point> pixel = pixel_of({p_C.x(), edge_C * p_C.z(), p_C.z()});
  if (!pixel) return std::nullopt;
  const auto free = corridor(*pixel, std::min(size_.target_m, p_C.z()), &tests_);
  return free ? std::optional(Target{*pixel, std::min(free->z_m, p_C.z()), FoundBy::approach}) : std::nullopt;
}

std::optional<Target> CorridorSearch::near(const std::optional<cv::Point>& followed) {
  if (!followed) return std::nullopt;
  if (const auto tracked = at(*followed, FoundBy::track)) return tracked;
  const Eigen::Vector3d old_C = geometry_.ray_at_unit_depth(*followed);
  for (const auto& candidates :
       {vision::stereo::fine_targets(*followed, kLattice), vision::stereo::coarse_targets(*followed, kLattice)}) {
    if (const auto best = cheapest(candidates, old_C, FoundBy::near)) return best;
  }
  return std::nullopt;
}

std::optional<Target> CorridorSearch::anywhere(const Eigen::Vector3d& reference_C) {
  return cheapest(far_blocks(), reference_C, FoundBy::search);
}

std::vector<cv::Point> CorridorSearch::far_blocks() const {
  return vision::stereo::quadtree_targets(pyramid_, geometry_.disparity16(size_.target_m), kCoarsestLevel,
                                          kFinestLevel);
}

std::optional<cv::Point> CorridorSearch::pixel_of(const Eigen::Vector3d& direction_C) const {
  if (!(direction_C.z() > 0.0)) return std::nullopt;
  const Eigen::Vector2d on_plane = direction_C.head<2>() / direction_C.z();
  const double u = geometry_.center_u_px + geometry_.focal_px * on_plane.x();
  const double v = geometry_.center_v_px + geometry_.focal_px * on_plane.y();
  const cv::Size size = pyramid_.image();
  if (!(u > -0.5 && v > -0.5 && u < size.width - 0.5 && v < size.height - 0.5)) return std::nullopt;
  return cv::Point(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)));
}

/// The corridor around the ray of a pixel, if it is free. [Andert2007] sec. 4.2.
std::optional<vision::stereo::Corridor> CorridorSearch::corridor(const cv::Point& pixel, double target_m,
                                                                 int* tests) const {
  if (allowed_ && !allowed_(geometry_.ray_at_unit_depth(pixel))) return std::nullopt;
  const vision::stereo::Corridor found =
      vision::stereo::examine_corridor(pyramid_, geometry_, pixel, size_.radius_m, target_m);
  if (tests) *tests += found.tests;
  return found.state == vision::stereo::Corridor::State::free ? std::optional(found) : std::nullopt;
}

std::optional<Target> CorridorSearch::at(const cv::Point& pixel, FoundBy step) {
  const auto free = corridor(pixel, size_.target_m, &tests_);
  return free ? std::optional(Target{pixel, free->z_m, step}) : std::nullopt;
}

/// The free candidate of minimum cost, [Andert2007] eq. (12) to (14); the first of equal candidates.
std::optional<Target> CorridorSearch::cheapest(const std::vector<cv::Point>& candidates,
                                               const Eigen::Vector3d& reference_C, FoundBy step) {
  static_assert(kCost.depth_per_m == 0.0, "the cost is known before the corridor is examined");
  std::optional<Target> best;
  double least = std::numeric_limits<double>::infinity();
  for (const cv::Point& pixel : candidates) {
    if (!cv::Rect({}, pyramid_.image()).contains(pixel)) continue;
    const Eigen::Vector3d ray_C = geometry_.ray_at_unit_depth(pixel);
    if (vision::stereo::target_cost(kCost, ray_C, reference_C) >= least) continue;
    const auto target = at(pixel, step);
    if (!target) continue;
    const double z_m = std::min(target->z_m, kLookAheadM);
    const double cost = vision::stereo::target_cost(kCost, z_m * ray_C, reference_C);
    if (cost >= least) continue;
    least = cost;
    best = target;
  }
  return best;
}

std::optional<cv::Point> TargetTracker::follow(const std::optional<cv::Point>& pixel, const cv::Mat& grey) {
  std::optional<cv::Point> found;
  if (pixel && last_.size() == grey.size()) {
    const std::vector<cv::Point2f> before = {cv::Point2f(*pixel)};
    std::vector<cv::Point2f> after;
    std::vector<uint8_t> tracked;
    vision::opencv_library().track(last_, grey, before, after, tracked);
    const cv::Point place(after.front());
    if (tracked.front() && cv::Rect({}, grey.size()).contains(place)) found = place;
  }
  grey.copyTo(last_);
  return found;
}

}  // namespace hedgehop::avoidance::stereo_corridor
