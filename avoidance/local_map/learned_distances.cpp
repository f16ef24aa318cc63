#include "avoidance/local_map/learned_distances.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kSquareM = 3.0, kHighM = 1.2;
constexpr int kSquares = 4;             // squares around the vehicle's own
constexpr double kBothWaysPrice = 3.5;  // of a meter up and down again, in meters of way
constexpr size_t kMost = 20'000;        // squares: beyond, all are forgotten

}  // namespace

LearnedDistances::Square LearnedDistances::square(const Eigen::Vector2d& p_W) {
  const Eigen::Vector2i at = (p_W / kSquareM).array().floor().cast<int>();
  return {at.x(), at.y()};
}

void LearnedDistances::learn(const RouteField& route, const LevelSlice& slice, const Eigen::Vector3d& p_W,
                             const Eigen::Vector3d& goal_W) {
  constexpr double kSameM = 0.5;
  if (!goal_W_ || (goal_W - *goal_W_).norm() > kSameM || distances_m_.size() > kMost) distances_m_.clear();
  goal_W_ = goal_W;
  const Eigen::Vector2i here = (p_W.head<2>() / kSquareM).array().floor().cast<int>();
  for (int row = here.x() - kSquares; row <= here.x() + kSquares; ++row) {
    for (int col = here.y() - kSquares; col <= here.y() + kSquares; ++col) {
      const Eigen::Vector2d middle_W = kSquareM * Eigen::Vector2d(row + 0.5, col + 0.5);
      const Eigen::Vector2i cell = slice.cell(middle_W);
      if (!slice.contains(cell.x(), cell.y()) || slice.at(cell.x(), cell.y()) != LevelSlice::State::free) continue;
      const std::optional<double> found_m = route.to_goal_m(middle_W);
      if (!found_m) continue;
      double& known_m = distances_m_[square(middle_W)][static_cast<int>(std::lround(p_W.z() / kHighM))];
      known_m = std::max(known_m, *found_m);
    }
  }
}

double LearnedDistances::at_least_m(const Eigen::Vector2d& p_W, double z_W) const {
  const auto known = distances_m_.find(square(p_W));
  double most_m = 0.0;
  if (known == distances_m_.end()) return most_m;
  for (const auto& [level, found_m] : known->second) {
    most_m = std::max(most_m, found_m - kBothWaysPrice * std::abs(kHighM * level - z_W));
  }
  return most_m;
}

}  // namespace hedgehop::avoidance::local_map
