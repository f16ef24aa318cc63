#include "avoidance/stereo_corridor/stereo_corridor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "avoidance/heading.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "avoidance/stereo_corridor/climb.h"
#include "avoidance/stereo_corridor/corridor_search.h"
#include "avoidance/stereo_corridor/flight_path.h"
#include "avoidance/stereo_corridor/goal_seeking.h"
#include "avoidance/stereo_corridor/retreat.h"
#include "avoidance/stereo_corridor/stopping_speed.h"
#include "avoidance/stereo_corridor/target_overlay.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

using stereo::DisparitySource;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kLookRound = "look_round";  ///< [Andert2007] sec. 4.3.4, step 5
/// Distance from obstacles at the end of a stop and in a hover, m: the position estimate may drift by it in 6 s.
constexpr double kStandoffM = 1.5;

class StereoCorridor final : public Module {
 public:
  explicit StereoCorridor(const StereoCorridorConfig& config) : config_(with_additions(config)) {
    fields::require_bounds(config);
  }

 private:
  static StereoCorridorConfig with_additions(StereoCorridorConfig config) {
    if (config.law == Law::published) config.additions = {false, false, false};
    return config;
  }

  bool follows_path() const { return config_.law == Law::published && config_.follow_path; }

  Needs do_needs() const override {
    Needs needs = DisparitySource::needs(config_.depth, DisparitySource::Grey::needed);
    needs.commands = {CommandType::velocity, CommandType::position};
    return needs;
  }
  std::vector<Signal> do_signals() const override {
    return {{"target_u_px", "px"},
            {"target_v_px", "px"},
            {"free_depth_m", "m"},
            {"corridor_tests", ""},
            {"valid_share", ""}};
  }

  void do_reset(const Setup& setup) override {
    source_.emplace(config_.depth, DisparitySource::Grey::needed, config_.stereo, setup);
    tracker_ = {};
    stereo::PassedObstaclesConfig passed;
    if (!config_.additions.memory) passed.radius_m = 0.0;
    passed_.emplace(passed);
    climb_ = {config_.climb_rate_mps, setup.limits.acceleration_mps2};
    hull_ahead_m_ = std::max(0.0, setup.limits.radius_m - source_->X_BC().translation().x());
    target_.reset();
    last_.reset();
    first_t_ns_ = last_t_ns_ = -1;
    images_ = tracked_ = 0;
    all_tests_ = 0.0;
    hover_s_ = 0.0;
    turn_ = 1.0;
    turn_back_ = {};
    retreat_ = Retreat(kStandoffM);
    path_ = {};
  }

  Decision do_update(const Observation& observation) override {
    if (!source_->update(observation.frames) && last_) return *last_;
    cv::Mat& disparity16 = source_->disparity16();
    if (disparity16.empty()) return {HoverCommand{}, "wait", std::vector<double>(5, kUnknown)};
    improve(disparity16);
    if (config_.law == Law::modified && config_.unknown == Unknown::blocked) block_unknown(disparity16);
    pyramid_.build(disparity16, CorridorSearch::kCoarsestLevel);
    const NavigationState& navigation = observation.navigation;
    const Eigen::Isometry3d X_WC = Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * source_->X_BC();
    R_WC_ = X_WC.linear();
    level_mps_ = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>().norm();
    passed_->update(observation.t_ns, pyramid_, source_->geometry(), X_WC);
    const auto retreat_W = retreat_.update(navigation.p_WB_est, passed_->nearest_m() - hull_ahead_m_);

    const Eigen::Vector3d aim_W =
        follows_path() ? path_.ahead_W(navigation.p_WB_est, observation.goal.p_WG) : observation.goal.p_WG;
    const Eigen::Vector3d aim_C = X_WC.inverse() * aim_W;
    const bool arrives = arrives_at(observation.goal.p_WG - navigation.p_WB_est);
    const bool turns_back = config_.additions.goal_first && !arrives && turn_back_.update(aim_C, navigation.p_WB_est);
    const int tests = aim(navigation, aim_C, turns_back);
    count(observation.t_ns, tests);

    Decision decision;
    decision.command = steer(observation);
    decision.status = turns_back ? "turn_back" : target_ ? name_of(target_->found_by) : kLookRound;
    if (config_.additions.goal_first && !target_ && retreat_W) {
      decision = {PositionCommand{*retreat_W, heading_rad(navigation.q_WB_est)}, "retreat", {}};
    }
    if (arrives) {
      decision = {PositionCommand{observation.goal.p_WG, heading_rad(navigation.q_WB_est)}, "arrive", {}};
    }
    const double valid = cv::countNonZero(disparity16 >= 0) / static_cast<double>(disparity16.total());
    decision.signals = {target_ ? target_->pixel.x : kUnknown, target_ ? target_->pixel.y : kUnknown,
                        target_ && std::isfinite(target_->z_m) ? target_->z_m : kUnknown, static_cast<double>(tests),
                        valid};
    last_ = decision;
    return decision;
  }

