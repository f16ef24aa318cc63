#include "avoidance/local_map/moving_obstacles.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace hedgehop::avoidance::local_map {
namespace {

constexpr double kRememberedS = 2.0;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns the convex hull, in the order from x to y: Andrew's monotone chain.
std::vector<Eigen::Vector2d> hull_of(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  };
  std::ranges::sort(points, before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Eigen::Vector2d> hull;
  const auto chain = [&](auto first, auto last) {
    const size_t begin = hull.size();
    for (auto p = first; p != last; ++p) {
      while (hull.size() >= begin + 2 && cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();  // first point of the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

constexpr double kMaxRadiusM = 5.0;        // maximum radius of a tracked cluster; a larger one is a wall
constexpr double kDeepSigmas = 4.0;        // sigmas of depth by which a cluster may appear deeper than it is
constexpr double kAccelerationMps2 = 1.0;  // 1-sigma acceleration of an obstacle
constexpr double kFirstSpeedMps = 2.0;     // 1-sigma velocity of a new track
constexpr int kAppeared = 2;               // minimum number of points in space that was free
constexpr double kAppearedShare = 0.1;
constexpr int kEvidence = 3, kMaxEvidence = 6;
constexpr double kMinSpeedMps = 0.25, kSigmas = 3.0, kMovesSigmas = 2.0;
constexpr double kStillMps = 0.12, kStillSigmas = 1.0;  // below these limits an obstacle counts as static
constexpr double kShrinks = 0.1;  // share by which the radius approaches a smaller observed one per image
constexpr double kHiddenM = 5.0;  // 1-sigma error along the line of sight if the near surface is hidden
constexpr double kHidesM = 1.0;   // margin beyond the minimum depth within which part of the surface may be hidden
// In tuning flights, the mean stays below 0.3 among 132 moving boxes, and exceeds 4 along rows of equal posts.
constexpr double kMeanS = 10.0, kMaxSudden = 1.0;
constexpr double kSuddenShare = 0.5;
constexpr double kLostM = 1.5;  // maximum 1-sigma position error; above it a track would adopt any cluster

}  // namespace

void VisibleSurface::move(const Eigen::Vector2d& by_W) {
  for (Corner& corner : corners_) corner.p_W += by_W;
}

void VisibleSurface::see(double t_s, std::span<const Eigen::Vector2d> points_W) {
  std::erase_if(corners_, [&](const Corner& corner) { return corner.t_s < t_s - kRememberedS; });
  for (const Eigen::Vector2d& p_W : hull_of({points_W.begin(), points_W.end()})) corners_.push_back({p_W, t_s});
}

std::vector<Eigen::Vector2d> VisibleSurface::hull_W() const {
  std::vector<Eigen::Vector2d> points;
  points.reserve(corners_.size());
  for (const Corner& corner : corners_) points.push_back(corner.p_W);
  return hull_of(std::move(points));
}

double away_m(std::span<const Eigen::Vector2d> convex, const Eigen::Vector2d& p) {
  double least_m = (p - convex.front()).norm();
  bool inside = convex.size() > 2;
  for (size_t i = 0; i < convex.size(); ++i) {
    const Eigen::Vector2d& a = convex[i];
    const Eigen::Vector2d along = convex[(i + 1) % convex.size()] - a;
    const double length_m2 = along.squaredNorm();
    if (length_m2 == 0.0) continue;
    const double share = std::clamp((p - a).dot(along) / length_m2, 0.0, 1.0);
    least_m = std::min(least_m, (p - a - share * along).norm());
    inside &= cross(along, p - a) >= 0.0;
  }
  return inside ? 0.0 : least_m;
}

std::vector<MovingObstacleTracker::Cluster> MovingObstacleTracker::clusters_of(
    const ViewSector& view, std::span<const SurfacePoint> points) const {
  // Cells of twice the spacing; adjacent cells belong to one cluster.
  const double cell_m = 2.0 * config_.spacing_m;
  std::map<std::pair<int, int>, std::vector<size_t>> cells;
  for (size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2i at = (points[i].p_W / cell_m).array().floor().cast<int>();
    cells[{at.x(), at.y()}].push_back(i);
  }
  std::vector<Cluster> clusters;
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
    Cluster cluster;
    Eigen::Vector2d middle_W = Eigen::Vector2d::Zero();
    for (const size_t i : members) {
      cluster.points_W.push_back(points[i].p_W);
      middle_W += points[i].p_W / static_cast<double>(members.size());
    }
    cluster.camera_W = view.camera_W;
    cluster.sight_W = (middle_W - view.camera_W).normalized();
    cluster.nearest_m = std::numeric_limits<double>::infinity();
    const Eigen::Vector2d right_W(-cluster.sight_W.y(), cluster.sight_W.x());
    double near_m = std::numeric_limits<double>::infinity(), far_m = 0.0, left_m = near_m, right_m = -near_m;
    for (const size_t i : members) {
      const Eigen::Vector2d off_W = points[i].p_W - view.camera_W;
      near_m = std::min(near_m, off_W.dot(cluster.sight_W));
      far_m = std::max(far_m, off_W.dot(cluster.sight_W));
      cluster.nearest_m = std::min(cluster.nearest_m, off_W.norm());
      const double across_m = off_W.dot(right_W);
      if (across_m < left_m) cluster.left_end_W = points[i].p_W;
      if (across_m > right_m) cluster.right_end_W = points[i].p_W;
      left_m = std::min(left_m, across_m);
      right_m = std::max(right_m, across_m);
      cluster.appeared += points[i].was_free;
      cluster.cut_left |= view.inside_left_m(points[i].p_W) < cell_m;
      cluster.cut_right |= view.inside_right_m(points[i].p_W) < cell_m;
    }
    cluster.radius_m = 0.5 * (right_m - left_m + config_.spacing_m);
    cluster.near_W = view.camera_W + near_m * cluster.sight_W + 0.5 * (left_m + right_m) * right_W;
    // A visible surface that is deeper than wide is a wall along the line of sight.
    const double unsure_m = kDeepSigmas * config_.sigma_per_m2 * far_m * far_m + config_.spacing_m;
    const bool wall = far_m - near_m > 2.0 * cluster.radius_m + unsure_m;
    if (cluster.radius_m <= kMaxRadiusM && !wall) clusters.push_back(std::move(cluster));
  }
  return clusters;
}

/// Returns the center of the disc of a cluster, which is as deep as it is wide. If the edge of the view cuts an
/// obstacle that was wider before, its near surface may be out of view. The line of sight that touches the other side
/// then gives the center, limited by the distance of the visible part.
Eigen::Vector2d MovingObstacleTracker::Cluster::middle_W(double disc_m) const {
  if (cut_left == cut_right || disc_m <= radius_m) return near_W + disc_m * sight_W;
  const Eigen::Vector2d& side_W = cut_right ? left_end_W : right_end_W;
  const Eigen::Vector2d along_W = (side_W - camera_W).normalized(), right_W(-along_W.y(), along_W.x());
  const Eigen::Vector2d off_W = side_W + (cut_right ? disc_m : -disc_m) * right_W - camera_W;
  return camera_W + std::min(1.0, (nearest_m + disc_m) / off_W.norm()) * off_W;
}

Eigen::Matrix2d MovingObstacleTracker::covariance_m2(const Eigen::Vector2d& p_W,
                                                     const Eigen::Vector2d& camera_W) const {
  constexpr double kVoxels = 0.5;  // 1-sigma error across the line of sight, in voxels
  const Eigen::Vector2d sight_W = p_W - camera_W;
  const double across_m = kVoxels * config_.spacing_m;
  const double along_m = config_.sigma_per_m2 * sight_W.squaredNorm();
  const Eigen::Vector2d u = sight_W.normalized();
  return across_m * across_m * Eigen::Matrix2d::Identity() + along_m * along_m * u * u.transpose();
}

bool MovingObstacleTracker::hides(const Track& track, const Eigen::Vector2d& camera_W) const {
  return (track.state.head<2>() - camera_W).norm() - track.radius_m < config_.nearest_m + kHidesM;
}

void MovingObstacleTracker::predict(double dt_s) {
  Eigen::Matrix4d step = Eigen::Matrix4d::Identity();
  step.topRightCorner<2, 2>() = dt_s * Eigen::Matrix2d::Identity();
  Eigen::Matrix<double, 4, 2> push;
  push << 0.5 * dt_s * dt_s * Eigen::Matrix2d::Identity(), dt_s * Eigen::Matrix2d::Identity();
  for (Track& track : tracks_) {
    track.state = step * track.state;
    track.surface.move(dt_s * track.state.tail<2>());
    track.covariance =
        step * track.covariance * step.transpose() + kAccelerationMps2 * kAccelerationMps2 * push * push.transpose();
  }
}

void MovingObstacleTracker::correct(Track& track, const Cluster& cluster, const ViewSector& view) const {
  const bool whole = !cluster.cut_left && !cluster.cut_right;
  // The observed surface keeps its position: growth of the visible part is no motion.
  const double grows_m = cluster.radius_m > track.radius_m ? cluster.radius_m - track.radius_m
                         : whole                           ? kShrinks * (cluster.radius_m - track.radius_m)
                                                           : 0.0;
  track.radius_m += grows_m;
  track.state.head<2>() += grows_m * cluster.sight_W;
  if (grows_m > 0.0 && cluster.cut_left != cluster.cut_right) {
    const Eigen::Vector2d right_W(-cluster.sight_W.y(), cluster.sight_W.x());
    track.state.head<2>() += (cluster.cut_right ? grows_m : -grows_m) * right_W;
  }
  const Eigen::Vector2d p_W = cluster.middle_W(track.radius_m);
  Eigen::Matrix2d error_m2 = covariance_m2(p_W, view.camera_W);
  if (hides(track, view.camera_W)) error_m2 += kHiddenM * kHiddenM * cluster.sight_W * cluster.sight_W.transpose();
  const Eigen::Matrix2d innovation = track.covariance.topLeftCorner<2, 2>() + error_m2;
  const Eigen::Matrix<double, 4, 2> gain = track.covariance.leftCols<2>() * innovation.inverse();
  track.state += gain * (p_W - track.state.head<2>());
  track.covariance -= (gain * track.covariance.topRows<2>()).eval();
  const bool appears = cluster.appeared >= kAppeared &&
                       cluster.appeared >= kAppearedShare * static_cast<double>(cluster.points_W.size());
  // A cluster that is cut by the view may show only its remaining side, which is no evidence against motion.
  const int proof = appears ? 1 : whole ? -1 : 0;
  track.evidence = std::clamp(track.evidence + proof, 0, kMaxEvidence);
  track.unseen = 0;
  track.surface.see(t_s_, cluster.points_W);
  // Test for zero velocity: Mahalanobis distance of no motion.
  const Eigen::Vector2d v_W = track.state.tail<2>();
  const double sigmas = std::sqrt(v_W.dot(track.covariance.bottomRightCorner<2, 2>().inverse() * v_W));
  const bool moves = v_W.norm() > kMinSpeedMps && sigmas > kMovesSigmas;
  const bool stands = v_W.norm() < kStillMps || sigmas < kStillSigmas;
  if (moves && track.evidence >= kEvidence) track.is_moving = true;
  if (stands || track.evidence == 0) track.is_moving = false;
}

void MovingObstacleTracker::update(double t_s, const ViewSector& view, std::span<const SurfacePoint> points) {
  const double dt_s = t_s - t_s_;
  predict(dt_s);
  t_s_ = t_s;
  std::vector<Cluster> clusters = clusters_of(view, points);
  for (Track& track : tracks_) {
    // The nearest cluster within the uncertainty of the track.
    const auto off_of = [&](const Cluster& cluster) -> Eigen::Vector2d {
      return cluster.middle_W(std::max(track.radius_m, cluster.radius_m)) - track.state.head<2>();
    };
    const auto away_m = [&](const Cluster& cluster) { return off_of(cluster).norm(); };
    const auto nearest = std::ranges::min_element(clusters, {}, away_m);
    ++track.unseen;
    if (nearest == clusters.end()) continue;
    const Eigen::Matrix2d spread =
        track.covariance.topLeftCorner<2, 2>() + covariance_m2(nearest->near_W, view.camera_W);
    const Eigen::Vector2d off_W = off_of(*nearest);
    const double sigmas = std::sqrt(off_W.dot(spread.inverse() * off_W));
    if (sigmas > kSigmas && off_W.norm() > 0.5 * track.radius_m) continue;
    correct(track, *nearest, view);
    clusters.erase(nearest);
  }
  std::erase_if(tracks_, [](const Track& track) {
    return track.unseen > 0 && track.covariance.diagonal().head<2>().maxCoeff() > kLostM * kLostM;
  });
  // Remaining clusters near an obstacle that is too near to be measured belong to it.
  std::erase_if(clusters, [&](const Cluster& cluster) {
    return std::ranges::any_of(tracks_, [&](const Track& track) {
      const double off_m = (cluster.near_W - track.state.head<2>()).norm();
      return hides(track, view.camera_W) && off_m < track.radius_m + config_.spacing_m;
    });
  });
  for (const Cluster& cluster : clusters) {
    if (cluster.appeared < kAppeared) continue;
    Track track{.state = Eigen::Vector4d::Zero(), .covariance = Eigen::Matrix4d::Zero(), .radius_m = cluster.radius_m};
    track.state.head<2>() = cluster.middle_W(cluster.radius_m);
    track.covariance.topLeftCorner<2, 2>() = covariance_m2(cluster.near_W, view.camera_W);
    track.covariance.bottomRightCorner<2, 2>() = kFirstSpeedMps * kFirstSpeedMps * Eigen::Matrix2d::Identity();
    track.sudden = !cluster.cut_left && !cluster.cut_right &&
                   cluster.appeared >= kSuddenShare * static_cast<double>(cluster.points_W.size());
    track.surface.see(t_s, cluster.points_W);
    tracks_.push_back(track);
  }
  const auto sudden =
      std::ranges::count_if(tracks_, [](const Track& track) { return track.is_moving && track.sudden; });
  mean_sudden_ += std::min(1.0, dt_s / kMeanS) * (static_cast<double>(sudden) - mean_sudden_);
}

std::vector<MovingObstacle> MovingObstacleTracker::moving_obstacles() const {
  std::vector<MovingObstacle> moving_obstacles;
  if (mean_sudden_ > kMaxSudden) return moving_obstacles;
  for (const Track& track : tracks_) {
    if (!track.is_moving) continue;
    const Eigen::Vector4d variances = track.covariance.diagonal();
    moving_obstacles.push_back({track.state.head<2>(), track.state.tail<2>(), track.radius_m,
                                std::sqrt(variances.head<2>().maxCoeff()), std::sqrt(variances.tail<2>().maxCoeff()),
                                track.surface.hull_W()});
  }
  return moving_obstacles;
}

}  // namespace hedgehop::avoidance::local_map
