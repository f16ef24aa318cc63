#include "avoidance/local_map/movers.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kWidestM = 5.0;           // radius of a lump that is followed: what is larger is a wall
constexpr double kDeepSigmas = 4.0;        // of depth, by which a lump may seem deeper than it is
constexpr double kAccelerationMps2 = 1.0;  // 1-sigma of what a mover's velocity changes by
constexpr double kFirstSpeedMps = 2.0;     // 1-sigma of a velocity before anything is known of it
constexpr int kAppeared = 2;               // points of a lump where free space was, at least
constexpr double kAppearedShare = 0.1;
constexpr int kEvidence = 3, kMostEvidence = 6;
constexpr double kSlowestMps = 0.25, kSigmas = 3.0, kMovesSigmas = 2.0;
constexpr double kStillMps = 0.12, kStillSigmas = 1.0;  // below, what moved is taken to stand
constexpr double kShrinks = 0.1;                        // of a radius, an image, towards a smaller one that is seen
constexpr double kHiddenM = 5.0;                        // 1-sigma along the sight, where the near face is not seen
constexpr double kHidesM = 1.0;  // what is nearer than this beyond the nearest depth may hide some of its face already
constexpr double kLostM = 1.5;   // 1-sigma of a position, beyond which a track would take up whatever comes by

}  // namespace

std::vector<Movers::Lump> Movers::lumps_of(const View& view, std::span<const SurfacePoint> points) const {
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
    Lump lump;
    Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
    for (const size_t i : members) {
      lump.points_W.push_back(points[i].p_W);
      middle_W += points[i].p_W / static_cast<double>(members.size());
    }
    lump.eye_W = view.eye_W;
    lump.sight_W = (middle_W - view.eye_W).normalized();
    lump.nearest_m = std::numeric_limits<double>::infinity();
    const Eigen::Vector2d right_W(-lump.sight_W.y(), lump.sight_W.x());
    double near_m = std::numeric_limits<double>::infinity(), far_m = 0.0, left_m = near_m, right_m = -near_m;
    for (const size_t i : members) {
      const Eigen::Vector2d off_W = points[i].p_W - view.eye_W;
      near_m = std::min(near_m, off_W.dot(lump.sight_W));
      far_m = std::max(far_m, off_W.dot(lump.sight_W));
      lump.nearest_m = std::min(lump.nearest_m, off_W.norm());
      const double across_m = off_W.dot(right_W);
      if (across_m < left_m) lump.left_end_W = points[i].p_W;
      if (across_m > right_m) lump.right_end_W = points[i].p_W;
      left_m = std::min(left_m, across_m);
      right_m = std::max(right_m, across_m);
      lump.appeared += points[i].was_free;
      lump.cut_left |= view.inside_left_m(points[i].p_W) < cell_m;
      lump.cut_right |= view.inside_right_m(points[i].p_W) < cell_m;
    }
    lump.radius_m = 0.5 * (right_m - left_m + config_.spacing_m);
    lump.near_W = view.eye_W + near_m * lump.sight_W + 0.5 * (left_m + right_m) * right_W;
    // What is deeper than wide, though only its face is seen, is a wall that is looked along.
    const double unsure_m = kDeepSigmas * config_.sigma_per_m2 * far_m * far_m + config_.spacing_m;
    const bool wall = far_m - near_m > 2.0 * lump.radius_m + unsure_m;
    if (lump.radius_m <= kWidestM && !wall) lumps.push_back(std::move(lump));
  }
  return lumps;
}

/// The middle of the disc that shows a lump: as deep as wide. Where the view cuts what was seen wider, its near face
/// may be out of view: then the line of sight that touches its other side tells; no farther than what is seen of it.
Eigen::Vector2d Movers::Lump::middle_W(double disc_m) const {
  if (cut_left == cut_right || disc_m <= radius_m) return near_W + disc_m * sight_W;
  const Eigen::Vector2d& side_W = cut_right ? left_end_W : right_end_W;
  const Eigen::Vector2d along_W = (side_W - eye_W).normalized(), right_W(-along_W.y(), along_W.x());
  const Eigen::Vector2d off_W = side_W + (cut_right ? disc_m : -disc_m) * right_W - eye_W;
  return eye_W + std::min(1.0, (nearest_m + disc_m) / off_W.norm()) * off_W;
}

Eigen::Matrix2d Movers::covariance_m2(const Eigen::Vector2d& p_W, const Eigen::Vector2d& eye_W) const {
  constexpr double kVoxels = 0.5;  // 1-sigma across, in voxels
  const Eigen::Vector2d sight_W = p_W - eye_W;
  const double across_m = kVoxels * config_.spacing_m;
  const double along_m = config_.sigma_per_m2 * sight_W.squaredNorm();
  const Eigen::Vector2d u = sight_W.normalized();
  return across_m * across_m * Eigen::Matrix2d::Identity() + along_m * along_m * u * u.transpose();
}

bool Movers::hides(const Track& track, const Eigen::Vector2d& eye_W) const {
  return (track.state.head<2>() - eye_W).norm() - track.radius_m < config_.nearest_m + kHidesM;
}

void Movers::predict(double dt_s) {
  Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
  step.topRightCorner<2, 2>() = dt_s * Eigen::Matrix2d::Identity();
  Eigen::Matrix<double, 4, 2> push;
  push << 0.5 * dt_s * dt_s * Eigen::Matrix2d::Identity(), dt_s * Eigen::Matrix2d::Identity();
  for (Track& track : tracks_) {
    track.state = step * track.state;
    track.face.move(dt_s * track.state.tail<2>());
    track.covariance =
        step * track.covariance * step.transpose() + kAccelerationMps2 * kAccelerationMps2 * push * push.transpose();
  }
}

