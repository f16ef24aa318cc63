#include "avoidance/local_map/local_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "avoidance/dead_reckoning.h"
#include "avoidance/heading.h"
#include "avoidance/local_map/altitude_levels.h"
#include "avoidance/local_map/hull_clearance.h"
#include "avoidance/local_map/kept_margin.h"
#include "avoidance/local_map/local_map_overlay.h"
#include "avoidance/local_map/nose_in_view.h"
#include "avoidance/local_map/route_field.h"
#include "avoidance/local_map/status_count.h"
#include "avoidance/local_map/stop_planner.h"
#include "avoidance/local_map/surroundings.h"
#include "avoidance/local_map/unknown_target.h"
#include "avoidance/local_map/weave.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::local_map {
namespace {

using vision::mapping::DepthBlock;

constexpr double kAheadM = 4.0;  // distance along the route to which the nose points
constexpr double kHoversMps = 0.05;
constexpr double kLittleM = 0.5;  // progress that does not justify tilting the camera
// Near ground moves too fast through the image to be measured, so the speed is proportional to height, as for bees:
// [Srinivasan1996] sec. on flight speed.
constexpr double kGroundRadps = 2.0, kMinHeightM = 0.5;
constexpr double kMinMarginM = 0.05;  // around the hull in narrow passages

class LocalMap final : public Module {
 public:
  explicit LocalMap(const LocalMapConfig& config) : config_(fields::require_bounds(config)) {}

 private:
  Needs do_needs() const override { return Surroundings::needs(config_); }
  std::vector<Signal> do_signals() const override {
    return {{"route_m", "m"},  {"stop_m", "m"},      {"unknown_share", ""},
            {"sky_share", ""}, {"closed_cells", ""}, {"movers", ""}};
  }

  void do_reset(const Setup& setup) override {
    const VehicleLimits& limits = setup.limits;
    kept_margin_ = {config_.margin_m, config_.voxel_m};
    clearance_ = {limits.radius_m, kept_margin_.planned_m(), config_.margin_time_s};
    hull_discs_ = HullDiscs(limits);
    // An obstacle may extend into a free voxel, so vehicles narrower than a voxel keep that distance.
    const double wide_m = clearance_.hull_m + kept_margin_.passing_m();
    route_clearance_ = {wide_m, std::min(wide_m, std::max(clearance_.hull_m + kMinMarginM, config_.voxel_m)),
                        kept_margin_.is_kept() ? RouteClearance::Detours::long_ones : RouteClearance::Detours::usual};
    altitude_levels_ = AltitudeLevels(setup.altitude_band, route_clearance_);
    learned_ = {};
    around_.emplace(config_, setup, hull_discs_);
    dead_reckoning_ = {};
    hull_clearance_ = HullClearance(hull_discs_, clearance_, config_.voxel_m);
    const double acceleration = limits.acceleration_mps2;
    response_ = {.delay_s = config_.delay_s,
                 .acceleration_mps2 = acceleration,
                 .braking_mps2 = config_.braking_share * acceleration};
    max_mps_ = std::min(config_.speed_mps, limits.speed_mps);
    last_.reset();
    last_cmd_W_.setZero();
    unknown_target_ = {};
    progress_.reset();
    waits_.reset();
    weave_ = {};
    statuses_ = {};
  }

  Decision do_update(const Observation& observation) override {
    const double t_s = seconds(observation.t_ns);
    Observation reckoned = observation;
    reckoned.navigation = dead_reckoning_.update(observation.navigation, t_s);
    reckoned.goal.p_WG += reckoned.navigation.p_WB_est - observation.navigation.p_WB_est;
    if (!around_->take(observation.frames, observation.navigation)) {
      if (last_) return *last_;
      return {HoverCommand{}, "wait", std::vector<double>(6, std::nan(""))};
    }
    if (!last_) {
      around_->begin(reckoned.navigation);
      altitude_levels_.begin(around_->height_W());
      last_nose_rad_ = heading_rad(reckoned.navigation.q_WB_est);
    }
    around_->see(reckoned.navigation, t_s);
    last_ = decide(reckoned, observation.goal.p_WG, t_s);
    return *last_;
  }

