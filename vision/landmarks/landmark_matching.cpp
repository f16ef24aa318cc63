#include "vision/landmarks/landmark_matching.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace hedgehop::vision::landmarks {
namespace {

struct MatchPair {
  double z = 0.0;
  size_t bearing = 0, landmark = 0;
  auto order() const { return std::tie(z, bearing, landmark); }
};

/// Half the extent, in x and y, of the residuals whose Z value lies below a gate. Along a unit vector e the squared
/// residual is below 4 gate e'Se; the curve's box lies within that of a circle of the greatest eigenvalue of S.
double reach(const PredictedBearing& seen, double gate) {
  const Eigen::Matrix2d& S = seen.covariance;
  const double mean = 0.5 * S.trace();
  const double greatest = mean + std::hypot(0.5 * (S(0, 0) - S(1, 1)), S(0, 1));
  constexpr double kRounding = 1.0 + 1e-9;
  return kRounding * 2.0 * std::sqrt(gate * greatest);
}

}  // namespace

std::vector<std::optional<size_t>> match_landmarks(std::span<const std::optional<PredictedBearing>> predicted,
                                                   std::span<const Eigen::Vector2d> bearings_meas, double gate) {
  std::vector<size_t> by_x(bearings_meas.size());
  std::iota(by_x.begin(), by_x.end(), size_t{0});
  std::ranges::sort(by_x, {}, [&](size_t i) { return std::pair(bearings_meas[i].x(), i); });

  std::vector<MatchPair> pairs;
  for (size_t k = 0; k < predicted.size(); ++k) {
    if (!predicted[k]) continue;
    const Eigen::Vector2d at = predicted[k]->bearing;
    const double within = reach(*predicted[k], gate);
    const auto first =
        std::ranges::lower_bound(by_x, at.x() - within, {}, [&](size_t i) { return bearings_meas[i].x(); });
    for (auto i = first; i != by_x.end() && bearings_meas[*i].x() <= at.x() + within; ++i) {
      if (std::abs(bearings_meas[*i].y() - at.y()) > within) continue;
      const double z = z_value(*predicted[k], bearings_meas[*i]);
      if (z < gate) pairs.push_back({z, *i, k});
    }
  }
  std::ranges::sort(pairs, {}, &MatchPair::order);

  std::vector<std::optional<size_t>> landmark_of(bearings_meas.size());
  std::vector<bool> taken(predicted.size(), false);
  for (const MatchPair& pair : pairs) {
    if (landmark_of[pair.bearing] || taken[pair.landmark]) continue;
    landmark_of[pair.bearing] = pair.landmark;
    taken[pair.landmark] = true;
  }
  return landmark_of;
}

}  // namespace hedgehop::vision::landmarks
