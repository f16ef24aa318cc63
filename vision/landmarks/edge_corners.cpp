#include "vision/landmarks/edge_corners.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

namespace hedgehop::vision::landmarks {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// An edge joined from segments: the line with the best fit to all of them, weighted by length.
class GrowingEdge {
 public:
  explicit GrowingEdge(const ImageEdge& segment) { add(segment); }

  void add(const ImageEdge& segment) {
    const double mass = segment.length_px();
    const Vector2d middle = 0.5 * (segment.from_px + segment.to_px), half = 0.5 * (segment.to_px - segment.from_px);
    mass_ += mass;
    first_ += mass * middle;
    second_ += mass * (middle * middle.transpose() + half * half.transpose() / 3.0);
    ends_.push_back(segment.from_px);
    ends_.push_back(segment.to_px);
    fit();
  }
  /// Returns whether a segment lies on the line and close to the edge.
  bool accepts(const ImageEdge& segment) const {
    if (along_.dot(segment.to_px - segment.from_px) <= 0.0) return false;  // opposite brighter side
    const Vector2d a = segment.from_px - middle_, b = segment.to_px - middle_;
    if (std::max(std::abs(cross(along_, a)), std::abs(cross(along_, b))) > kAsidePx) return false;
    const double at_a = along_.dot(a), at_b = along_.dot(b);
    return std::min(at_a, at_b) <= last_px_ + kGapPx && std::max(at_a, at_b) >= first_px_ - kGapPx;
  }
  ImageEdge edge() const { return {middle_ + first_px_ * along_, middle_ + last_px_ * along_}; }

 private:
  void fit() {
    middle_ = first_ / mass_;
    const Eigen::Matrix2d spread = second_ / mass_ - middle_ * middle_.transpose();
    along_ = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
    if (along_.dot(ends_[1] - ends_[0]) < 0.0) along_ = -along_;
    first_px_ = last_px_ = 0.0;
    for (const Vector2d& end : ends_) {
      const double at = along_.dot(end - middle_);
      first_px_ = std::min(first_px_, at);
      last_px_ = std::max(last_px_, at);
    }
  }

  double mass_ = 0.0, first_px_ = 0.0, last_px_ = 0.0;
  Vector2d first_ = Vector2d::Zero(), middle_ = Vector2d::Zero(), along_ = Vector2d::UnitX();
  Eigen::Matrix2d second_ = Eigen::Matrix2d::Zero();
  std::vector<Vector2d> ends_;
};

/// Returns the distance of a point on an edge's line beyond the nearer end, px; < 0 on the edge.
double beyond_px(const ImageEdge& edge, const Vector2d& at) {
  const Vector2d along = (edge.to_px - edge.from_px) / edge.length_px();
  return std::max(along.dot(edge.from_px - at), along.dot(at - edge.to_px));
}

/// Reliability of a corner of two edges.
enum class Meeting {
  near,  ///< both end there
  far,   ///< one ends there, the other earlier but with a well-known direction
};

/// Returns the common end point of two edges; std::nullopt if there is none.
std::optional<Vector2d> meeting_point(const ImageEdge& a, const ImageEdge& b, double min_angle_rad, Meeting required) {
  const Vector2d u = (a.to_px - a.from_px).normalized(), v = (b.to_px - b.from_px).normalized();
  const double sine = cross(u, v);
  if (std::abs(sine) < std::sin(min_angle_rad)) return std::nullopt;
  const Vector2d at = a.from_px + cross(b.from_px - a.from_px, v) / sine * u;
  const double beyond_a = beyond_px(a, at), beyond_b = beyond_px(b, at);
  const double min_px = std::min(beyond_a, beyond_b), max_px = std::max(beyond_a, beyond_b);
  constexpr double kOvershootPx = 4.0;  // blur extends an edge beyond its end
  // Within the range in which the lines are less than twice kAsidePx apart, a segment may have been joined to the wrong
  // edge. Of two edges at a small angle, one then extends beyond their corner, and the other starts after it.
  const double alike_px = 2.0 * kAsidePx / std::abs(sine);
  if (min_px < -std::max(kOvershootPx, alike_px)) return std::nullopt;
  const bool is_near = max_px <= std::max(kBeyondPx, alike_px);
  if (required == Meeting::near) return is_near ? std::optional(at) : std::nullopt;
  // A long edge may disappear before its corner in front of ground of equal brightness.
  const double far_px = std::min(kFarBeyondPx, kFarShare * (beyond_a > beyond_b ? a : b).length_px());
  return !is_near && min_px <= kOvershootPx && max_px <= far_px ? std::optional(at) : std::nullopt;
}

/// Returns the planes in which edges are detected: grey and, for color images, red minus green.
std::vector<cv::Mat> planes_of(const cv::Mat& image) {
  if (image.channels() == 1) return {image};
  cv::Mat grey, red, green, redness;
  cv::cvtColor(image, grey, cv::COLOR_RGB2GRAY);
  cv::extractChannel(image, red, 0);
  cv::extractChannel(image, green, 1);
  constexpr double kMiddle = 128.0;
  cv::addWeighted(red, 1.0, green, -1.0, kMiddle, redness);
  return {grey, redness};
}

}  // namespace

