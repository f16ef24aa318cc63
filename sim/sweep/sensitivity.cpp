#include "sim/sweep/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double variance_of(std::span<const double> values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum / static_cast<double>(values.size());
}

/// A figure is constant if its deviations are rounding errors.
bool is_constant(std::span<const double> values) {
  const auto [low, high] = std::ranges::minmax(values);
  return high - low <= 1e-12 * std::max(std::abs(low), std::abs(high));
}

/// First-order and total index of a parameter.
struct Pair {
  double first = 0.0, total = 0.0;
};

/// Estimates from some blocks. @param y  figures without their mean.
Pair estimate(std::span<const double> y, const std::vector<size_t>& blocks, size_t size, size_t parameter) {
  double first = 0.0, total = 0.0, sum = 0.0, squares = 0.0;
  for (const size_t block : blocks) {
    const double a = y[block * size], b = y[block * size + 1], ab = y[block * size + 2 + parameter];
    first += b * (ab - a);
    total += 0.5 * (a - ab) * (a - ab);
    sum += a + b;
    squares += a * a + b * b;
  }
  const auto n = static_cast<double>(blocks.size());
  const double mean = sum / (2.0 * n), variance = squares / (2.0 * n) - mean * mean;
  return variance > 0.0 ? Pair{first / n / variance, total / n / variance} : Pair{};
}

Interval percentiles(std::vector<double> values) {
  std::ranges::sort(values);
  const auto at = [&](double share) { return values[static_cast<size_t>(share * static_cast<double>(values.size()))]; };
  return {at(0.5 - 0.5 * kTableConfidence), at(0.5 + 0.5 * kTableConfidence)};
}

}  // namespace

std::vector<SobolIndex> sobol_indices(std::span<const double> figures, size_t parameters) {
  if (figures.empty() || is_constant(figures)) return {};
  constexpr int kSamples = 500;
  const size_t size = parameters + 2;
  std::vector<double> y(figures.begin(), figures.end());
  const double mean = mean_of(y);
  for (double& value : y) value -= mean;
  std::vector<size_t> blocks(figures.size() / size);
  std::iota(blocks.begin(), blocks.end(), size_t{0});
  std::vector<SobolIndex> indices(parameters);
  for (size_t p = 0; p < parameters; ++p) {
    const Pair whole = estimate(y, blocks, size, p);
    Random random(p + 1);
    std::vector<double> first, total;
    std::vector<size_t> drawn(blocks.size());
    for (int sample = 0; sample < kSamples; ++sample) {
      for (size_t& block : drawn) {
        block = static_cast<size_t>(uniform(random) * static_cast<double>(blocks.size()));
      }
      const Pair pair = estimate(y, drawn, size, p);
      first.push_back(pair.first);
      total.push_back(pair.total);
    }
    indices[p] = {whole.first, whole.total, percentiles(std::move(first)), percentiles(std::move(total))};
  }
  return indices;
}

std::vector<SobolIndex> grid_indices(std::span<const double> figures, const std::vector<size_t>& counts) {
  if (figures.empty() || is_constant(figures)) return {};
  const double variance = variance_of(figures);
  std::vector<SobolIndex> indices(counts.size());
  size_t stride = figures.size();
  for (size_t p = 0; p < counts.size(); ++p) {
    const size_t count = counts[p];
    stride /= count;
    std::vector<double> over_others(count), over_own(figures.size() / count);
    for (size_t i = 0; i < figures.size(); ++i) {
      const size_t level = i / stride % count;
      over_others[level] += figures[i] * static_cast<double>(count) / static_cast<double>(figures.size());
      over_own[i / (stride * count) * stride + i % stride] += figures[i] / static_cast<double>(count);
    }
    SobolIndex& index = indices[p];
    index.first = variance_of(over_others) / variance;
    index.total = 1.0 - variance_of(over_own) / variance;
    index.first_interval = {index.first, index.first};
    index.total_interval = {index.total, index.total};
  }
  return indices;
}

}  // namespace hedgehop::sim