  const LevelSlice& slice() const { return around_->slice(); }

  /// Plans a path to the minimum of a function, clear of obstacles and, unless disabled, of unknown space.
  StopPlanner::Plan plan_to(const PathState& now, const StopPlanner::ToGoal& least_m, bool unknown_too = true) const {
    return planner_.choose(
        now, last_cmd_W_, [&](const PathState& m) { return hull_clearance_.deficit(slice(), m, unknown_too); },
        [&](const std::vector<PathState>& path) {
          return threat_m(path, around_->moving_obstacles(), clearance_, now.t_s);
        },
        least_m);
  }

  /// @param mission_W  goal of the mission.
  Decision decide(const Observation& observation, const Eigen::Vector3d& mission_W, double t_s) {
    const NavigationState& navigation = observation.navigation;
    const Eigen::Vector2d p_W = navigation.p_WB_est.head<2>(), goal_W = observation.goal.p_WG.head<2>();
    const PathState now{t_s, p_W, (navigation.q_WB_est * navigation.v_WB_B_est).head<2>()};
    const double heading = heading_rad(navigation.q_WB_est);
    route_clearance_.detours = kept_margin_.detours(p_W, mission_W.head<2>(), t_s);
    route_.build(slice(), route_clearance_, goal_W, learned_.beyond_m(goal_W, around_->height_W()));
    hull_clearance_.set_turn(heading, last_nose_rad_);
    set_pace(now, heading, std::max(navigation.height_above_ground_m, kMinHeightM));
    if (!around_->changes_height()) {
      learned_.learn(route_, slice(), {p_W.x(), p_W.y(), around_->height_W()}, mission_W);
    }
    const auto to_goal_m = [&](const Eigen::Vector2d& at_W) { return route_.to_goal_m(at_W); };
    plan_ = plan_to(now, to_goal_m);
    const StopPlanner::Plan hoped = plan_to(now, to_goal_m, /*unknown_too=*/false);

    const std::optional<double> route_m = to_goal_m(p_W);
    const Eigen::Vector2d p_BG_W = goal_W - p_W;
    constexpr double kArrivedM = 0.5, kHeldBack = 0.6;
    const bool arrived = p_BG_W.norm() < kArrivedM;
    const bool held = !arrived && route_m && plan_.progress_m < kHeldBack * hoped.progress_m;
    unknown_target_.update(held, hoped.path, slice(), hull_clearance_,
                           clearance_.hull_m + kept_margin_.from_unknown_m(), now, heading);
    look(now, heading, route_m);
    if (config_.depth == stereo::DisparitySource::From::motion && !arrived) weave(now, heading);
    const bool goes_on = route_m && !(waits(now) && !unknown_target_.place_W() && !arrived);
    const double nose = nose_in_view(now, nose_rad(observation, arrived, goes_on),
                                     nearest_approaching(now, around_->moving_obstacles(), clearance_.hull_m),
                                     around_->half_view_rad(), unknown_target_.place_W().has_value());
    last_nose_rad_ = hull_clearance_.free_turn_rad(slice(), plan_.path, heading, nose);
    if (last_nose_rad_ != nose && plan_.v_cmd_W.norm() < kHoversMps) make_room(now, heading, nose);
    change_level(observation.goal.p_WG, p_W, t_s);
    Decision decision;
    VelocityCommand command;
    command.v_WB_W = plan_.v_cmd_W;
    command.altitude_m = -around_->height_W();
    command.heading_rad = last_nose_rad_;
    decision.command = command;
    const double margin_m = slice().to_occupied_m(p_W) - clearance_.hull_m;
    decision.status = statuses_.add({.arrived = arrived,
                                     .safe = plan_.safe,
                                     .changes_height = around_->changes_height(),
                                     .goes_on = goes_on,
                                     .looks = unknown_target_.place_W().has_value()},
                                    kept_margin_, margin_m);
    kept_margin_.count(margin_m);
    decision.signals = {route_m.value_or(std::nan("")),
                        (plan_.path.back().p_W - p_W).norm(),
                        around_->blocks().share(DepthBlock::Kind::unknown),
                        around_->blocks().share(DepthBlock::Kind::sky),
                        static_cast<double>(around_->closed_cells()),
                        static_cast<double>(around_->moving_obstacles().size())};
    last_cmd_W_ = plan_.v_cmd_W;
    return decision;
  }

