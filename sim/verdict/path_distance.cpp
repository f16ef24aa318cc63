#include "sim/verdict/path_distance.h"

#include <algorithm>

#include "sim/fields/quantities.h"

namespace hedgehop::sim {
namespace {

/// Fills the table of pairs row by row and returns its last cell. @param cell  function of the costs of (i-1, j-1),
/// (i-1, j), (i, j-1) and the pair's distance. Cells outside the table are +inf; the one before the first pair is 0.
template <class CellOf>
double last_cell(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b, CellOf cell) {
  std::vector<double> above(b.size() + 1, kInfinity), row(b.size() + 1, kInfinity);
  above[0] = 0.0;
  for (const TimedPoint& p : a) {
    row[0] = kInfinity;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = cell(above[j - 1], above[j], row[j - 1], (p.p_WB - b[j - 1].p_WB).norm());
    }
    std::swap(above, row);
  }
  return above.back();
}

}  // namespace

Eigen::Vector3d position_at(const std::vector<TimedPoint>& path, double t_s) {
  const auto after = std::ranges::upper_bound(path, t_s, {}, &TimedPoint::t_s);
  if (after == path.begin()) return path.front().p_WB;
  if (after == path.end()) return path.back().p_WB;
  const TimedPoint &p = *(after - 1), &q = *after;
  return p.p_WB + (t_s - p.t_s) / (q.t_s - p.t_s) * (q.p_WB - p.p_WB);
}

const TimedPoint* first_beyond(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference,
                               double limit_m) {
  const auto found = std::ranges::find_if(
      flown, [&](const TimedPoint& p) { return (p.p_WB - position_at(reference, p.t_s)).norm() > limit_m; });
  return found == flown.end() ? nullptr : &*found;
}

double max_deviation_m(const std::vector<TimedPoint>& flown, const std::vector<TimedPoint>& reference) {
  double maximum_m = 0.0;
  for (const TimedPoint& p : flown) maximum_m = std::max(maximum_m, (p.p_WB - position_at(reference, p.t_s)).norm());
  for (const TimedPoint& p : reference) maximum_m = std::max(maximum_m, (p.p_WB - position_at(flown, p.t_s)).norm());
  return maximum_m;
}

double discrete_frechet_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b) {
  return last_cell(a, b, [](double both, double first, double second, double d) {
    return std::max(std::min({both, first, second}), d);
  });
}

double mean_warped_distance_m(const std::vector<TimedPoint>& a, const std::vector<TimedPoint>& b) {
  const double sum = last_cell(a, b, [](double both, double first, double second, double d) {
    return std::min({both + 2.0 * d, first + d, second + d});
  });
  return sum / static_cast<double>(a.size() + b.size());
}

}  // namespace hedgehop::sim
