#include "vision/flow/flow_level.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "vision/flow/wide_integers.h"

namespace hedgehop::vision::flow {
namespace {

// Remaining share of a pixel's noise (standard deviation) after 1 3 3 1 halving and 1 2 1 smoothing in both directions.
constexpr double kHalvingGain = 20.0 / 64.0, kSmoothingGain = 6.0 / 16.0;
// Number of pixels over which smoothed noise is correlated: the inverse of the sum of the squared weights.
constexpr double kNoiseArea = 1.0 / (kSmoothingGain * kSmoothingGain);
// Minimum ratio of texture to noise (mean squares) in the direction of the weakest texture.
constexpr double kMinContrast = 3.0;
// In reduced pixels. Copies shifted by one pixel cannot measure larger steps.
constexpr double kMaxStep = 2.0, kMaxLastStep = 1.0;

double noise_energy(const ImageInterpolationConfig& config, int reduction, int bits) {
  double noise = config.noise_grey * std::exp2(bits - 8) * kSmoothingGain;
  for (int i = 1; i < reduction; i *= 2) noise *= kHalvingGain;
  return 2.0 * noise * noise;
}

HEDGEHOP_WIDE void subtract(const int16_t* from, const int16_t* subtrahend, int count, int16_t* difference) {
  for (int i = 0; i < count; ++i) difference[i] = static_cast<int16_t>(from[i] - subtrahend[i]);
}

std::vector<double> centers(const std::vector<PatchRange>& ranges) {
  std::vector<double> at;
  for (const PatchRange& range : ranges) at.push_back(range.center());
  return at;
}

// Smooths with 1 2 1 along one axis, weighted by confidence; `step` is the index distance of nodes along the axis.
void smooth_axis(const NodeFlow& in, NodeFlow& out, int count, size_t step, int lines, size_t line_step) {
  constexpr double kOwn = 2.0;
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < count; ++i) {
      const size_t at = static_cast<size_t>(line) * line_step + static_cast<size_t>(i) * step;
      double u = 0.0, v = 0.0, c = 0.0;
      const auto take = [&](size_t from, double weight) {
        const double w = weight * in.confidence[from];
        u += w * in.u_px[from];
        v += w * in.v_px[from];
        c += w;
      };
      take(at, kOwn);
      if (i > 0) take(at - step, 1.0);
      if (i + 1 < count) take(at + step, 1.0);
      out.u_px[at] = c > 0.0 ? u / c : 0.0;
      out.v_px[at] = c > 0.0 ? v / c : 0.0;
      out.confidence[at] = c / (kOwn + 2.0);
    }
  }
}

}  // namespace

NodeFlow::NodeFlow(int row_count, int col_count) : rows(row_count), cols(col_count) {
  for (auto* values : {&u_px, &v_px, &confidence}) values->assign(static_cast<size_t>(rows * cols), 0.0);
}

void NodeFlow::set_zero() {
  for (auto* values : {&u_px, &v_px, &confidence}) std::fill(values->begin(), values->end(), 0.0);
}

void smooth_by_confidence(NodeFlow& flow, NodeFlow& spare) {
  const auto row_step = static_cast<size_t>(flow.cols);
  smooth_axis(flow, spare, flow.cols, 1, flow.rows, row_step);
  smooth_axis(spare, flow, flow.rows, row_step, flow.cols, 1);
}

namespace {

// Rows: patches; columns: weights of the nodes' hat functions, averaged over the patch.
Eigen::MatrixXd mean_weights(const std::vector<PatchRange>& ranges) {
  const auto count = static_cast<Eigen::Index>(ranges.size());
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(count, count);
  const std::vector<double> nodes = centers(ranges);
  for (Eigen::Index patch = 0; patch < count; ++patch) {
    const PatchRange& range = ranges[static_cast<size_t>(patch)];
    const double share = 1.0 / (range.end - range.begin);
    for (int x = range.begin; x < range.end; ++x) {
      const auto after = std::upper_bound(nodes.begin(), nodes.end(), static_cast<double>(x)) - nodes.begin();
      if (after == 0 || after == count) {
        weights(patch, after == 0 ? 0 : count - 1) += share;
        continue;
      }
      const double left = nodes[static_cast<size_t>(after) - 1], right = nodes[static_cast<size_t>(after)];
      weights(patch, after - 1) += share * (right - x) / (right - left);
      weights(patch, after) += share * (x - left) / (right - left);
    }
  }
  return weights;
}

}  // namespace

