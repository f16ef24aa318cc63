#include "avoidance/local_map/movers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kWidestM = 5.0;           // radius of a lump that is followed: what is larger is a wall
constexpr double kAccelerationMps2 = 1.0;  // 1-sigma of what a mover's velocity changes by
constexpr double kFirstSpeedMps = 2.0;     // 1-sigma of a velocity before anything is known of it
constexpr int kAppeared = 2;               // points of a lump where free space was, at least
constexpr double kAppearedShare = 0.1;
constexpr int kEvidence = 3, kMostEvidence = 6;
constexpr double kSlowestMps = 0.25, kSigmas = 3.0;
constexpr int kForgottenAfter = 40;  // images
constexpr double kForeseenS = 4.0;

}  // namespace

std::vector<Movers::Lump> Movers::lumps_of(std::span<const SurfacePoint> points) const {
  // Cells of twice the spacing; those that touch belong together.
  const double cell_m = 2.0 * config_.spacing_m;
  std::map<std::pair<int, int>, std::vector<size_t>> cells;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2i at = (points[i].p_W / cell_m).array().floor().cast<int>();
    cells[{at.x(), at.y()}].push_back(i);
  }
  std::vector<Lump> lumps;
  std::vector<size_t> members;
  std::vector<std::pair<int, int>> open;
  while (!cells.empty()) {
    members.clear();
    open = {cells.begin()->first};
    while (!open.empty()) {
      const auto [x, y] = open.back();
      open.pop_back();
      const auto found = cells.find({x, y});
      if (found == cells.end()) continue;
      members.insert(members.end(), found->second.begin(), found->second.end());
      cells.erase(found);
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) open.emplace_back(x + dx, y + dy);
      }
    }
    Eigen::AlignedBox2d bounds;
    Lump lump{Eigen::Vector2d::Zero(), 0.0, static_cast<int>(members.size()), 0};
    for (const size_t i : members) {
      bounds.extend(points[i].p_W);
      lump.appeared += points[i].was_free;
    }
    lump.p_W = bounds.center();
    lump.radius_m = 0.5 * bounds.diagonal().norm();
    if (lump.radius_m <= kWidestM) lumps.push_back(lump);
  }
  return lumps;
}

Eigen::Matrix2d Movers::covariance_m2(const Eigen::Vector2d& p_W, const Eigen::Vector2d& eye_W) const {
  constexpr double kVoxels = 0.5;  // 1-sigma across, in voxels
  const Eigen::Vector2d sight_W = p_W - eye_W;
  const double across_m = kVoxels * config_.spacing_m;
  const double along_m = config_.sigma_per_m2 * sight_W.squaredNorm();
  const Eigen::Vector2d u = sight_W.normalized();
  return across_m * across_m * Eigen::Matrix2d::Identity() + along_m * along_m * u * u.transpose();
}

void Movers::predict(double dt_s) {
  Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
  step.topRightCorner<2, 2>() = dt_s * Eigen::Matrix2d::Identity();
  Eigen::Matrix<double, 4, 2> push;
  push << 0.5 * dt_s * dt_s * Eigen::Matrix2d::Identity(), dt_s * Eigen::Matrix2d::Identity();
  for (Track& track : tracks_) {
    track.state = step * track.state;
    track.covariance =
        step * track.covariance * step.transpose() + kAccelerationMps2 * kAccelerationMps2 * push * push.transpose();
  }
}

void Movers::correct(Track& track, const Lump& lump, const Eigen::Vector2d& eye_W) const {
  const Eigen::Matrix2d innovation = track.covariance.topLeftCorner<2, 2>() + covariance_m2(lump.p_W, eye_W);
  const Eigen::Matrix<double, 4, 2> gain = track.covariance.leftCols<2>() * innovation.inverse();
  track.state += gain * (lump.p_W - track.state.head<2>());
  track.covariance -= (gain * track.covariance.topRows<2>()).eval();
  track.radius_m = std::max(lump.radius_m, 0.9 * track.radius_m);
  const bool appears = lump.appeared >= kAppeared && lump.appeared >= kAppearedShare * lump.points;
  track.evidence = std::clamp(track.evidence + (appears ? 1 : -1), 0, kMostEvidence);
  track.unseen = 0;
  // Whether it stands: the Mahalanobis distance of no motion.
  const Eigen::Vector2d v_W = track.state.tail<2>();
  const double sigmas = std::sqrt(v_W.dot(track.covariance.bottomRightCorner<2, 2>().inverse() * v_W));
  const bool moves = v_W.norm() > kSlowestMps && sigmas > kSigmas;
  if (moves && track.evidence >= kEvidence) track.is_mover = true;
  if (!moves || track.evidence == 0) track.is_mover = false;
}

