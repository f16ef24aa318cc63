#include "avoidance/local_map/surroundings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <ranges>

#include "avoidance/heading.h"
#include "vision/mapping/depth_blocks.h"
#include "vision/mapping/find_plain.h"
#include "vision/mapping/ground_plane.h"

namespace hedgehop::avoidance::local_map {
namespace {

using stereo::DisparitySource;
using vision::mapping::DepthBlock;
using vision::mapping::OccupancyMap;

constexpr int kLayers = 12, kLayersOfLevels = 32;  // layers of the map with one altitude, and with an altitude band
constexpr double kFadeSteps = 5.0;                 // maximum number of steps from free to unknown
constexpr double kLevelM = 0.3;                    // accuracy of the altitude control, above and below

HeightRange hull_of(const VehicleLimits& limits) {
  constexpr double kHalfHeightM = 0.2;  // of a vehicle without boxes
  HeightRange hull{-kHalfHeightM, kHalfHeightM};
  for (const Eigen::AlignedBox3d& part_B : limits.outline_B) {
    hull.top_m = std::min(hull.top_m, part_B.min().z());
    hull.bottom_m = std::max(hull.bottom_m, part_B.max().z());
  }
  return hull;
}

/// Returns the first pair, then the others.
template <class CameraPair>
std::vector<CameraPair> pairs_of(const LocalMapConfig& config, const Setup& setup) {
  std::vector<CameraPair> pairs;
  const auto add = [&](const std::string& pair) {
    pairs.push_back({{config.depth, DisparitySource::Grey::unused, config.stereo, setup, pair},
                     vision::stereo::CoarseMatcher(config.stereo),
                     {},
                     {},
                     {},
                     {}});
  };
  add("");
  for (const std::string& pair : config.pairs) add(pair);
  return pairs;
}

MovingObstacleTracker::Config tracking(const LocalMapConfig& config, const vision::stereo::StereoGeometry& geometry) {
  const double most_px = config.depth == DisparitySource::From::stereo ? config.stereo.disparities_px - 1 : 1e6;
  return {.sigma_per_m2 = config.noise_px / (geometry.focal_px * geometry.baseline_m),
          .spacing_m = config.voxel_m,
          .nearest_m = geometry.focal_px * geometry.baseline_m / most_px};
}

/// Returns half the side of the window of the matcher, px.
int half_window_px(const LocalMapConfig& config) {
  switch (config.depth) {
    case DisparitySource::From::stereo:
      return config.stereo.block_px / 2;
    case DisparitySource::From::motion:
      return vision::motion::PlaneSweep::kHalfWindowPx;
    case DisparitySource::From::camera:
      break;
  }
  return 0;
}

/// Returns the rows of an image in which lines are searched: those within 10 degrees of the horizon in any column. They
/// show altitudes up to 0.7 m off beyond 4 m.
cv::Range rows_of_map(const DisparitySource& source, const Eigen::Vector3d& down_C) {
  constexpr double kSine = 0.17;
  const cv::Size image = source.image();
  cv::Range rows(image.height, 0);
  for (int v = 0; v < image.height; ++v) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const int u : {0, image.width / 2, image.width - 1}) {
      const double sine = down_C.dot(source.geometry().ray_at_unit_depth({u, v}).normalized());
      low = std::min(low, sine);
      high = std::max(high, sine);
    }
    if (low > kSine || high < -kSine) continue;
    rows.start = std::min(rows.start, v);
    rows.end = v + 1;
  }
  return rows;
}

}  // namespace

Needs Surroundings::needs(const LocalMapConfig& config) {
  Needs needs = DisparitySource::needs(config.depth, DisparitySource::Grey::unused);
  for (const std::string& pair : config.pairs) {
    std::ranges::move(DisparitySource::needs(config.depth, DisparitySource::Grey::unused, pair).cameras,
                      std::back_inserter(needs.cameras));
  }
  needs.commands = {CommandType::velocity};
  return needs;
}

Surroundings::Surroundings(const LocalMapConfig& config, const Setup& setup, const HullDiscs& hull_discs)
    : config_(config),
      hull_discs_(hull_discs),
      radius_m_(setup.limits.radius_m),
      hull_(hull_of(setup.limits)),
      pairs_(pairs_of<CameraPair>(config, setup)),
      map_({.voxel_m = config.voxel_m,
            .layers = setup.altitude_band ? kLayersOfLevels : kLayers,
            .noise_px = config.noise_px}),
      closed_(config.voxel_m),
      tracker_(tracking(config, pairs_.front().source.geometry())) {}

/// @param z_W  of B.
HeightRange Surroundings::band(double z_W) const {
  return {z_W + hull_.top_m - kLevelM, z_W + hull_.bottom_m + kLevelM};
}

/// Marks the space around a point as free, over the altitude range of the vehicle.
void Surroundings::clear(const Eigen::Vector3d& p_W, double radius_m) {
  const HeightRange tall = band(p_W.z());
  const Eigen::Vector3d middle_W(p_W.x(), p_W.y(), 0.5 * (tall.top_m + tall.bottom_m));
  map_.clear_cylinder(middle_W, radius_m, 0.5 * (tall.bottom_m - tall.top_m));
}