  /// Whether the goal is so near that the vehicle changes its altitude on the spot. The goal is then below or above all
  /// images, and only obstacles that have left the images can be in the way.
  bool arrives_at(const Eigen::Vector3d& p_BG_W) const {
    constexpr double kNearM = 6.0, kOtherHeightM = 1.0;
    return config_.additions.goal_first && p_BG_W.head<2>().norm() < kNearM && std::abs(p_BG_W.z()) > kOtherHeightM &&
           passed_->free(p_BG_W, p_BG_W.norm());
  }

  /// Improves the depth image: [Andert2007] sec. 3.3. The modified law searches for sky everywhere and in a smoothed
  /// image, because noise looks like texture and a semi-global matcher extends the disparity of a tree over the sky.
  void improve(cv::Mat& disparity16) {
    constexpr int kSameSegment16 = 16;  // tau_difference, one pixel: keeps a slanted plane in one segment
    disparity16.copyTo(matched16_);
    vision::stereo::remove_specks(disparity16, kSameSegment16, config_.speck_px);
    if (config_.additions.sky) cv::blur(source_->grey(), smooth_, {3, 3});
    const cv::Mat& grey = config_.additions.sky ? smooth_ : source_->grey();
    const auto among = config_.additions.sky ? vision::stereo::SkyAmong::all : vision::stereo::SkyAmong::unknown;
    vision::stereo::mark_sky(grey, config_.sky_texture, config_.sky_brightness, among, disparity16);
  }

  /// Gives squares without matches a disparity that blocks a corridor.
  void block_unknown(cv::Mat& disparity16) const {
    constexpr int kSquarePx = 8;
    const auto blocking16 = static_cast<int16_t>(std::ceil(source_->geometry().disparity16(config_.corridor.target_m)));
    const cv::Rect image({}, disparity16.size());
    for (int v = 0; v < image.height; v += kSquarePx) {
      for (int u = 0; u < image.width; u += kSquarePx) {
        cv::Mat square = disparity16(cv::Rect(u, v, kSquarePx, kSquarePx) & image);
        if (cv::countNonZero(square >= 0) == 0) square.setTo(blocking16);
      }
    }
  }

  CorridorSearch search() const {
    return {pyramid_, source_->geometry(), config_.corridor, [this](const Eigen::Vector3d& ray_C) {
              const Eigen::Vector3d ray_W = R_WC_ * ray_C;
              return passed_->free(ray_W) && can_follow(ray_W);
            }};
  }

  /// Whether the vehicle can climb along a ray and stay in its corridor. The other half of the corridor is for the
  /// hull. Above a falling ray, the vehicle is in view of its camera.
  bool can_follow(const Eigen::Vector3d& ray_W) const {
    const double slope = slope_of(ray_W);
    return !config_.additions.goal_first || slope <= 0.0 ||
           lag_behind_ray_m(slope, level_mps_, climb_) < 0.5 * config_.corridor.radius_m;
  }

  /// Chooses the next target or, if there is none, the side to turn to: that of the last target or of a passed goal.
  /// @param aim_C  the goal, or the point ahead on the path. @return number of corridor tests.
  int aim(const NavigationState& navigation, const Eigen::Vector3d& aim_C, bool turns_back) {
    const std::optional<Target> before = target_;
    const std::optional<cv::Point> followed =
        tracker_.follow(before ? std::optional(before->pixel) : std::nullopt, source_->grey());
    const Eigen::Vector3d v_WB_C = source_->X_BC().linear().transpose() * navigation.v_WB_B_est;
    CorridorSearch images = search();
    target_.reset();
    const std::optional<double> side = turn_back_.side();
    if (side) turn_ = *side;
    if (turns_back) return 0;
    if (config_.additions.goal_first) {
      target_ = choose_goal_first(images, aim_C, v_WB_C, followed);
    } else if (follows_path()) {
      target_ = keep_path(images, aim_C, followed);
    } else {
      // A hovering vehicle has no direction of flight; the paper starts with "the way straight on".
      target_ = images.join(is_moving(v_WB_C) ? v_WB_C : Eigen::Vector3d::UnitZ(), followed);
    }
    if (!side && before && !target_) turn_ = before->pixel.x < source_->geometry().center_u_px ? -1.0 : 1.0;
    return images.tests();
  }

  void count(int64_t t_ns, int tests) {
    if (first_t_ns_ < 0) first_t_ns_ = t_ns;
    if (!target_ && last_t_ns_ >= 0) hover_s_ += seconds(t_ns - last_t_ns_);
    last_t_ns_ = t_ns;
    ++images_;
    tracked_ += target_ && target_->found_by == FoundBy::track;
    all_tests_ += tests;
  }

