#include "sim/render/tiles/sun_depths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/render/sun_plan.h"

namespace hedgehop::sim::tiles {

namespace {

size_t index(int row, int column, int across) {
  return static_cast<size_t>(row) * static_cast<size_t>(across) + static_cast<size_t>(column);
}

/// Columns or rows of a block, both ends included.
struct TexelInterval {
  int first, last;

  TexelInterval(int block, int log2, int stride)
      : first(block << log2), last(std::min(((block + 1) << log2), stride) - 1) {}
};

SunBlock block_of(const float* depths, int stride, const TexelInterval& rows, const TexelInterval& columns) {
  const int row = std::min((rows.first + rows.last) / 2, stride - 2);
  const int column = std::min((columns.first + columns.last) / 2, stride - 2);
  const float here = depths[index(row, column, stride)];
  SunBlock block{1.0f, -1e9f, depths[index(row, column + 1, stride)] - here,
                 depths[index(row + 1, column, stride)] - here};
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const float depth = depths[index(y, x, stride)];
      block.min_depth = std::min(block.min_depth, depth);
      block.max_offset = std::max(
          block.max_offset, depth - block.right * static_cast<float>(x - 1) - block.down * static_cast<float>(y - 1));
    }
  }
  return block;
}

/// Extends the bounds of a block by those of one of its quarters.
void widen(SunBlock& block, const SunBlock& part, const TexelInterval& rows, const TexelInterval& columns) {
  block.min_depth = std::min(block.min_depth, part.min_depth);
  for (const int y : {rows.first, rows.last}) {
    for (const int x : {columns.first, columns.last}) {
      block.max_offset =
          std::max(block.max_offset, part.max_offset + (part.right - block.right) * static_cast<float>(x - 1) +
                                         (part.down - block.down) * static_cast<float>(y - 1));
    }
  }
}

}  // namespace

SunBlocks make_sun_blocks(const float* depths, int stride, std::vector<SunBlock> (&blocks)[SunBlocks::kLevels]) {
  SunBlocks result{};
  for (int level = 0, log2 = SunBlocks::kFirstLog2; level < SunBlocks::kLevels; ++level, ++log2) {
    const int across = (stride + (1 << log2) - 1) >> log2;
    blocks[level].clear();
    for (int row = 0; row < across; ++row) {
      for (int column = 0; column < across; ++column) {
        if (level == 0) {
          blocks[0].push_back(block_of(depths, stride, {row, log2, stride}, {column, log2, stride}));
          continue;
        }
        const int parts = result.across[level - 1];
        SunBlock block = blocks[level - 1][index(2 * row, 2 * column, parts)];
        for (int y = 2 * row; y < std::min(2 * row + 2, parts); ++y) {
          for (int x = 2 * column; x < std::min(2 * column + 2, parts); ++x) {
            widen(block, blocks[level - 1][index(y, x, parts)], {y, log2 - 1, stride}, {x, log2 - 1, stride});
          }
        }
        blocks[level].push_back(block);
      }
    }
    result.levels[level] = blocks[level].data();
    result.across[level] = across;
  }
  return result;
}

namespace {

/// Depths of the texels that a triangle covers. The light is parallel, so that the depth is affine in the texel.
class SunTriangle {
 public:
  /// @param p  column, row and depth of each corner, from the center of the first texel.
  explicit SunTriangle(const std::array<Eigen::Vector3d, 3>& p) : p_(p) {
    const Eigen::Vector3d a = p[1] - p[0], b = p[2] - p[0];
    area_ = a.x() * b.y() - a.y() * b.x();
    right_ = (a.z() * b.y() - a.y() * b.z()) / area_;
    down_ = (a.x() * b.z() - a.z() * b.x()) / area_;
  }

  /// Returns whether the triangle faces the sun: it is then clockwise, because rows run down as in images.
  bool faces_sun() const { return area_ < 0.0; }

  template <class Put>
  void each_texel(int texels, const Put& put) const {
    const auto bound = [&](int axis, auto pick) { return pick({p_[0][axis], p_[1][axis], p_[2][axis]}); };
    const auto low = [](std::initializer_list<double> a) { return std::min(a); };
    const auto high = [](std::initializer_list<double> a) { return std::max(a); };
    const auto within = [&](double a) { return static_cast<int>(std::clamp(a, 0.0, texels - 1.0)); };
    const double offset = kSunSlack * std::max(std::abs(right_), std::abs(down_));
    for (int row = within(std::ceil(bound(1, low))); row <= within(std::floor(bound(1, high))); ++row) {
      for (int column = within(std::ceil(bound(0, low))); column <= within(std::floor(bound(0, high))); ++column) {
        if (!covers(column, row)) continue;
        put(column, row, p_[0].z() + right_ * (column - p_[0].x()) + down_ * (row - p_[0].y()) - offset);
      }
    }
  }

 private:
  bool covers(double column, double row) const {
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d &from = p_[i], &to = p_[(i + 1) % 3];
      if ((to.x() - from.x()) * (row - from.y()) - (to.y() - from.y()) * (column - from.x()) > 0.0) return false;
    }
    return true;
  }

  std::array<Eigen::Vector3d, 3> p_;
  double area_, right_, down_;
};

}  // namespace

SunDepths draw_sun_depths(const SceneGeometry& geometry, const scenes::Lights& lights, HugeVector<float>& depths) {
  const SunPlan plan = plan_sun_map(geometry.chunks, lights.to_sun_W);
  const auto stride = static_cast<size_t>(plan.texels) + 2;
  depths.assign(stride * stride, 0.0f);

  SunDepths sun{depths.data(), plan.texels, {}, lights.ambient, {}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) {
      sun.from_W[i][k] = plan.from_W.matrix()(i, k) * (i < 2 ? plan.texels : 1) - (i < 2 && k == 3 ? 0.5 : 0.0);
    }
  }
  const auto in_map = [&](uint32_t index) -> Eigen::Vector3d {
    const std::array<float, 3>& p_W = geometry.vertices[geometry.indices[index]].p_W;
    const Eigen::Vector4d p(p_W[0], p_W[1], p_W[2], 1.0);
    return Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(&sun.from_W[0][0]) * p;
  };
  for (const scenes::Chunk& chunk : plan.casters) {
    for (uint32_t i = chunk.first_index; i < chunk.first_index + chunk.index_count; i += 3) {
      const SunTriangle triangle({in_map(i), in_map(i + 1), in_map(i + 2)});
      if (!triangle.faces_sun()) continue;
      triangle.each_texel(plan.texels, [&](int column, int row, double depth) {
        float& stored = depths[(static_cast<size_t>(row) + 1) * stride + static_cast<size_t>(column) + 1];
        stored = std::max(stored, static_cast<float>(depth));
      });
    }
  }
  return sun;
}

}  // namespace hedgehop::sim::tiles