  /// In passages that are too narrow for the margin even at walking pace, flies at walking pace with a reduced margin.
  void set_pace(const PathState& now, double heading, double height_m) {
    constexpr double kWalkMps = 1.0, kHardlyFasterMps = 1.5, kSoonM = 1.5, kEndless = HUGE_VAL;
    const double wide_m = clearance_.hull_m + clearance_.margin_m + clearance_.margin_s * kWalkMps;
    const double nearest_m = now.v_W.norm() < kHardlyFasterMps ? route_.nearest_m(now.p_W, kSoonM) : kEndless;
    const bool walks = nearest_m < wide_m;
    hull_clearance_.set_clearance(
        walks ? kept_margin_.walking(clearance_, route_clearance_, slice(), now.p_W, nearest_m) : clearance_);
    if (!walks) kept_margin_.widen();
    hull_clearance_.keep_from_unknown(slice(), now.p_W, kept_margin_.from_unknown_m(), around_->half_view_rad());
    planner_ = StopPlanner(response_, std::min({max_mps_, kGroundRadps * height_m, walks ? kWalkMps : max_mps_}),
                           [this, heading](double azimuth_rad) { return around_->looks_along(azimuth_rad - heading); });
  }

  /// Climbs or descends if the mission allows it, a better way exists at another level, and the planned stop is clear
  /// of all space between.
  void change_level(const Eigen::Vector3d& goal_W, const Eigen::Vector2d& p_W, double t_s) {
    const auto may_pass = [&](const LevelSlice& between) {
      return plan_.safe && std::ranges::all_of(plan_.path, [&](const PathState& state) {
               const ClearanceDeficit there = hull_clearance_.deficit(between, state, true);
               return there.occupied_m <= 0.0 && there.unknown_m <= 0.0;
             });
    };
    const auto z_W = altitude_levels_.next_W(t_s, *around_, learned_, p_W, goal_W, may_pass);
    if (z_W) around_->change_height(*z_W);
  }

  /// Plans a path from which the blocking unknown position is visible. Closes the position if it stays unknown while
  /// the vehicle hovers and points at it, or after observation from several positions without progress.
  void look(const PathState& now, double heading, std::optional<double> route_m) {
    constexpr double kStares = 4.0;
    const bool in_vain = progress_.stalled_s(route_m, now.t_s) > kStares * config_.stare_s;
    const std::optional<Eigen::Vector2d>& place_W = unknown_target_.place_W();
    // Acceleration tilts the camera away from the position: not worthwhile for little progress.
    if (place_W && plan_.safe && plan_.progress_m < kLittleM) {
      plan_ = plan_to(now, [&](const Eigen::Vector2d& at_W) { return (at_W - now.p_W).norm(); });
    }
    // Back away from a position that is too near to be in view. The space behind on the flown path is free.
    if (unknown_target_.backs_off()) {
      escape(now,
             [&](const Eigen::Vector2d& p_W) { return std::max(0.0, around_->blind_m() - (p_W - *place_W).norm()); });
    }
    const std::optional<double> inspected_s = unknown_target_.inspected_s(now, plan_.v_cmd_W, heading);
    if (!place_W || !(in_vain || (inspected_s && *inspected_s >= config_.stare_s))) return;
    // Do not close cells that touch the vehicle, which could then not move away.
    constexpr double kRadiusM = 1.0;
    const double away_m = (*place_W - now.p_W).norm() - clearance_.hull_m - clearance_.margin_m - slice().cell_m();
    around_->close(*place_W, std::clamp(away_m, 0.5 * slice().cell_m(), kRadiusM), now.t_s);
    unknown_target_.restart_timer();
    progress_.reset();
  }

