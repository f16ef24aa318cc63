#include "scenes/mesh/cut.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Polygon = std::vector<Vertex>;

Vertex between(const Vertex& a, const Vertex& b, float share) {
  Vertex result = a;
  result.p_W += share * (b.p_W - a.p_W);
  result.n_W = (a.n_W + share * (b.n_W - a.n_W)).normalized();
  if (!result.n_W.allFinite()) result.n_W = a.n_W;
  result.uv += share * (b.uv - a.uv);
  return result;
}

/// Returns the part of a convex polygon with sign * uv[axis] >= sign * bound.
Polygon part_beyond(const Polygon& polygon, int axis, float bound, float sign) {
  Polygon result;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float da = sign * (a.uv[axis] - bound), db = sign * (b.uv[axis] - bound);
    if (da >= 0.0f) result.push_back(a);
    if ((da > 0.0f && db < 0.0f) || (da < 0.0f && db > 0.0f)) {
      result.push_back(between(a, b, da / (da - db)));
      result.back().uv[axis] = bound;
    }
  }
  return result;
}

Polygon polygon_of(const Triangles& triangles, size_t face) {
  const auto& [a, b, c] = triangles.faces[face];
  return {triangles.vertices[a], triangles.vertices[b], triangles.vertices[c]};
}

void append(const Polygon& polygon, bool is_two_sided, Triangles& out) {
  if (polygon.size() < 3) return;
  const auto first = static_cast<uint32_t>(out.vertices.size());
  out.vertices.insert(out.vertices.end(), polygon.begin(), polygon.end());
  for (uint32_t i = 1; i + 1 < polygon.size(); ++i) {
    const Eigen::Vector3f across = (polygon[i].p_W - polygon[0].p_W).cross(polygon[i + 1].p_W - polygon[0].p_W);
    if (across.norm() <= 0.0f) continue;
    out.faces.push_back({first, first + i, first + i + 1});
    out.is_two_sided.push_back(is_two_sided);
  }
}

/// Opaque cells of an image that repeats.
class Cells {
 public:
  Cells(const cv::Mat& opacity, int count, float cutoff) : count_(count) {
    constexpr float kMaxLevel = 255.0f;
    cv::Mat mean;
    cv::resize(opacity, mean, {count, count}, 0.0, 0.0, cv::INTER_AREA);
    for (const uint8_t level : cv::Mat_<uint8_t>(mean)) {
      is_opaque_.push_back(static_cast<float>(level) / kMaxLevel >= cutoff);
    }
  }

  int count() const { return count_; }
  bool is_opaque(int column, int row) const {
    const auto wrapped = [&](int i) { return static_cast<size_t>((i % count_ + count_) % count_); };
    return is_opaque_[wrapped(row) * static_cast<size_t>(count_) + wrapped(column)];
  }

 private:
  int count_;
  std::vector<bool> is_opaque_;
};

/// A rectangle of cells: columns first .. last - 1 since a row.
struct Run {
  int first, last, since_row;
};

struct CellRange {
  int first_column, last_column, first_row, last_row;  ///< half open
};

/// Returns the cells that a triangle covers, with a minimum of one in each direction.
CellRange range_of(const Polygon& polygon, int count) {
  Eigen::AlignedBox2f box;
  for (const Vertex& vertex : polygon) box.extend(vertex.uv);
  const auto low = [&](float x) { return static_cast<int>(std::floor(x * static_cast<float>(count))); };
  const auto high = [&](float x) { return static_cast<int>(std::ceil(x * static_cast<float>(count))); };
  CellRange range{low(box.min().x()), high(box.max().x()), low(box.min().y()), high(box.max().y())};
  range.last_column = std::max(range.last_column, range.first_column + 1);
  range.last_row = std::max(range.last_row, range.first_row + 1);
  return range;
}

/// Returns the opaque runs of a row.
std::vector<Run> runs_of(const Cells& cells, const CellRange& range, int row) {
  std::vector<Run> runs;
  for (int column = range.first_column; column < range.last_column; ++column) {
    if (!cells.is_opaque(column, row)) continue;
    if (!runs.empty() && runs.back().last == column) {
      ++runs.back().last;
    } else {
      runs.push_back({column, column + 1, row});
    }
  }
  return runs;
}