void Movers::update(double t_s, const Eigen::Vector2d& eye_W, std::span<const SurfacePoint> points) {
  predict(t_s - t_s_);
  t_s_ = t_s;
  std::vector<Lump> lumps = lumps_of(points);
  for (Track& track : tracks_) {
    // The nearest lump, as far as the track may have come.
    const auto away_m = [&](const Lump& lump) { return (lump.p_W - track.state.head<2>()).norm(); };
    const auto nearest = std::ranges::min_element(lumps, {}, away_m);
    ++track.unseen;
    if (nearest == lumps.end()) continue;
    const Eigen::Matrix2d spread = track.covariance.topLeftCorner<2, 2>() + covariance_m2(nearest->p_W, eye_W);
    const Eigen::Vector2d off_W = nearest->p_W - track.state.head<2>();
    const double sigmas = std::sqrt(off_W.dot(spread.inverse() * off_W));
    if (sigmas > kSigmas && off_W.norm() > 0.5 * track.radius_m) continue;
    correct(track, *nearest, eye_W);
    lumps.erase(nearest);
  }
  std::erase_if(tracks_, [](const Track& track) { return track.unseen > kForgottenAfter; });
  for (const Lump& lump : lumps) {
    if (lump.appeared < kAppeared) continue;
    Track track{.state = Eigen::Vector4d::Zero(), .covariance = Eigen::Matrix4d::Zero(), .radius_m = lump.radius_m};
    track.state.head<2>() = lump.p_W;
    track.covariance.topLeftCorner<2, 2>() = covariance_m2(lump.p_W, eye_W);
    track.covariance.bottomRightCorner<2, 2>() = kFirstSpeedMps * kFirstSpeedMps * Eigen::Matrix2d::Identity();
    tracks_.push_back(track);
  }
}

std::vector<Mover> Movers::movers() const {
  std::vector<Mover> movers;
  for (const Track& track : tracks_) {
    if (!track.is_mover) continue;
    const Eigen::Vector4d variances = track.covariance.diagonal();
    movers.push_back({track.state.head<2>(), track.state.tail<2>(), track.radius_m,
                      std::sqrt(variances.head<2>().maxCoeff()), std::sqrt(variances.tail<2>().maxCoeff())});
  }
  return movers;
}

double threat_m(std::span<const Moment> path, std::span<const Mover> movers, const Clearance& clearance, double t_s) {
  double worst_m = 0.0;
  const auto meet = [&](const Moment& moment) {
    const double margin_m = clearance.margin_m + clearance.margin_s * moment.v_W.norm();
    for (const Mover& mover : movers) {
      const double dt_s = moment.t_s - t_s;
      const double sigma_m = std::min(mover.p_sigma_m + mover.v_sigma_mps * std::max(0.0, dt_s), 1.0);
      const double away_m = (moment.p_W - mover.p_W - dt_s * mover.v_W).norm() - mover.radius_m;
      worst_m = std::max(worst_m, clearance.hull_m + margin_m + sigma_m - away_m);
    }
  };
  if (movers.empty()) return 0.0;
  for (const Moment& moment : path) meet(moment);
  constexpr double kStepS = 0.1;
  Moment stands{path.back().t_s, path.back().p_W, Eigen::Vector2d::Zero()};
  while ((stands.t_s += kStepS) < path.front().t_s + kForeseenS) meet(stands);
  return worst_m;
}

}  // namespace hedgehop::avoidance::local_map