  double speed_mps(const Observation& observation, double slope) const {
    if (!config_.additions.goal_first) return config_.speed_mps;
    const NavigationState& navigation = observation.navigation;
    const double goal_m = (observation.goal.p_WG - navigation.p_WB_est).head<2>().norm();
    const Eigen::Vector3d v_WB_C = source_->X_BC().linear().transpose() * navigation.v_WB_B_est;
    return std::min({approach_speed_mps(config_.speed_mps, goal_m, climb_.acceleration_mps2),
                     climbing_speed_mps(slope, climb_),
                     stopping_speed_mps(pyramid_, source_->geometry(), config_.corridor.radius_m, v_WB_C,
                                        climb_.acceleration_mps2, hull_ahead_m_ + kStandoffM)});
  }

  /// The modified law stays on the ray, because only its corridor is free. The published law climbs as fast as it can.
  double altitude_m(const Observation& observation, double slope, double speed_mps) const {
    const double now_m = -observation.navigation.p_WB_est.z(), goal_m = -observation.goal.p_WG.z();
    const bool to_goal = target_->found_by == FoundBy::goal;
    if (config_.additions.goal_first) {
      constexpr double kHoldM = 0.5;  // within this distance from the goal's altitude, it is held
      const double along_m = altitude_along_ray_m(now_m, slope, speed_mps);
      const double reach_m = std::max(kHoldM, std::abs(along_m - now_m));
      return to_goal ? std::clamp(goal_m, now_m - reach_m, now_m + reach_m) : along_m;
    }
    constexpr double kLeadS = 2.0;  // look-ahead time along the ray to the target for the altitude
    return to_goal ? goal_m : now_m + kLeadS * config_.speed_mps * slope;
  }

  /// Flies in the direction of view; [Andert2007] eq. (18) for the target in B.
  Command steer(const Observation& observation) {
    if (!target_) return HoverCommand{turn_ * config_.yaw_rate_radps};
    const double z_m = std::min(target_->z_m, CorridorSearch::kLookAheadM);
    const Eigen::Vector3d p_BP_B = source_->X_BC() * (z_m * source_->geometry().ray_at_unit_depth(target_->pixel));
    const Eigen::Vector3d p_BP_W = observation.navigation.q_WB_est * p_BP_B;
    const Eigen::Vector2d level_W = p_BP_W.head<2>();
    const double slope = slope_of(p_BP_W), speed = speed_mps(observation, slope);
    VelocityCommand command;
    command.v_WB_W = speed * level_W.normalized();
    command.heading_rad = std::atan2(level_W.y(), level_W.x());
    command.altitude_m = std::max(altitude_m(observation, slope, speed), config_.lowest_m);
    return command;
  }

  std::vector<Metric> do_metrics() const override {
    const double flown_s = seconds(last_t_ns_ - first_t_ns_);
    return {{"corridor_tests", images_ > 0 ? all_tests_ / images_ : 0.0, ""},
            {"decision_hz", flown_s > 0.0 ? (images_ - 1) / flown_s : 0.0, "Hz"},
            {"targets_tracked", static_cast<double>(tracked_), ""},
            {"hover_time_s", hover_s_, "s"}};
  }

  cv::Mat do_annotate() const override {
    if (images_ == 0) return {};
    TargetImage shown{source_->grey(), matched16_, {}, std::nullopt, 0, kLookRound};
    const CorridorSearch corridors = search();
    for (const cv::Point& block : corridors.far_blocks()) {
      shown.candidates.push_back({block, corridors.is_free(block)});
    }
    if (target_) {
      const double z_m = std::min(target_->z_m, CorridorSearch::kLookAheadM);
      shown.target = target_->pixel;
      shown.target_radius_px = static_cast<int>(source_->geometry().focal_px * config_.corridor.radius_m / z_m);
      shown.chosen_by = name_of(target_->found_by);
    }
    return draw(shown, pyramid_, source_->geometry(), 2.0 * config_.corridor.target_m);
  }

  StereoCorridorConfig config_;
  std::optional<DisparitySource> source_;
  TargetTracker tracker_;
  std::optional<stereo::PassedObstacles> passed_;
  ClimbLimits climb_;
  double hull_ahead_m_ = 0.0;                           ///< extent of the hull ahead of the camera
  double level_mps_ = 0.0;                              ///< horizontal speed, as estimated
  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();  ///< as estimated
  vision::stereo::DepthPyramid pyramid_;
  cv::Mat smooth_, matched16_;
  std::optional<Target> target_;
  TurnBack turn_back_;
  Retreat retreat_;
  FlightPath path_;
  std::optional<Decision> last_;
  int64_t first_t_ns_ = -1, last_t_ns_ = -1;
  int64_t images_ = 0, tracked_ = 0;
  double all_tests_ = 0.0;
  double hover_s_ = 0.0;
  double turn_ = 1.0;  ///< to the right
};

}  // namespace

std::unique_ptr<Module> make_stereo_corridor(const StereoCorridorConfig& config) {
  return std::make_unique<StereoCorridor>(config);
}

}  // namespace hedgehop::avoidance::stereo_corridor