/// Cuts a triangle into its opaque rectangles.
void cut_triangle(const Polygon& polygon, bool is_two_sided, const Cells& cells, Triangles& out) {
  const CellRange range = range_of(polygon, cells.count());
  const auto emit = [&](const Run& run, int end_row) {
    const auto at = [&](int i) { return static_cast<float>(i) / static_cast<float>(cells.count()); };
    Polygon part = polygon;
    if (run.first > range.first_column) part = part_beyond(part, 0, at(run.first), 1.0f);
    if (run.last < range.last_column) part = part_beyond(part, 0, at(run.last), -1.0f);
    if (run.since_row > range.first_row) part = part_beyond(part, 1, at(run.since_row), 1.0f);
    if (end_row < range.last_row) part = part_beyond(part, 1, at(end_row), -1.0f);
    append(part, is_two_sided, out);
  };
  std::vector<Run> open;
  for (int row = range.first_row; row < range.last_row; ++row) {
    std::vector<Run> now = runs_of(cells, range, row);
    for (const Run& run : open) {
      const auto same =
          std::ranges::find_if(now, [&](const Run& r) { return r.first == run.first && r.last == run.last; });
      if (same == now.end()) {
        emit(run, row);
      } else {
        same->since_row = run.since_row;
      }
    }
    open = std::move(now);
  }
  for (const Run& run : open) emit(run, range.last_row);
}

constexpr double kMaxCells = 4e6;  // that all triangles cover
constexpr size_t kMaxCutFaces = 500'000;

/// Returns the triangles cut at this resolution; no value if there are too many.
std::optional<Triangles> cut_at(const Triangles& triangles, const Cells& cells) {
  double covered = 0.0;
  for (size_t f = 0; f < triangles.faces.size(); ++f) {
    Eigen::AlignedBox2d box;
    for (const Vertex& vertex : polygon_of(triangles, f)) box.extend(vertex.uv.cast<double>());
    covered += (box.sizes() * static_cast<double>(cells.count()) + Eigen::Vector2d::Ones()).prod();
  }
  if (!(covered < kMaxCells)) return std::nullopt;
  Triangles result;
  for (size_t f = 0; f < triangles.faces.size(); ++f) {
    cut_triangle(polygon_of(triangles, f), triangles.is_two_sided[f], cells, result);
    if (result.faces.size() > kMaxCutFaces) return std::nullopt;
  }
  return result;
}

}  // namespace

Triangles clamped(const Triangles& triangles, int axis, int size_px) {
  const float half_px = 0.5f / static_cast<float>(size_px);  // a linear filter would blend in the opposite edge
  Triangles result;
  for (size_t f = 0; f < triangles.faces.size(); ++f) {
    const Polygon whole = polygon_of(triangles, f);
    const auto [lowest, highest] = std::ranges::minmax(whole, {}, [&](const Vertex& v) { return v.uv[axis]; });
    Polygon before, inside, after;
    if (lowest.uv[axis] < 0.0f) before = part_beyond(whole, axis, 0.0f, -1.0f);
    if (highest.uv[axis] > 1.0f) after = part_beyond(whole, axis, 1.0f, 1.0f);
    if (highest.uv[axis] >= 0.0f && lowest.uv[axis] <= 1.0f) {
      inside = part_beyond(part_beyond(whole, axis, 0.0f, 1.0f), axis, 1.0f, -1.0f);
    }
    for (Polygon* const part : {&before, &inside, &after}) {
      for (Vertex& vertex : *part) {
        const float inside_at = std::clamp(vertex.uv[axis], 0.0f, 1.0f);
        vertex.uv[axis] = half_px + inside_at * (1.0f - 2.0f * half_px);
      }
      append(*part, triangles.is_two_sided[f], result);
    }
  }
  return result;
}

Triangles without_holes(const Triangles& triangles, const cv::Mat& opacity, float cutoff) {
  constexpr int kMaxCellsAcross = 64;
  for (int count = std::min(kMaxCellsAcross, opacity.cols); count >= 1; count /= 2) {
    if (std::optional<Triangles> cut = cut_at(triangles, Cells(opacity, count, cutoff))) return *std::move(cut);
  }
  return triangles;
}

}  // namespace hedgehop::scenes::mesh