void Surroundings::begin(const NavigationState& navigation) {
  height_W_ = navigation.p_WB_est.z();
  map_.reset(navigation.p_WB_est);
  const double side_m = radius_m_ + config_.voxel_m;
  const HeightRange tall = band(0.0);
  const double high_m = std::max(-tall.top_m, tall.bottom_m) + config_.voxel_m;
  const DisparitySource& source = pairs_.front().source;
  const double focal_px = source.geometry().focal_px;
  const double wide_m = 2.0 * focal_px * side_m / source.image().width;
  const double tall_m = 2.0 * focal_px * high_m / source.image().height;
  blind_m_ = std::max(0.0, source.X_BC().translation().x()) + std::max(wide_m, tall_m);
  const double heading = heading_rad(navigation.q_WB_est);
  const Eigen::Vector3d ahead_W(std::cos(heading), std::sin(heading), 0.0);
  for (double away_m = 0.0; away_m < blind_m_ + config_.voxel_m; away_m += config_.voxel_m) {
    clear(navigation.p_WB_est + away_m * ahead_W, side_m + config_.voxel_m);
  }
}

bool Surroundings::take(std::span<const CameraFrame> frames, const NavigationState& navigation) {
  for (CameraPair& pair : pairs_) pair.fresh = pair.source.update(frames, navigation);
  return std::ranges::any_of(pairs_, &CameraPair::fresh);
}

bool Surroundings::looks_along(double azimuth_rad) const {
  const Eigen::Vector3d along_B(std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0);
  return std::ranges::any_of(pairs_, [&](const CameraPair& pair) {
    const Eigen::Vector3d along_C = pair.source.X_BC().linear().transpose() * along_B;
    const double f = pair.source.geometry().focal_px, z = along_C.z();
    return z > 0.0 && std::abs(f * along_C.x()) <= 0.5 * pair.source.image().width * z &&
           std::abs(f * along_C.y()) <= 0.5 * pair.source.image().height * z;
  });
}

/// Computes the blocks of a disparity image, except for thin lines.
/// @param sigma16  of the disparities; may be empty. @param down_C  unit vector of the vertical.
/// @param height_m  of the camera above level ground.
void Surroundings::build_blocks(CameraPair& pair, const cv::Mat& sigma16, const Eigen::Vector3d& down_C,
                                double height_m) const {
  constexpr double kMinHeightM = 0.5;
  constexpr double kUpright = 0.7;  // minimum z component of the y axis of a camera with ground below and sky above
  const stereo::DisparitySource& source = pair.source;
  pair.blocks.build(source.disparity16(), source.grey(), half_window_px(config_), sigma16);
  if (source.grey().empty() || down_C.y() <= kUpright) return;
  // Depth from motion has another error at every pixel, which planes of the ground ignore.
  const bool is_pair = config_.depth == DisparitySource::From::stereo;
  if (config_.sky) {
    const vision::mapping::GroundPlane ground{source.geometry().disparity16(std::max(height_m, kMinHeightM)) * down_C};
    vision::mapping::find_sky(source.geometry(), down_C, pair.blocks, is_pair ? &ground : nullptr);
  }
  if (is_pair) {
    vision::mapping::find_plain(source.geometry(), down_C, source.disparity16(), source.grey(), pair.blocks);
  }
}

/// Adds an image to the map, except for moving obstacles.
void Surroundings::integrate(CameraPair& pair, OccupancyMap::Instant instant, const NavigationState& navigation,
                             double t_s) {
  constexpr int kSameSegment16 = 32, kSpeckPx = 100;
  constexpr double kMuchUnknown = 0.25;  // share of the image
  stereo::DisparitySource& source = pair.source;
  const Eigen::Isometry3d X_WC = Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * source.X_BC();
  const Eigen::Vector3d down_C = X_WC.linear().row(2).transpose();
  const double height_m = navigation.height_above_ground_m + navigation.p_WB_est.z() - X_WC.translation().z();
  const bool matches = config_.depth != DisparitySource::From::camera;
  if (matches) vision::stereo::remove_specks(source.disparity16(), kSameSegment16, kSpeckPx);
  build_blocks(pair, source.sigma16(), down_C, height_m);
  if (config_.depth == DisparitySource::From::stereo) {
    if (config_.lines) {
      static_assert(vision::stereo::LineMatcher::kCellPx == vision::mapping::DepthBlocks::kBlockPx);
      pair.lines.match(source.grey(), source.right(), source.disparity16(), rows_of_map(source, down_C), pair.lines16);
    }
    if (config_.coarse && pair.blocks.share(DepthBlock::Kind::unknown) > kMuchUnknown &&
        pair.coarse.fill(source.grey(), source.right(), config_.noise_px, source.disparity16(), pair.sigma16) > 0) {
      build_blocks(pair, pair.sigma16, down_C, height_m);
    }
    if (config_.lines) pair.blocks.add_lines(pair.lines16);
  }
  map_.integrate(pair.blocks, source.geometry(), X_WC, predicted_discs(t_s), instant);
  // Depth from motion assumes that the world does not move.
  if (config_.depth != DisparitySource::From::motion) track_moving_obstacles(t_s, pair, X_WC);
}