PatchMeans::PatchMeans(const PatchGrid& grid)
    : over_rows_(mean_weights(grid.rows)),
      over_cols_(mean_weights(grid.cols)),
      spare_(over_rows_.rows(), over_cols_.rows()) {}

void PatchMeans::apply(std::vector<double>& values) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor> nodes(values.data(), over_rows_.rows(), over_cols_.rows());
  spare_.noalias() = over_rows_ * nodes;
  nodes.noalias() = spare_ * over_cols_.transpose();
}

FlowLevel::FlowLevel(const ImageInterpolationConfig& config, const PatchGrid& grid, int reduction, int band_begin_px,
                     int width_px, int height_px, int bits)
    : config_(config),
      reduction_(reduction),
      noise_energy_(noise_energy(config, reduction, bits)),
      grid_(reduce_patch_grid(grid, reduction, band_begin_px, width_px / reduction, height_px / reduction)),
      older_(width_px / reduction, height_px / reduction,
             static_cast<int>(std::ceil(config.max_flow_px / reduction)) + 1),
      newer_(older_),
      copy_x_(static_cast<size_t>(padded(older_.width())), int16_t{0}),
      copy_y_(copy_x_),
      difference_(copy_x_),
      spread_(centers(grid_.cols), centers(grid_.rows), older_.width()),
      means_(grid_),
      sums_(grid_.rows, grid_.cols, padded(older_.width()), older_.height(), 3),
      patches_(grid_.rows.size() * grid_.cols.size()),
      spare_(config.rows, config.cols),
      level_u_(patches_.size()),
      level_v_(patches_.size()) {
  const PatchRange &row = grid_.rows.front(), &col = grid_.cols.front();
  pixels_ = static_cast<double>(row.end - row.begin) * (col.end - col.begin);
}

void FlowLevel::difference_copies(int y) {
  if (y == 0 || y == older_.height() - 1) {
    for (auto* copy : {&copy_x_, &copy_y_}) std::fill(copy->begin(), copy->end(), int16_t{0});
    return;
  }
  const auto [begin, end] = sums_.columns();
  const int16_t* row = older_.row(y) + begin;
  subtract(row + 1, row - 1, end - begin, copy_x_.data() + begin);
  subtract(older_.row(y + 1) + begin, older_.row(y - 1) + begin, end - begin, copy_y_.data() + begin);
  for (auto* copy : {&copy_x_, &copy_y_}) {
    copy->front() = 0;
    std::fill(copy->begin() + older_.width() - 1, copy->end(), int16_t{0});
  }
}

void FlowLevel::begin() {
  sums_.begin();
  for (int y = sums_.first_row(); y < sums_.end_row(); ++y) {
    difference_copies(y);
    sums_.add(0, copy_x_.data(), copy_x_.data());
    sums_.add(1, copy_x_.data(), copy_y_.data());
    sums_.add(2, copy_y_.data(), copy_y_.data());
    sums_.next_row();
  }
  for (int row = 0; row < config_.rows; ++row) {
    for (int col = 0; col < config_.cols; ++col) {
      PatchFit& patch = patches_[static_cast<size_t>(row * config_.cols + col)];
      patch.a_xx = static_cast<double>(sums_.sum(0, row, col));
      patch.a_xy = static_cast<double>(sums_.sum(1, row, col));
      patch.a_yy = static_cast<double>(sums_.sum(2, row, col));
      const double mean = 0.5 * (patch.a_xx + patch.a_yy);
      patch.min_eigenvalue = mean - std::hypot(0.5 * (patch.a_xx - patch.a_yy), patch.a_xy);
    }
  }
}

