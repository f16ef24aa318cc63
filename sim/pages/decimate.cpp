#include "sim/pages/decimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {
namespace {

/// Adds the rows of the minimum, the maximum and the first gap of `values` in [begin, end).
void pick(const std::vector<double>& values, size_t begin, size_t end, std::vector<size_t>& picked) {
  size_t lowest = end, highest = end, gap = end;
  for (size_t i = begin; i < end; ++i) {
    if (!std::isfinite(values[i])) {
      if (gap == end) gap = i;
      continue;
    }
    if (lowest == end || values[i] < values[lowest]) lowest = i;
    if (highest == end || values[i] > values[highest]) highest = i;
  }
  for (const size_t i : {lowest, highest, gap}) {
    if (i != end) picked.push_back(i);
  }
}

}  // namespace

std::vector<size_t> decimate(std::span<const std::vector<double>> series, size_t max_points) {
  const size_t rows = series.empty() ? 0 : series.front().size();
  std::vector<size_t> picked;
  if (rows <= max_points) {
    picked.resize(rows);
    std::iota(picked.begin(), picked.end(), size_t{0});
    return picked;
  }
  const size_t per_stretch = 3 * series.size();
  const size_t stretches = std::max<size_t>(1, (max_points - 2) / per_stretch);
  picked = {0, rows - 1};
  for (size_t s = 0; s < stretches; ++s) {
    for (const std::vector<double>& values : series) {
      pick(values, s * rows / stretches, (s + 1) * rows / stretches, picked);
    }
  }
  std::ranges::sort(picked);
  const auto repeated = std::ranges::unique(picked);
  picked.erase(repeated.begin(), repeated.end());
  return picked;
}

std::vector<Eigen::Vector2d> simplified(const std::vector<Eigen::Vector2d>& line_NE_m, double tolerance_m,
                                        size_t max_points) {
  if (line_NE_m.size() <= 2) return line_NE_m;
  const Eigen::Vector2d& first = line_NE_m.front();
  std::vector<cv::Point2f> line, kept;
  for (const Eigen::Vector2d& p : line_NE_m) {
    line.emplace_back(static_cast<float>(p.x() - first.x()), static_cast<float>(p.y() - first.y()));
  }
  do {
    cv::approxPolyDP(line, kept, tolerance_m, false);
    tolerance_m *= 2.0;
  } while (kept.size() > max_points);
  std::vector<Eigen::Vector2d> result;
  for (const cv::Point2f& p : kept) result.emplace_back(first + Eigen::Vector2d(p.x, p.y));
  return result;
}

}  // namespace hedgehop::sim
