#include "vision/stereo/disparity.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace hedgehop::vision::stereo {
namespace {

void need_disparity(const cv::Mat& disparity16) {
  if (disparity16.type() != CV_16SC1) throw std::invalid_argument("a disparity image must be CV_16SC1");
}

/// Union-find over segments that grow line by line.
class Segments {
 public:
  int add() {
    parents_.push_back(static_cast<int>(parents_.size()));
    sizes_.push_back(0);
    return parents_.back();
  }
  int root(int segment) {
    auto parent = [&](int i) -> int& { return parents_[static_cast<size_t>(i)]; };
    while (parent(segment) != segment) {
      parent(segment) = parent(parent(segment));
      segment = parent(segment);
    }
    return segment;
  }
  void join(int a, int b) { parents_[static_cast<size_t>(root(b))] = root(a); }
  int& size(int root) { return sizes_[static_cast<size_t>(root)]; }

 private:
  std::vector<int> parents_, sizes_;
};

constexpr int kNone = -1;

/// Neighbors in one row that belong together.
struct Run {
  int row, begin, length, segment;
};

/// Joins the runs of a row with those that they touch in the row above, straight or across a corner.
void join_rows(const cv::Mat& disparity16, int row, int difference16, const std::vector<int>& here,
               const std::vector<int>& above, Segments& segments) {
  const auto* const d = disparity16.ptr<int16_t>(row);
  const auto* const upper = disparity16.ptr<int16_t>(row - 1);
  const int width = disparity16.cols;
  int last_here = kNone, last_above = kNone;  // joined last: most neighbors are those again
  for (int u = 0; u < width; ++u) {
    const int mine = here[static_cast<size_t>(u)];
    if (mine == kNone) continue;
    for (int n = std::max(0, u - 1); n <= std::min(width - 1, u + 1); ++n) {
      const int theirs = above[static_cast<size_t>(n)];
      if (theirs == kNone || (mine == last_here && theirs == last_above)) continue;
      if (std::abs(d[u] - upper[n]) >= difference16) continue;
      segments.join(mine, theirs);
      last_here = mine;
      last_above = theirs;
    }
  }
}

}  // namespace

void to_depth(const cv::Mat& disparity16, const StereoGeometry& geometry, cv::Mat& depth_m) {
  need_disparity(disparity16);
  depth_m.create(disparity16.size(), CV_32FC1);
  const float scale = static_cast<float>(kDisparityUnits * geometry.baseline_m * geometry.focal_px);
  for (int v = 0; v < disparity16.rows; ++v) {
    const auto* const from = disparity16.ptr<int16_t>(v);
    auto* const to = depth_m.ptr<float>(v);
    for (int u = 0; u < disparity16.cols; ++u) {
      to[u] = from[u] < 0 ? std::numeric_limits<float>::quiet_NaN() : scale / static_cast<float>(from[u]);
    }
  }
}

int remove_specks(cv::Mat& disparity16, int difference16, int smallest_px) {
  need_disparity(disparity16);
  // Neighbors in a row make a run; runs that touch those of the row above make a segment.
  Segments segments;
  std::vector<Run> runs;
  const int width = disparity16.cols;
  std::vector<int> above(static_cast<size_t>(width)), here(above);  // run of each pixel, kNone where unknown
  for (int v = 0; v < disparity16.rows; ++v) {
    const auto* const d = disparity16.ptr<int16_t>(v);
    for (int u = 0; u < width; ++u) {
      const auto i = static_cast<size_t>(u);
      here[i] = kNone;
      if (d[u] < 0) continue;
      const bool goes_on = u > 0 && d[u - 1] >= 0 && std::abs(d[u] - d[u - 1]) < difference16;
      if (!goes_on) runs.push_back({v, u, 0, segments.add()});
      ++runs.back().length;
      here[i] = runs.back().segment;
    }
    if (v > 0) join_rows(disparity16, v, difference16, here, above, segments);
    std::swap(above, here);
  }
  for (const Run& run : runs) segments.size(segments.root(run.segment)) += run.length;
  int removed = 0;
  for (const Run& run : runs) {
    if (segments.size(segments.root(run.segment)) >= smallest_px) continue;
    std::fill_n(disparity16.ptr<int16_t>(run.row) + run.begin, run.length, kNoDisparity);
    removed += run.length;
  }
  return removed;
}

int mark_sky(const cv::Mat& grey, int texture, int brightness, SkyAmong among, cv::Mat& disparity16) {
  need_disparity(disparity16);
  if (grey.type() != CV_8UC1 || grey.size() != disparity16.size()) {
    throw std::invalid_argument("the grey image must be CV_8UC1 and of the disparity image's size");
  }
  int found = 0;
  for (int v = 0; v < grey.rows; ++v) {
    const auto* const g = grey.ptr<uint8_t>(v);
    auto* const d = disparity16.ptr<int16_t>(v);
    for (int u = 1; u < grey.cols; ++u) {
      const bool tested = among == SkyAmong::all || d[u] < 0;
      const bool sky = tested && std::abs(int{g[u]} - int{g[u - 1]}) < texture && g[u] > brightness;
      if (!sky) continue;
      d[u] = 0;
      ++found;
    }
  }
  return found;
}

}  // namespace hedgehop::vision::stereo