void FlowLevel::iterate(NodeFlow& flow) {
  // Re-center: shift the newer image back by the current flow.
  smooth_by_confidence(flow, spare_);
  for (size_t i = 0; i < flow.size(); ++i) {
    level_u_[i] = flow.u_px[i] / reduction_;
    level_v_[i] = flow.v_px[i] / reduction_;
  }
  spread_.set(level_u_, level_v_);
  sums_.begin();
  for (int y = sums_.first_row(); y < sums_.end_row(); ++y) {
    spread_.go_to(y);
    recentered_difference(older_, newer_, y, spread_.u_q16(), spread_.v_q16(), difference_.data(), sums_.columns());
    difference_copies(y);
    sums_.add(0, copy_x_.data(), difference_.data());
    sums_.add(1, copy_y_.data(), difference_.data());
    sums_.add(2, difference_.data(), difference_.data());
    sums_.next_row();
  }
  // Solve for the remaining flow of each patch and add it.
  means_.apply(flow.u_px);
  means_.apply(flow.v_px);
  for (int row = 0; row < config_.rows; ++row) {
    for (int col = 0; col < config_.cols; ++col) {
      const auto i = static_cast<size_t>(row * config_.cols + col);
      PatchFit& patch = patches_[i];
      patch.b_x = static_cast<double>(sums_.sum(0, row, col));
      patch.b_y = static_cast<double>(sums_.sum(1, row, col));
      patch.dd = static_cast<double>(sums_.sum(2, row, col));
      solve(patch);
      const double limit = config_.max_flow_px;
      flow.u_px[i] = std::clamp(flow.u_px[i] + patch.step_px.x(), -limit, limit);
      flow.v_px[i] = std::clamp(flow.v_px[i] + patch.step_px.y(), -limit, limit);
      const double noise = pixels_ * noise_energy_;
      flow.confidence[i] = std::max(patch.min_eigenvalue, 0.0) / (std::max(patch.min_eigenvalue, 0.0) + noise);
    }
  }
}

void FlowLevel::solve(PatchFit& patch) const {
  // The copies differ by two pixels, hence the factor 2. Noise on the diagonal limits the step of a patch with little
  // texture.
  const double noise = pixels_ * noise_energy_;
  const double a_xx = patch.a_xx + noise, a_yy = patch.a_yy + noise;
  const double determinant = a_xx * a_yy - patch.a_xy * patch.a_xy;
  const Eigen::Vector2d step{2.0 * (a_yy * patch.b_x - patch.a_xy * patch.b_y) / determinant,
                             2.0 * (a_xx * patch.b_y - patch.a_xy * patch.b_x) / determinant};
  patch.step_px = step * (reduction_ * std::min(1.0, kMaxStep / std::max(step.norm(), kMaxStep)));
}

bool FlowLevel::is_valid(const PatchFit& patch, const Eigen::Vector2d& flow_px) const {
  const double noise = pixels_ * noise_energy_;
  if (!(patch.min_eigenvalue > kMinContrast * noise)) return false;
  if (flow_px.norm() >= config_.max_flow_px) return false;
  if (patch.step_px.norm() > kMaxLastStep * reduction_) return false;
  // The residual of the fit, but at least the energy of the noise, determines the standard deviation.
  const Eigen::Vector2d step = patch.step_px / reduction_;
  const double rest = std::max(patch.dd - 0.5 * (step.x() * patch.b_x + step.y() * patch.b_y), 0.0);
  const double sigma_px =
      2.0 * reduction_ * std::sqrt(std::max(rest / pixels_, noise_energy_) * kNoiseArea / patch.min_eigenvalue);
  if (sigma_px > config_.max_sigma_px) return false;
  // Root mean square spread of motion within the patch that would explain the residual.
  const double misfit_px = 2.0 * reduction_ * std::sqrt(2.0 * rest / (patch.a_xx + patch.a_yy));
  return misfit_px <= config_.max_misfit_px;
}

void FlowLevel::finish(const NodeFlow& flow, FlowField& field) const {
  for (size_t i = 0; i < flow.size(); ++i) {
    FlowVector& vector = field.vectors[i];
    const Eigen::Vector2d found{flow.u_px[i], flow.v_px[i]};
    vector.valid = is_valid(patches_[i], found);
    vector.flow_px = vector.valid ? found : Eigen::Vector2d::Zero();
  }
}

}  // namespace hedgehop::vision::flow
