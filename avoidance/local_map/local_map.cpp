#include "avoidance/local_map/local_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "avoidance/heading.h"
#include "avoidance/local_map/closed_cells.h"
#include "avoidance/local_map/footprint.h"
#include "avoidance/local_map/level_slice.h"
#include "avoidance/local_map/local_map_overlay.h"
#include "avoidance/local_map/movers.h"
#include "avoidance/local_map/route_field.h"
#include "avoidance/local_map/stop_planner.h"
#include "avoidance/local_map/velocity_obstacles.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"
#include "vision/mapping/depth_blocks.h"
#include "vision/mapping/occupancy_map.h"

namespace hedgehop::avoidance::local_map {
namespace {

using stereo::DisparitySource;
using vision::mapping::DepthBlock;

constexpr double kFadeSteps = 5.0;  // steps that free space is from unknown, at most
constexpr double kHeightM = 0.3;    // above and below the vehicle's own height: altitude is held to this
constexpr double kAheadM = 4.0;     // along the route, to which the nose points
constexpr double kStandsMps = 0.3, kHoversMps = 0.05;

class LocalMap final : public Module {
 public:
  explicit LocalMap(const LocalMapConfig& config)
      : config_(config), map_({.voxel_m = fields::require_bounds(config).voxel_m, .noise_px = config.noise_px}) {}

 private:
  Needs do_needs() const override { return DisparitySource::needs(config_.depth, DisparitySource::Grey::unused); }
  std::vector<Signal> do_signals() const override {
    return {{"route_m", "m"},  {"stop_m", "m"},       {"unknown_share", ""},
            {"sky_share", ""}, {"closed_places", ""}, {"movers", ""}};
  }

  void do_reset(const Setup& setup) override {
    source_.emplace(config_.depth, DisparitySource::Grey::unused, config_.stereo, setup);
    const VehicleLimits& limits = setup.limits;
    constexpr double kHalfHeightM = 0.2;  // of a vehicle whose outline nobody gave
    hull_ = {-kHalfHeightM, kHalfHeightM};
    for (const Eigen::AlignedBox3d& part_B : limits.outline_B) {
      hull_.top_m = std::min(hull_.top_m, part_B.min().z());
      hull_.bottom_m = std::max(hull_.bottom_m, part_B.max().z());
    }
    clearance_ = {limits.radius_m, config_.margin_m, config_.margin_time_s};
    outline_ = Outline(limits);
    footprint_ = Footprint(outline_, clearance_, config_.voxel_m);
    const double acceleration = limits.acceleration_mps2;
    planner_.emplace(Response{.delay_s = config_.delay_s,
                              .acceleration_mps2 = acceleration,
                              .braking_mps2 = config_.braking_share * acceleration},
                     std::min(config_.speed_mps, limits.speed_mps));
    const vision::stereo::StereoGeometry& geometry = source_->geometry();
    tracker_.emplace(Movers::Config{.sigma_per_m2 = config_.noise_px / (geometry.focal_px * geometry.baseline_m),
                                    .spacing_m = config_.voxel_m});
    movers_.clear();
    closed_.reset();
    last_.reset();
    last_cmd_W_.setZero();
    stares_since_s_.reset();
    age_s_ = seen_s_ = 0.0;
    stops_ = stuck_ = decisions_ = 0;
  }

  Decision do_update(const Observation& observation) override {
    if (!source_->update(observation.frames)) {
      if (last_) return *last_;
      return {HoverCommand{}, "wait", std::vector<double>(6, std::nan(""))};
    }
    const NavigationState& navigation = observation.navigation;
    const double t_s = seconds(observation.t_ns);
    if (!last_) begin(navigation);
    see(navigation, t_s);
    const Decision decision = decide(observation, t_s);
    last_ = decision;
    ++decisions_;
    return decision;
  }

  /// @param z_W  of B.
  Band band(double z_W) const { return {z_W + hull_.top_m - kHeightM, z_W + hull_.bottom_m + kHeightM}; }

  /// Marks space around a point as free, as high as the vehicle's band.
  void clear(const Eigen::Vector3d& p_W, double radius_m) {
    const Band tall = band(p_W.z());
    const Eigen::Vector3d middle_W(p_W.x(), p_W.y(), 0.5 * (tall.top_m + tall.bottom_m));
    map_.clear_cylinder(middle_W, radius_m, 0.5 * (tall.bottom_m - tall.top_m));
  }