void Movers::correct(Track& track, const Lump& lump, const View& view) const {
  const bool whole = !lump.cut_left && !lump.cut_right;
  // The face that was seen stays where it is: more of it is seen, nothing has moved.
  const double grows_m = lump.radius_m > track.radius_m ? lump.radius_m - track.radius_m
                         : whole                        ? kShrinks * (lump.radius_m - track.radius_m)
                                                        : 0.0;
  track.radius_m += grows_m;
  track.state.head<2>() += grows_m * lump.sight_W;
  if (grows_m > 0.0 && lump.cut_left != lump.cut_right) {
    const Eigen::Vector2d right_W(-lump.sight_W.y(), lump.sight_W.x());
    track.state.head<2>() += (lump.cut_right ? grows_m : -grows_m) * right_W;
  }
  const Eigen::Vector2d p_W = lump.middle_W(track.radius_m);
  Eigen::Matrix2d error_m2 = covariance_m2(p_W, view.eye_W);
  if (hides(track, view.eye_W)) error_m2 += kHiddenM * kHiddenM * lump.sight_W * lump.sight_W.transpose();
  const Eigen::Matrix2d innovation = track.covariance.topLeftCorner<2, 2>() + error_m2;
  const Eigen::Matrix<double, 4, 2> gain = track.covariance.leftCols<2>() * innovation.inverse();
  track.state += gain * (p_W - track.state.head<2>());
  track.covariance -= (gain * track.covariance.topRows<2>()).eval();
  const bool appears =
      lump.appeared >= kAppeared && lump.appeared >= kAppearedShare * static_cast<double>(lump.points_W.size());
  // What the view cuts may show no more than the side that it leaves.
  const int proof = appears ? 1 : whole ? -1 : 0;
  track.evidence = std::clamp(track.evidence + proof, 0, kMostEvidence);
  track.unseen = 0;
  track.face.see(t_s_, lump.points_W);
  // Whether it stands: the Mahalanobis distance of no motion.
  const Eigen::Vector2d v_W = track.state.tail<2>();
  const double sigmas = std::sqrt(v_W.dot(track.covariance.bottomRightCorner<2, 2>().inverse() * v_W));
  const bool moves = v_W.norm() > kSlowestMps && sigmas > kMovesSigmas;
  const bool stands = v_W.norm() < kStillMps || sigmas < kStillSigmas;
  if (moves && track.evidence >= kEvidence) track.is_mover = true;
  if (stands || track.evidence == 0) track.is_mover = false;
}

void Movers::update(double t_s, const View& view, std::span<const SurfacePoint> points) {
  predict(t_s - t_s_);
  t_s_ = t_s;
  std::vector<Lump> lumps = lumps_of(view, points);
  for (Track& track : tracks_) {
    // The nearest lump, as far as the track may have come.
    const auto off_of = [&](const Lump& lump) -> Eigen::Vector2d {
      return lump.middle_W(std::max(track.radius_m, lump.radius_m)) - track.state.head<2>();
    };
    const auto away_m = [&](const Lump& lump) { return off_of(lump).norm(); };
    const auto nearest = std::ranges::min_element(lumps, {}, away_m);
    ++track.unseen;
    if (nearest == lumps.end()) continue;
    const Eigen::Matrix2d spread = track.covariance.topLeftCorner<2, 2>() + covariance_m2(nearest->near_W, view.eye_W);
    const Eigen::Vector2d off_W = off_of(*nearest);
    const double sigmas = std::sqrt(off_W.dot(spread.inverse() * off_W));
    if (sigmas > kSigmas && off_W.norm() > 0.5 * track.radius_m) continue;
    correct(track, *nearest, view);
    lumps.erase(nearest);
  }
  std::erase_if(tracks_, [](const Track& track) {
    return track.unseen > 0 && track.covariance.diagonal().head<2>().maxCoeff() > kLostM * kLostM;
  });
  // What is left in view of one that is too near is no other.
  std::erase_if(lumps, [&](const Lump& lump) {
    return std::ranges::any_of(tracks_, [&](const Track& track) {
      const double off_m = (lump.near_W - track.state.head<2>()).norm();
      return hides(track, view.eye_W) && off_m < track.radius_m + config_.spacing_m;
    });
  });
  for (const Lump& lump : lumps) {
    if (lump.appeared < kAppeared) continue;
    Track track{.state = Eigen::Vector4d::Zero(), .covariance = Eigen::Matrix4d::Zero(), .radius_m = lump.radius_m};
    track.state.head<2>() = lump.middle_W(lump.radius_m);
    track.covariance.topLeftCorner<2, 2>() = covariance_m2(lump.near_W, view.eye_W);
    track.covariance.bottomRightCorner<2, 2>() = kFirstSpeedMps * kFirstSpeedMps * Eigen::Matrix2d::Identity();
    track.face.see(t_s, lump.points_W);
    tracks_.push_back(track);
  }
}

std::vector<Mover> Movers::movers() const {
  std::vector<Mover> movers;
  for (const Track& track : tracks_) {
    if (!track.is_mover) continue;
    const Eigen::Vector4d variances = track.covariance.diagonal();
    movers.push_back({track.state.head<2>(), track.state.tail<2>(), track.radius_m,
                      std::sqrt(variances.head<2>().maxCoeff()), std::sqrt(variances.tail<2>().maxCoeff()),
                      track.face.hull_W()});
  }
  return movers;
}

}  // namespace hedgehop::avoidance::local_map
