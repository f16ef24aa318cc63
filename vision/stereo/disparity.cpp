#include "vision/stereo/disparity.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::stereo {
namespace {

void need_disparity(const cv::Mat& disparity16) {
  if (disparity16.type() != CV_16SC1) throw std::invalid_argument("a disparity image must be CV_16SC1");
}

/// A run of connected pixels in one row. Connected runs form a segment: a tree whose root stores the size.
struct PixelRun {
  int row, begin, end;  ///< columns [begin, end)
  int parent, size;
};

class Segments {
 public:
  /// Adds the runs of the next row and joins them with connected runs of the previous row.
  void add_row(const cv::Mat& disparity16, int row, int difference16) {
    const auto above = static_cast<int>(row_begin_), here = static_cast<int>(runs_.size());
    row_begin_ = runs_.size();
    const auto* const d = disparity16.ptr<int16_t>(row);
    for (int u = 0; u < disparity16.cols; ++u) {
      if (d[u] < 0) continue;
      const int begin = u;
      while (u + 1 < disparity16.cols && d[u + 1] >= 0 && std::abs(d[u + 1] - d[u]) < difference16) ++u;
      runs_.push_back({row, begin, u + 1, static_cast<int>(runs_.size()), u + 1 - begin});
    }
    int first = above;
    for (int i = here; i < static_cast<int>(runs_.size()); ++i) {
      while (first < here && run(first).end < run(i).begin) ++first;
      for (int other = first; other < here && run(other).begin <= run(i).end; ++other) {
        if (touch(run(i), run(other), disparity16, difference16)) join(i, other);
      }
    }
  }

  const std::vector<PixelRun>& runs() const { return runs_; }
  int size_of(const PixelRun& of) { return run(root(of.parent)).size; }

 private:
  PixelRun& run(int i) { return runs_[static_cast<size_t>(i)]; }

  /// Returns whether two runs have connected pixels, including diagonal neighbors.
  static bool touch(const PixelRun& lower, const PixelRun& upper, const cv::Mat& disparity16, int difference16) {
    const auto* const d = disparity16.ptr<int16_t>(lower.row);
    const auto* const above = disparity16.ptr<int16_t>(upper.row);
    for (int u = std::max(lower.begin, upper.begin - 1); u < std::min(lower.end, upper.end + 1); ++u) {
      for (int n = std::max(u - 1, upper.begin); n < std::min(u + 2, upper.end); ++n) {
        if (std::abs(d[u] - above[n]) < difference16) return true;
      }
    }
    return false;
  }

  int root(int i) {
    while (run(i).parent != i) i = run(i).parent = run(run(i).parent).parent;
    return i;
  }
  void join(int a, int b) {
    const int into = root(a), from = root(b);
    if (into == from) return;
    run(from).parent = into;
    run(into).size += run(from).size;
  }

  std::vector<PixelRun> runs_;
  size_t row_begin_ = 0;  ///< index in `runs_` of the last row's first run
};

/// Marks sky in a row. @param grey, disparity16  start at the second pixel. @return number of sky pixels.
HEDGEHOP_WIDE int mark_sky_in_row(const uint8_t* grey, int count, int texture, int brightness, bool among_all,
                                  int16_t* disparity16) {
  int found = 0;
  for (int u = 0; u < count; ++u) {
    const auto difference = static_cast<int16_t>(std::abs(int{grey[u]} - int{grey[u - 1]}));
    const bool sky = (among_all | (disparity16[u] < 0)) & (difference < texture) & (grey[u] > brightness);
    disparity16[u] = sky ? int16_t{0} : disparity16[u];
    found += sky;
  }
  return found;
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
      const float depth = scale / static_cast<float>(from[u]);  // also for negative values, to avoid branches
      to[u] = from[u] < 0 ? std::numeric_limits<float>::quiet_NaN() : depth;
    }
  }
}

int remove_specks(cv::Mat& disparity16, int difference16, int smallest_px) {
  need_disparity(disparity16);
  Segments segments;
  for (int v = 0; v < disparity16.rows; ++v) segments.add_row(disparity16, v, difference16);
  int removed = 0;
  for (const PixelRun& run : segments.runs()) {
    if (segments.size_of(run) >= smallest_px) continue;
    std::fill(disparity16.ptr<int16_t>(run.row) + run.begin, disparity16.ptr<int16_t>(run.row) + run.end, kNoDisparity);
    removed += run.end - run.begin;
  }
  return removed;
}

void find_smeared(const cv::Mat& disparity16, int half_window_px, cv::Mat& smeared) {
  smeared = disparity16 < 0;
  if (half_window_px <= 0) return;
  // Areas that contain a complete window of unmatched pixels, enlarged by half a window.
  const auto square = [](int px) { return cv::Mat::ones(px, px, CV_8U); };
  cv::erode(smeared, smeared, square(2 * half_window_px + 1));
  cv::dilate(smeared, smeared, square(4 * half_window_px + 1));
}

int mark_sky(const cv::Mat& grey, int texture, int brightness, SkyAmong among, cv::Mat& disparity16) {
  need_disparity(disparity16);
  if (grey.type() != CV_8UC1 || grey.size() != disparity16.size()) {
    throw std::invalid_argument("the grey image must be CV_8UC1 and of the disparity image's size");
  }
  int found = 0;
  for (int v = 0; v < grey.rows; ++v) {
    found += mark_sky_in_row(grey.ptr<uint8_t>(v) + 1, grey.cols - 1, texture, brightness, among == SkyAmong::all,
                             disparity16.ptr<int16_t>(v) + 1);
  }
  return found;
}

}  // namespace hedgehop::vision::stereo