  /// Where the flight begins, the vehicle was put or took off: free up to where the camera sees all that it will fly
  /// through, its width and its height.
  void begin(const NavigationState& navigation) {
    height_W_ = navigation.p_WB_est.z();
    last_nose_rad_ = heading_rad(navigation.q_WB_est);
    map_.reset(navigation.p_WB_est);
    const double side_m = clearance_.hull_m + config_.voxel_m;
    const Band tall = band(0.0);
    const double high_m = std::max(-tall.top_m, tall.bottom_m) + config_.voxel_m;
    const double focal_px = source_->geometry().focal_px;
    const double wide_m = 2.0 * focal_px * side_m / source_->image().width;
    const double tall_m = 2.0 * focal_px * high_m / source_->image().height;
    blind_m_ = std::max(0.0, source_->X_BC().translation().x()) + std::max(wide_m, tall_m);
    clear(navigation.p_WB_est, std::hypot(side_m, blind_m_));
  }

  void see(const NavigationState& navigation, double t_s) {
    constexpr int kSameSegment16 = 32, kSpeckPx = 100;
    const Eigen::Isometry3d X_WC = Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * source_->X_BC();
    if (config_.depth == DisparitySource::From::stereo) {
      vision::stereo::remove_specks(source_->disparity16(), kSameSegment16, kSpeckPx);
    }
    blocks_.build(source_->disparity16(), source_->grey());
    if (config_.sky && !source_->grey().empty()) {
      vision::mapping::find_sky(source_->geometry(), X_WC.linear().row(2).transpose(), blocks_);
    }
    Eigen::Vector3d center_W = navigation.p_WB_est;
    center_W.z() = height_W_;
    map_.move(center_W);
    fade(navigation, t_s);
    map_.integrate(blocks_, source_->geometry(), X_WC, where_movers_are(t_s));
    const double heading = heading_rad(navigation.q_WB_est);
    for (const Outline::Disc& disc : sweep(outline_, heading, heading, config_.voxel_m)) {
      clear(navigation.p_WB_est + Eigen::Vector3d(disc.p_H.x(), disc.p_H.y(), 0.0), disc.radius_m);
    }
    closed_.update(t_s);
    follow_movers(t_s, X_WC);
    slice_.build(map_, band(height_W_), closed_);
  }

  /// The movers' discs, a voxel wider, where they should be by now.
  const std::vector<vision::mapping::OccupancyMap::Disc>& where_movers_are(double t_s) {
    discs_.clear();
    for (const Mover& mover : movers_) {
      const double wide_m = mover.radius_m + mover.p_sigma_m + config_.voxel_m;
      discs_.push_back({mover.p_W + (t_s - movers_at_s_) * mover.v_W, wide_m});
    }
    movers_at_s_ = t_s;
    return discs_;
  }

  void follow_movers(double t_s, const Eigen::Isometry3d& X_WC) {
    const Band tall = band(height_W_);
    surface_.clear();
    for (const vision::mapping::OccupancyMap::Hit& hit : map_.hits()) {
      if (hit.p_W.z() > tall.top_m && hit.p_W.z() < tall.bottom_m)
        surface_.push_back({hit.p_W.head<2>(), hit.was_free});
    }
    const auto along_W = [&](int u_px) -> Eigen::Vector2d {
      const cv::Point pixel(u_px, static_cast<int>(source_->geometry().center_v_px));
      return (X_WC.linear() * source_->geometry().ray(pixel)).head<2>().normalized();
    };
    tracker_->update(t_s, {X_WC.translation().head<2>(), along_W(0), along_W(source_->image().width - 1)}, surface_);
    movers_ = tracker_->movers();
  }

  /// What is out of view is forgotten as fast as the position drifts: in flight, and a tenth as fast hovering.
  void fade(const NavigationState& navigation, double t_s) {
    constexpr double kFullMps = 1.0, kHoveringShare = 0.1;
    const double share = std::clamp(navigation.v_WB_B_est.norm() / kFullMps, kHoveringShare, 1.0);
    age_s_ += share * (t_s - seen_s_);
    seen_s_ = t_s;
    if (age_s_ < config_.memory_s / kFadeSteps) return;
    age_s_ = 0.0;
    map_.fade();
  }

  Fault fault(const Moment& moment, bool unknown_too) const { return footprint_.fault(slice_, moment, unknown_too); }

