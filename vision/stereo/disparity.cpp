#include "vision/stereo/disparity.h"

#include <array>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
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
  /// @return the root of what the two have become.
  int join(int a, int b) {
    a = root(a);
    b = root(b);
    if (a == b) return a;
    parents_[static_cast<size_t>(b)] = a;
    sizes_[static_cast<size_t>(a)] += sizes_[static_cast<size_t>(b)];
    return a;
  }
  int& size(int root) { return sizes_[static_cast<size_t>(root)]; }

 private:
  std::vector<int> parents_, sizes_;
};

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
  constexpr int kNone = -1;
  Segments segments;
  std::vector<int> labels(disparity16.total(), kNone);
  const int width = disparity16.cols;
  // Those of the eight neighbors that come earlier, line by line.
  constexpr std::array<std::array<int, 2>, 4> kEarlier = {{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (int v = 0; v < disparity16.rows; ++v) {
    for (int u = 0; u < width; ++u) {
      const int d = disparity16.at<int16_t>(v, u);
      if (d < 0) continue;
      int segment = kNone;
      for (const auto& [du, dv] : kEarlier) {
        const int nu = u + du, nv = v + dv;
        if (nu < 0 || nu >= width || nv < 0) continue;
        const int neighbor = disparity16.at<int16_t>(nv, nu);
        if (neighbor < 0 || std::abs(d - neighbor) >= difference16) continue;
        const int theirs = labels[static_cast<size_t>(nv * width + nu)];
        segment = segment == kNone ? segments.root(theirs) : segments.join(segment, theirs);
      }
      if (segment == kNone) segment = segments.add();
      ++segments.size(segment);
      labels[static_cast<size_t>(v * width + u)] = segment;
    }
  }
  int removed = 0;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNone || segments.size(segments.root(labels[i])) >= smallest_px) continue;
    disparity16.at<int16_t>(static_cast<int>(i) / width, static_cast<int>(i) % width) = kNoDisparity;
    ++removed;
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
