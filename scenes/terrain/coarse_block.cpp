#include "scenes/terrain/coarse_block.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace hedgehop::scenes::terrain {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kCoarseStep = 4;

Vector2d position(const GridPlace& place) { return {place.row, place.column}; }

const Vector3d& p_W(const SurfaceGrid& grid, const GridPlace& place) { return grid.p_W(place.row, place.column); }

/// Returns the point of the surface at a position between samples (row, column).
Vector3d surface_at(const SurfaceGrid& grid, const Vector2d& at) {
  const int row = std::clamp(static_cast<int>(std::floor(at.x())), 0, grid.rows - 2),
            column = std::clamp(static_cast<int>(std::floor(at.y())), 0, grid.columns - 2);
  const double south = at.x() - row, east = at.y() - column;
  const Vector3d &northeast = grid.p_W(row, column + 1), &southwest = grid.p_W(row + 1, column);
  if (south + east <= 1.0) {
    const Vector3d& northwest = grid.p_W(row, column);
    return northwest + south * (southwest - northwest) + east * (northeast - northwest);
  }
  const Vector3d& southeast = grid.p_W(row + 1, column + 1);
  return southeast + (1.0 - south) * (northeast - southeast) + (1.0 - east) * (southwest - southeast);
}

/// Lines of a coarse grid along one axis.
std::vector<int> coarse_lines(int first, int last) {
  std::vector<int> lines;
  for (int line = first; line < last; line += kCoarseStep) lines.push_back(line);
  lines.push_back(last);
  return lines;
}

/// The triangles of a coarse block.
class CoarseBuilder {
 public:
  explicit CoarseBuilder(const GridBlock& block)
      : block_(block),
        rows_(coarse_lines(block.first_row, block.last_row)),
        columns_(coarse_lines(block.first_column, block.last_column)) {}

  /// Returns no triangles if the block has no coarse sample inside.
  std::vector<GridTriangle> build() {
    if (rows_.size() < 3 || columns_.size() < 3) return {};
    for (size_t i = 1; i + 2 < rows_.size(); ++i) {
      for (size_t k = 1; k + 2 < columns_.size(); ++k) {
        const GridPlace northwest{rows_[i], columns_[k]}, northeast{rows_[i], columns_[k + 1]},
            southwest{rows_[i + 1], columns_[k]}, southeast{rows_[i + 1], columns_[k + 1]};
        add(northwest, southwest, northeast);
        add(northeast, southwest, southeast);
      }
    }
    const std::vector<int> inner_rows(rows_.begin() + 1, rows_.end() - 1),
        inner_columns(columns_.begin() + 1, columns_.end() - 1);
    for (const auto& [border, inner] :
         {std::pair(block_.first_row, inner_rows.front()), {block_.last_row, inner_rows.back()}})
      add_strip(block_.first_column, block_.last_column, inner_columns, [&](int column, bool on_border) {
        return GridPlace{on_border ? border : inner, column};
      });
    for (const auto& [border, inner] :
         {std::pair(block_.first_column, inner_columns.front()), {block_.last_column, inner_columns.back()}})
      add_strip(block_.first_row, block_.last_row, inner_rows, [&](int row, bool on_border) {
        return GridPlace{row, on_border ? border : inner};
      });
    return std::move(triangles_);
  }

 private:
  /// Connects all samples of a side of the border with the coarse ones next to it.
  template <class PlaceAt>
  void add_strip(int first, int last, const std::vector<int>& inner, const PlaceAt& place_at) {
    int outer = first;
    size_t i = 0;
    while (outer < last || i + 1 < inner.size()) {
      const GridPlace a = place_at(outer, true), b = place_at(inner[i], false);
      if (i + 1 == inner.size() || (outer < last && outer + 1 <= inner[i + 1])) {
        add(a, b, place_at(++outer, true));
      } else {
        add(a, b, place_at(inner[++i], false));
      }
    }
  }

  void add(const GridPlace& a, const GridPlace& b, const GridPlace& c) {
    const Vector2d ab = position(b) - position(a), ac = position(c) - position(a);
    const bool from_above = ab.x() * ac.y() - ab.y() * ac.x() > 0.0;
    triangles_.push_back(from_above ? GridTriangle{a, b, c} : GridTriangle{a, c, b});
  }

  GridBlock block_;
  std::vector<int> rows_, columns_;
  std::vector<GridTriangle> triangles_;
};

/// Returns the maximum distance of the surface from a triangle at equal positions in the grid. Both are linear between
/// the samples and the points at which an edge of the triangle crosses a line of the grid or a diagonal of a cell.
double deviation_m(const SurfaceGrid& grid, const GridTriangle& triangle) {
  const Vector2d a = position(triangle[0]), ab = position(triangle[1]) - a, ac = position(triangle[2]) - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  double largest_m = 0.0;
  const auto compare = [&](const Vector2d& at) {
    const Vector2d p = at - a;
    const double b = (p.x() * ac.y() - p.y() * ac.x()) / area, c = (ab.x() * p.y() - ab.y() * p.x()) / area;
    constexpr double kEdge = -1e-9;
    if (std::min({b, c, 1.0 - b - c}) < kEdge) return;
    const Vector3d in_triangle =
        (1.0 - b - c) * p_W(grid, triangle[0]) + b * p_W(grid, triangle[1]) + c * p_W(grid, triangle[2]);
    largest_m = std::max(largest_m, (surface_at(grid, at) - in_triangle).norm());
  };
  const auto [first_row, last_row] = std::minmax({triangle[0].row, triangle[1].row, triangle[2].row});
  const auto [first_column, last_column] = std::minmax({triangle[0].column, triangle[1].column, triangle[2].column});
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) compare(Vector2d(row, column));
  }
  for (size_t k = 0; k < 3; ++k) {
    const Vector2d from = position(triangle[k]), along = position(triangle[(k + 1) % 3]) - from;
    for (const Vector2d& across : {Vector2d(1, 0), Vector2d(0, 1), Vector2d(1, 1)}) {
      const double span = across.dot(along);
      for (double line = 1.0; line < std::abs(span); ++line) compare(from + along * line / std::abs(span));
    }
  }
  return largest_m;
}

}  // namespace

CoarseBlock coarse_block(const SurfaceGrid& grid, const GridBlock& block) {
  for (int row = block.first_row; row <= block.last_row; ++row) {
    for (int column = block.first_column; column <= block.last_column; ++column) {
      if (!grid.is_known(row, column)) return {};
    }
  }
  CoarseBlock coarse{CoarseBuilder(block).build(), 0.0};
  for (const GridTriangle& triangle : coarse.triangles)
    coarse.error_m = std::max(coarse.error_m, deviation_m(grid, triangle));
  return coarse;
}

}  // namespace hedgehop::scenes::terrain