  Decision decide(const Observation& observation, double t_s) {
    const NavigationState& navigation = observation.navigation;
    const Eigen::Vector2d p_W = navigation.p_WB_est.head<2>(), goal_W = observation.goal.p_WG.head<2>();
    const Moment now{t_s, p_W, (navigation.q_WB_est * navigation.v_WB_B_est).head<2>()};
    // Half a cell more than what a plan must keep: a route cuts the corners of cells.
    route_.build(slice_, clearance_.hull_m + clearance_.margin_m + 0.5 * slice_.cell_m(), goal_W,
                 [&](const Eigen::Vector2d& edge_W) { return (goal_W - edge_W).norm(); });
    const auto to_goal_m = [&](const Eigen::Vector2d& at_W) { return route_.to_goal_m(at_W); };
    const auto threat = [&](const std::vector<Moment>& path) { return threat_m(path, movers_, clearance_, t_s); };
    const double heading = heading_rad(navigation.q_WB_est);
    footprint_.turn(heading, last_nose_rad_);
    plan_ = planner_->choose(
        now, last_cmd_W_, [&](const Moment& m) { return fault(m, true); }, threat, to_goal_m);
    const StopPlanner::Plan hoped = planner_->choose(
        now, last_cmd_W_, [&](const Moment& m) { return fault(m, false); }, threat, to_goal_m);

    const std::optional<double> route_m = to_goal_m(p_W);
    const Eigen::Vector2d p_BG_W = goal_W - p_W;
    constexpr double kArrivedM = 0.5, kHeldBack = 0.6;
    const bool arrived = p_BG_W.norm() < kArrivedM;
    const bool held = !arrived && route_m && plan_.worth_m < kHeldBack * hoped.worth_m;
    if (!held) look_W_.reset();
    if (held && !(look_W_ && is_unknown(*look_W_))) look_W_ = unknown_in_the_way(hoped.path);
    if (look_W_ && now.v_W.norm() < kStandsMps) back_off(now);
    stare(now, heading, plan_, t_s);
    const double nose = nose_rad(observation, arrived, route_m.has_value());
    last_nose_rad_ = footprint_.turn_as_far_as_free_rad(slice_, plan_.path, heading, nose);
    if (last_nose_rad_ != nose && plan_.v_cmd_W.norm() < kHoversMps) make_room(now, heading, nose);

    Decision decision;
    VelocityCommand command;
    command.v_WB_W = plan_.v_cmd_W;
    command.altitude_m = -height_W_;
    command.heading_rad = last_nose_rad_;
    decision.command = command;
    decision.status = arrived ? "arrive" : !plan_.safe ? "brake" : !route_m ? "stuck" : look_W_ ? "look" : "cruise";
    stuck_ += !route_m;
    stops_ += !plan_.safe;
    decision.signals = {route_m.value_or(std::nan("")),
                        (plan_.path.back().p_W - p_W).norm(),
                        blocks_.share(DepthBlock::Kind::unknown),
                        blocks_.share(DepthBlock::Kind::sky),
                        static_cast<double>(closed_.places().size()),
                        static_cast<double>(movers_.size())};
    last_cmd_W_ = plan_.v_cmd_W;
    return decision;
  }

  /// Moves away from what it cannot see because it is too near, below or beside the image: where it came from is free.
  void back_off(const Moment& now) {
    const Eigen::Vector2d look_W = *look_W_;
    const auto too_near_m = [&](const Eigen::Vector2d& p_W) { return std::max(0.0, blind_m_ - (p_W - look_W).norm()); };
    escape(now, too_near_m);
  }

  /// Moves to where it may turn.
  void make_room(const Moment& now, double from_rad, double to_rad) {
    Footprint turned = footprint_;
    turned.turn(from_rad, to_rad);
    escape(now, [&](const Eigen::Vector2d& p_W) {
      const Fault fault = turned.fault(slice_, {now.t_s, p_W, Eigen::Vector2d::Zero()}, true);
      return std::max(fault.occupied_m, fault.unknown_m);
    });
  }

  /// Plans to where something is less, instead of to the goal.
  template <class Lacks>
  void escape(const Moment& now, const Lacks& lacks_m) {
    if (lacks_m(now.p_W) == 0.0) return;
    const auto threat = [&](const std::vector<Moment>& path) { return threat_m(path, movers_, clearance_, now.t_s); };
    plan_ = planner_->choose(
        now, last_cmd_W_, [&](const Moment& m) { return fault(m, true); }, threat, lacks_m);
  }

  bool is_unknown(const Eigen::Vector2d& p_W) const {
    const Eigen::Vector2i cell = slice_.cell(p_W);
    return slice_.contains(cell.x(), cell.y()) && slice_.at(cell.x(), cell.y()) == LevelSlice::State::unknown;
  }

