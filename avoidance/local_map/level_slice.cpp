#include "avoidance/local_map/level_slice.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {

void ClosedCells::close_cell(const Eigen::Vector3d& p_W, double until_s) {
  const Eigen::Vector3i at = (p_W / cell_m_).array().floor().cast<int>();
  const Cell cell = {at.x(), at.y(), at.z()};
  if (until_s_.size() >= kMaxCells && !until_s_.contains(cell)) return;
  double& kept_s = until_s_[cell];
  kept_s = std::max(kept_s, until_s);
}

void ClosedCells::close(const Eigen::Vector3d& p_W, double radius_m, double t_s) {
  const int reach = static_cast<int>(std::ceil(radius_m / cell_m_));
  for (int row = -reach; row <= reach; ++row) {
    for (int col = -reach; col <= reach; ++col) {
      const Eigen::Vector3d off_W(row * cell_m_, col * cell_m_, 0.0);
      if (off_W.norm() < radius_m) close_cell(p_W + off_W, t_s + kUnknownS);
    }
  }
}

void ClosedCells::update(double t_s) {
  std::erase_if(until_s_, [&](const auto& cell) { return cell.second < t_s; });
}

void LevelSlice::build(const vision::mapping::OccupancyMap& map, const HeightRange& band, const ClosedCells& closed) {
  side_ = map.size().x();
  cell_m_ = map.config().voxel_m;
  corner_W_ = cell_m_ * map.first().head<2>().cast<double>();
  cells_.assign(static_cast<size_t>(side_ * side_), State::free);
  const auto layer_of = [&](double z_m) { return static_cast<int>(std::floor(z_m / cell_m_)) - map.first().z(); };
  const int top = std::max(0, layer_of(band.top_m)), bottom = std::min(map.size().z() - 1, layer_of(band.bottom_m));
  for (int layer = top; layer <= bottom; ++layer) {
    for (int i = 0; i < side_; ++i) {
      map.read_row(layer, i, row_);
      State* const here = cells_.data() + static_cast<size_t>(i * side_);
      for (int j = 0; j < side_; ++j) {
        const State seen = row_[static_cast<size_t>(j)];
        // precedence: occupied, unknown, free
        if (seen == State::occupied || (seen == State::unknown && here[j] == State::free)) here[j] = seen;
      }
    }
  }
  close(closed, band);
  fill_specks(map, top, bottom);
  marked_.resize(cells_.size());
  std::ranges::transform(cells_, marked_.begin(), [](State s) { return static_cast<uint8_t>(s == State::occupied); });
  occupied_.build(marked_, side_, side_);
  std::ranges::transform(cells_, marked_.begin(), [](State s) { return static_cast<uint8_t>(s == State::unknown); });
  unknown_.build(marked_, side_, side_);
}

/// Marks a single unknown column between free ones as free, unless a surface was observed in it: it lies between the
/// blocks of the images. An unmatched obstacle casts a shadow, so one of its neighbors is unknown, too.
void LevelSlice::fill_specks(const vision::mapping::OccupancyMap& map, int top, int bottom) {
  const auto suspect = [&](int row, int col) {
    for (int layer = top; layer <= bottom; ++layer) {
      if (map.is_suspect(map.first() + vision::mapping::OccupancyMap::Index(row, col, layer))) return true;
    }
    return false;
  };
  before_ = cells_;
  for (int row = 1; row + 1 < side_; ++row) {
    for (int col = 1; col + 1 < side_; ++col) {
      State& state = cells_[static_cast<size_t>(row * side_ + col)];
      if (state != State::unknown) continue;
      int free = 0;
      for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = col - 1; c <= col + 1; ++c) free += before_[static_cast<size_t>(r * side_ + c)] == State::free;
      }
      constexpr int kNeighbors = 8;
      if (free == kNeighbors && !suspect(row, col)) state = State::free;
    }
  }
}

double LevelSlice::exactly_to_occupied_m(const Eigen::Vector2d& p_W, double within_m) const {
  const Eigen::Vector2i here = cell(p_W);
  if (!contains(here.x(), here.y())) return 0.0;
  const double about_m = to_occupied_m(p_W);
  if (about_m > within_m + cell_m_) return about_m;
  const Eigen::Vector2i first = cell(p_W - Eigen::Vector2d::Constant(within_m)).cwiseMax(0);
  const Eigen::Vector2i last = cell(p_W + Eigen::Vector2d::Constant(within_m)).cwiseMin(side_ - 1);
  double least_m = within_m + cell_m_;
  for (int row = first.x(); row <= last.x(); ++row) {
    for (int col = first.y(); col <= last.y(); ++col) {
      if (at(row, col) != State::occupied) continue;
      const Eigen::Array2d off_m = (p_W - center(row, col)).array().abs() - 0.5 * cell_m_;
      least_m = std::min(least_m, off_m.max(0.0).matrix().norm() + std::min(0.0, off_m.maxCoeff()));
    }
  }
  return least_m;
}

void LevelSlice::close(const ClosedCells& closed, const HeightRange& band) {
  closed.for_each([&](const Eigen::Vector3d& p_W) {
    if (p_W.z() < band.top_m || p_W.z() > band.bottom_m) return;
    const Eigen::Vector2i at = cell(p_W.head<2>());
    if (!contains(at.x(), at.y())) return;
    State& state = cells_[static_cast<size_t>(at.x() * side_ + at.y())];
    if (state == State::unknown) state = State::occupied;
  });
}

}  // namespace hedgehop::avoidance::local_map