void Surroundings::see(const NavigationState& navigation, double t_s) {
  Eigen::Vector3d center_W = navigation.p_WB_est;
  center_W.z() = height_W_;
  map_.move(center_W);
  fade(navigation, t_s);
  // The first pair last, because it sees sky, and other pairs may see lines that it cannot match.
  OccupancyMap::Instant instant = OccupancyMap::Instant::next;
  for (CameraPair& pair : pairs_ | std::views::reverse) {
    if (!pair.fresh) continue;
    integrate(pair, instant, navigation, t_s);
    instant = OccupancyMap::Instant::same;
  }
  const double heading = heading_rad(navigation.q_WB_est);
  for (const HullDiscs::Disc& disc : sweep(hull_discs_, heading, heading, config_.voxel_m)) {
    // A vehicle narrower than a voxel clears the voxels that it touches, but not an adjacent wall.
    const double touched_m = disc.radius_m + 0.5 * std::numbers::sqrt2 * config_.voxel_m;
    const double radius_m = std::max(disc.radius_m, std::min(touched_m, config_.voxel_m));
    clear(navigation.p_WB_est + Eigen::Vector3d(disc.p_H.x(), disc.p_H.y(), 0.0), radius_m);
  }
  closed_.update(t_s);
  constexpr double kThereM = 0.2;
  if (from_W_ && std::abs(navigation.p_WB_est.z() - height_W_) < kThereM) from_W_.reset();
  slice_.build(map_, between(from_W_.value_or(height_W_), height_W_), closed_);
  remember_occupied(t_s);
}

/// Stores occupied cells, so that routes lead around a wall that has left the map.
void Surroundings::remember_occupied(double t_s) {
  constexpr double kEveryS = 1.0;
  if (from_W_ || t_s < remembered_s_ + kEveryS) return;
  remembered_s_ = t_s;
  for (int row = 0; row < slice_.side(); ++row) {
    for (int col = 0; col < slice_.side(); ++col) {
      if (slice_.at(row, col) != LevelSlice::State::occupied) continue;
      const Eigen::Vector2d p_W = slice_.center(row, col);
      closed_.remember({p_W.x(), p_W.y(), height_W_}, t_s);
    }
  }
}

HeightRange Surroundings::between(double from_W, double to_W) const {
  const HeightRange from = band(from_W), to = band(to_W);
  return {std::min(from.top_m, to.top_m), std::max(from.bottom_m, to.bottom_m)};
}

bool Surroundings::slice_between(double from_W, double to_W, LevelSlice& slice) const {
  const HeightRange all = between(from_W, to_W);
  const double top_m = config_.voxel_m * map_.first().z();
  if (all.top_m < top_m || all.bottom_m > top_m + config_.voxel_m * map_.size().z()) return false;
  slice.build(map_, all, closed_);
  return true;
}

/// Returns the discs of the moving obstacles, enlarged by a voxel, at their predicted positions.
const std::vector<OccupancyMap::MovingDisc>& Surroundings::predicted_discs(double t_s) {
  discs_.clear();
  for (const MovingObstacle& obstacle : moving_obstacles_) {
    const double wide_m = obstacle.radius_m + obstacle.p_sigma_m + config_.voxel_m;
    discs_.push_back({obstacle.p_W + (t_s - obstacles_at_s_) * obstacle.v_W, wide_m});
  }
  obstacles_at_s_ = t_s;
  return discs_;
}

void Surroundings::track_moving_obstacles(double t_s, const CameraPair& pair, const Eigen::Isometry3d& X_WC) {
  const HeightRange tall = band(height_W_);
  surface_.clear();
  for (const OccupancyMap::Hit& hit : map_.hits()) {
    if (hit.p_W.z() > tall.top_m && hit.p_W.z() < tall.bottom_m) surface_.push_back({hit.p_W.head<2>(), hit.was_free});
  }
  const auto along_W = [&](int u_px) -> Eigen::Vector2d {
    const cv::Point pixel(u_px, static_cast<int>(pair.source.geometry().center_v_px));
    return (X_WC.linear() * pair.source.geometry().ray_at_unit_depth(pixel)).head<2>().normalized();
  };
  tracker_.update(t_s, {X_WC.translation().head<2>(), along_W(0), along_W(pair.source.image().width - 1)}, surface_);
  moving_obstacles_ = tracker_.moving_obstacles();
}

/// Fades space that is out of view at the rate of the position drift: in flight, and at a tenth of it while hovering.
void Surroundings::fade(const NavigationState& navigation, double t_s) {
  constexpr double kFullMps = 1.0, kHoveringShare = 0.1;
  const double share = std::clamp(navigation.v_WB_B_est.norm() / kFullMps, kHoveringShare, 1.0);
  age_s_ += share * (t_s - seen_s_);
  seen_s_ = t_s;
  if (age_s_ < config_.memory_s / kFadeSteps) return;
  age_s_ = 0.0;
  map_.fade();
}

}  // namespace hedgehop::avoidance::local_map