  /// The unknown cell nearest to where a path that ignores the unknown first comes too near to one.
  std::optional<Eigen::Vector2d> unknown_in_the_way(const std::vector<Moment>& path) const {
    const auto first = std::ranges::find_if(path, [&](const Moment& m) { return fault(m, true).unknown_m > 0.0; });
    if (first == path.end()) return std::nullopt;
    std::optional<Eigen::Vector2d> nearest;
    const Eigen::Vector2i here = slice_.cell(first->p_W);
    const int reach = static_cast<int>(std::ceil(clearance_.hull_m / slice_.cell_m())) + 2;
    for (int row = here.x() - reach; row <= here.x() + reach; ++row) {
      for (int col = here.y() - reach; col <= here.y() + reach; ++col) {
        if (!slice_.contains(row, col) || slice_.at(row, col) != LevelSlice::State::unknown) continue;
        const Eigen::Vector2d center_W = slice_.center(row, col);
        if (nearest && (center_W - first->p_W).norm() >= (*nearest - first->p_W).norm()) continue;
        nearest = center_W;
      }
    }
    return nearest;
  }

  /// Closes what stays unknown while the vehicle stands and looks at it.
  void stare(const Moment& now, double heading, const StopPlanner::Plan& plan, double t_s) {
    constexpr double kAimedRad = 0.35, kRadiusM = 1.0;
    const bool stands = now.v_W.norm() < kStandsMps && plan.v_cmd_W.norm() < kStandsMps;
    const auto aimed = [&] {
      const Eigen::Vector2d off_W = *look_W_ - now.p_W;
      return std::abs(std::remainder(std::atan2(off_W.y(), off_W.x()) - heading, 2.0 * M_PI)) < kAimedRad;
    };
    if (!look_W_ || !stands || !aimed()) {
      stares_since_s_.reset();
      return;
    }
    if (!stares_since_s_) stares_since_s_ = t_s;
    if (t_s - *stares_since_s_ < config_.stare_s) return;
    // Not what touches the vehicle, which would then not dare to move away.
    const double away_m = (*look_W_ - now.p_W).norm() - clearance_.hull_m - clearance_.margin_m - slice_.cell_m();
    closed_.close(*look_W_, std::clamp(away_m, 0.5 * slice_.cell_m(), kRadiusM), t_s);
    stares_since_s_.reset();
  }

  double nose_rad(const Observation& observation, bool arrived, bool has_route) const {
    const NavigationState& navigation = observation.navigation;
    const double heading = heading_rad(navigation.q_WB_est);
    const Eigen::Vector2d p_W = navigation.p_WB_est.head<2>();
    const auto towards = [&](const Eigen::Vector2d& there_W) {
      const Eigen::Vector2d off_W = there_W - p_W;
      return off_W.norm() > 0.1 ? std::atan2(off_W.y(), off_W.x()) : heading;
    };
    if (arrived) return observation.goal.heading_rad;
    if (!has_route) return heading + 0.5;  // looks round: what blocks may have been wrong, or gone
    if (look_W_) return towards(*look_W_);
    return towards(route_.route_W(p_W, kAheadM).back());
  }

  std::vector<Metric> do_metrics() const override {
    const double n = std::max<double>(1.0, static_cast<double>(decisions_));
    return {{"brake_share", static_cast<double>(stops_) / n, ""}, {"stuck_share", static_cast<double>(stuck_) / n, ""}};
  }

  cv::Mat do_annotate() const override {
    if (!last_) return {};
    return draw(
        {slice_, plan_.path, route_.route_W(plan_.path.front().p_W, 30.0), look_W_, clearance_.hull_m, last_->status});
  }

  LocalMapConfig config_;
  std::optional<DisparitySource> source_;
  vision::mapping::DepthBlocks blocks_;
  vision::mapping::OccupancyMap map_;
  LevelSlice slice_;
  RouteField route_;
  std::optional<StopPlanner> planner_;
  StopPlanner::Plan plan_;
  ClosedCells closed_;
  std::optional<Movers> tracker_;
  std::vector<SurfacePoint> surface_;  ///< of the last image, at the heights that are flown through
  std::vector<Mover> movers_;
  double movers_at_s_ = 0.0;
  std::vector<vision::mapping::OccupancyMap::Disc> discs_;
  Clearance clearance_;
  Outline outline_;
  Footprint footprint_;
  double last_nose_rad_ = 0.0;  ///< commanded
  Band hull_;                   ///< heights of the hull's top and bottom, from B
  double blind_m_ = 0.0;        ///< from B, within which the images do not show all that the vehicle will fly through
  double height_W_ = 0.0;       ///< z that is flown at
  Eigen::Vector2d last_cmd_W_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> look_W_;  ///< what is unknown and in the way
  std::optional<double> stares_since_s_;
  double age_s_ = 0.0, seen_s_ = 0.0;  ///< of the map since it faded last, and when the last image came
  std::optional<Decision> last_;
  int64_t stops_ = 0, stuck_ = 0, decisions_ = 0;
};

}  // namespace

std::unique_ptr<Module> make_local_map(const LocalMapConfig& config) { return std::make_unique<LocalMap>(config); }

}  // namespace hedgehop::avoidance::local_map