  /// Replaces a hover by a slow flight to the left and right.
  void weave(const PathState& now, double heading) {
    if (!plan_.safe || plan_.v_cmd_W.norm() > kHoversMps) return;
    const Eigen::Vector2d end_W = weave_.target_W(now, heading);
    plan_ = plan_to(now, [&](const Eigen::Vector2d& at_W) { return (at_W - end_W).norm(); });
  }

  /// Moves to a position at which the turn is free.
  void make_room(const PathState& now, double from_rad, double to_rad) {
    HullClearance turned = hull_clearance_;
    turned.set_turn(from_rad, to_rad);
    escape(now, [&](const Eigen::Vector2d& p_W) {
      const ClearanceDeficit deficit = turned.deficit(slice(), {now.t_s, p_W, Eigen::Vector2d::Zero()}, true);
      return std::max(deficit.occupied_m, deficit.unknown_m);
    });
  }

  /// Plans a path that reduces a violation instead of one to the goal; holds the position if there is no violation.
  template <class Lacks>
  void escape(const PathState& now, const Lacks& lacks_m) {
    if (lacks_m(now.p_W) > 0.0 || lacks_m(plan_.path.back().p_W) > 0.0) plan_ = plan_to(now, lacks_m);
  }

  /// Returns whether the vehicle has hovered for longer than the observation time.
  bool waits(const PathState& now) {
    const std::optional<double> for_s =
        waits_.update(is_hovering(now.v_W) && plan_.v_cmd_W.norm() <= kHoversMps, now.t_s);
    return for_s && *for_s > config_.stare_s;
  }

  double nose_rad(const Observation& observation, bool arrived, bool goes_on) const {
    const double heading = heading_rad(observation.navigation.q_WB_est);
    const Eigen::Vector2d p_W = observation.navigation.p_WB_est.head<2>();
    if (arrived) return observation.goal.heading_rad;
    if (!goes_on) return heading + 0.5;  // turns: the obstacle may have been an error, or may have left
    return azimuth_rad(p_W, unknown_target_.place_W().value_or(route_.route_W(p_W, kAheadM).back()), heading);
  }

  std::vector<Metric> do_metrics() const override { return statuses_.metrics(kept_margin_); }

  cv::Mat do_annotate() const override {
    if (!last_) return {};
    return draw({slice(), plan_.path, route_.route_W(plan_.path.front().p_W, 30.0), unknown_target_.place_W(),
                 around_->moving_obstacles(), clearance_.hull_m, last_->status});
  }

  LocalMapConfig config_;
  RouteField route_;
  Response response_;
  double max_mps_ = 0.0;  ///< minimum of the limits of the vehicle and of the config
  StopPlanner planner_{Response{}, 0.0};
  StopPlanner::Plan plan_;
  Clearance clearance_;
  RouteClearance route_clearance_;
  KeptMargin kept_margin_;
  HullDiscs hull_discs_;
  HullClearance hull_clearance_;
  DeadReckoning dead_reckoning_;  ///< source of all positions in this class
  std::optional<Surroundings> around_;
  AltitudeLevels altitude_levels_;
  LearnedDistances learned_;
  double last_nose_rad_ = 0.0;  ///< commanded
  Eigen::Vector2d last_cmd_W_ = Eigen::Vector2d::Zero();
  UnknownTarget unknown_target_;
  ProgressTimer progress_;
  ConditionTimer waits_;
  Weave weave_;  ///< for depth from motion
  std::optional<Decision> last_;
  StatusCount statuses_;
};

}  // namespace

std::unique_ptr<Module> make_local_map(const LocalMapConfig& config) { return std::make_unique<LocalMap>(config); }

}  // namespace hedgehop::avoidance::local_map