std::vector<ImageEdge> joined_edges(std::span<const ImageEdge> segments) {
  std::vector<ImageEdge> by_length(segments.begin(), segments.end());
  std::ranges::stable_sort(by_length, std::ranges::greater{}, &ImageEdge::length_px);
  std::vector<bool> taken(by_length.size(), false);
  std::vector<ImageEdge> edges;
  for (size_t first = 0; first < by_length.size(); ++first) {
    if (taken[first]) continue;
    GrowingEdge edge(by_length[first]);
    for (bool grew = true; grew;) {  // a longer edge may reach segments that it passed before
      grew = false;
      for (size_t i = first + 1; i < by_length.size(); ++i) {
        if (taken[i] || !edge.accepts(by_length[i])) continue;
        edge.add(by_length[i]);
        taken[i] = grew = true;
      }
    }
    edges.push_back(edge.edge());
  }
  return edges;
}

std::vector<Vector2d> corners_of(std::span<const ImageEdge> edges, double min_angle_rad) {
  constexpr double kSamePx = 5.0;
  struct CornerGroup {
    Vector2d sum = Vector2d::Zero();
    int count = 0;
    Vector2d mean() const { return sum / count; }
  };
  std::vector<CornerGroup> groups;
  // Reliable corners first; the others add corners but do not move existing ones.
  for (const Meeting required : {Meeting::near, Meeting::far}) {
    const size_t sure = groups.size();
    for (size_t i = 0; i < edges.size(); ++i) {
      for (size_t j = i + 1; j < edges.size(); ++j) {
        const auto at = meeting_point(edges[i], edges[j], min_angle_rad, required);
        if (!at) continue;
        const auto is_same = [&](const CornerGroup& g) { return (g.mean() - *at).norm() <= kSamePx; };
        auto group = std::ranges::find_if(groups, is_same);
        if (required == Meeting::far && group < groups.begin() + static_cast<std::ptrdiff_t>(sure)) continue;
        if (group == groups.end()) group = groups.insert(groups.end(), CornerGroup{});
        group->sum += *at;
        ++group->count;
      }
    }
  }
  std::vector<Vector2d> corners;
  for (const CornerGroup& group : groups) corners.push_back(group.mean());
  return corners;
}

std::vector<Vector2d> edge_corners(const cv::Mat& image, double min_angle_rad) {
  std::vector<ImageEdge> edges;
  for (const cv::Mat& plane : planes_of(image)) {
    const std::vector<ImageEdge> found = joined_edges(line_segments(plane));
    edges.insert(edges.end(), found.begin(), found.end());
  }
  std::erase_if(edges, [&](const ImageEdge& edge) { return edge.length_px() < kMinEdgePx; });
  return corners_of(edges, min_angle_rad);
}

}  // namespace hedgehop::vision::landmarks
