#include "avoidance/stereo_corridor/stereo_corridor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "avoidance/stereo/stereo_sight.h"
#include "avoidance/stereo_corridor/target_overlay.h"
#include "avoidance/stereo_corridor/target_tracker.h"
#include "avoidance/stereo_corridor/turn_back.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::stereo_corridor {
namespace {

using Free = std::optional<vision::stereo::Corridor>;

/// Who found the target, in the order of [Andert2007] sec. 4.3.4.
enum class How { course, keep, track, near, search, none };
constexpr std::array<const char*, 6> kHowNames = {"cruise", "keep", "track", "near", "search", "look_round"};

void check(const StereoCorridorConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("stereo_corridor: ") + message);
  };
  need(c.radius_m > 0.0 && c.target_m > 0.0 && c.look_ahead_m > 0.0, "distances must be above 0 m");
  need(c.speed_mps > 0.0, "speed must be above 0 m/s");
  need(c.finest >= 0 && c.coarsest >= c.finest && c.coarsest <= 10, "levels need 0 <= finest <= coarsest <= 10");
  need(c.nearby.fine_step_px >= 1 && c.nearby.coarse_step_px >= 1, "steps must be at least 1 px");
  need(c.nearby.fine_radius_px <= c.nearby.coarse_radius_px, "fine_radius must not exceed coarse_radius");
  need(c.cost.depth_per_m <= 0.0, "cost_depth must not be above 0");
  need(c.yaw_rate_radps > 0.0, "yaw_rate must be above 0 deg/s");
}

class StereoCorridor final : public Module {
 public:
  explicit StereoCorridor(const StereoCorridorConfig& config) : config_(config) { check(config); }

 private:
  struct Target {
    cv::Point pixel;
    double z_m = 0.0;
    How how = How::none;
  };

  Needs do_needs() const override { return stereo::StereoSight::needs(); }
  std::vector<Signal> do_signals() const override {
    return {{"target_u_px", "px"},
            {"target_v_px", "px"},
            {"free_depth_m", "m"},
            {"corridor_tests", ""},
            {"valid_share", ""}};
  }

  void do_reset(const Setup& setup) override {
    sight_.emplace(config_.stereo, setup);
    tracker_ = {};
    passed_.emplace(config_.passed);
    random_ = cv::RNG(setup.seed);
    acceleration_mps2_ = setup.limits.acceleration_mps2;
    target_.reset();
    last_.reset();
    first_t_ns_ = last_t_ns_ = -1;
    pairs_ = tracked_ = 0;
    point_tests_ = 0.0;
    hover_s_ = 0.0;
    turn_ = 1.0;
    turn_back_ = {};
  }

  Decision do_update(const Observation& observation) override {
    if (!sight_->update(observation.frames) && last_) return *last_;
    cv::Mat& disparity16 = sight_->disparity16();
    if (disparity16.empty()) return {HoverCommand{}, "wait", std::vector<double>(5, kUnknown)};
    see(observation.navigation, observation.t_ns, disparity16);
    tests_ = 0;
    const Eigen::Vector3d p_CG_C = R_WC_.transpose() * (observation.goal.p_WG - observation.navigation.p_WB_est);
    const bool turns_back = turn_back_.update(p_CG_C);
    aim(observation.navigation, p_CG_C, turns_back);
    count(observation.t_ns);

    Decision decision;
    decision.command = steer(observation);
    const How how = target_ ? target_->how : How::none;
    decision.status = turns_back ? "turn_back" : kHowNames[static_cast<size_t>(how)];
    const double valid = cv::countNonZero(disparity16 >= 0) / static_cast<double>(disparity16.total());
    decision.signals = {target_ ? target_->pixel.x : kUnknown, target_ ? target_->pixel.y : kUnknown,
                        target_ && std::isfinite(target_->z_m) ? target_->z_m : kUnknown, static_cast<double>(tests_),
                        valid};
    last_ = decision;
    return decision;
  }

  /// Improves the depth image, [Andert2007] sec. 3.3, and takes it in. Differs: sky is looked for in a smoothed
  /// image, as noise would look like texture.
  void see(const NavigationState& navigation, int64_t t_ns, cv::Mat& disparity16) {
    if (config_.disparity_noise_px > 0.0) add_noise(disparity16);
    disparity16.copyTo(matched16_);
    vision::stereo::remove_specks(disparity16, config_.speck_difference16, config_.speck_px);
    cv::blur(sight_->grey(), smooth_, {3, 3});
    vision::stereo::mark_sky(smooth_, config_.sky_texture, config_.sky_brightness, config_.sky_among, disparity16);
    pyramid_.build(disparity16, config_.coarsest);
    const Eigen::Isometry3d X_WC = Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * sight_->X_BC();
    R_WC_ = X_WC.linear();
    passed_->update(t_ns, pyramid_, sight_->geometry(), X_WC);
  }

  void add_noise(cv::Mat& disparity16) {
    const cv::Mat known = disparity16 >= 0;
    cv::Mat noise(disparity16.size(), CV_16SC1);
    random_.fill(noise, cv::RNG::NORMAL, 0.0, vision::stereo::kDisparityUnits * config_.disparity_noise_px);
    cv::add(disparity16, noise, disparity16, known);
    cv::max(disparity16, 0, noise);
    noise.copyTo(disparity16, known);
  }

  void count(int64_t t_ns) {
    if (first_t_ns_ < 0) first_t_ns_ = t_ns;
    if (!target_ && last_t_ns_ >= 0) hover_s_ += 1e-9 * static_cast<double>(t_ns - last_t_ns_);
    last_t_ns_ = t_ns;
    ++pairs_;
    tracked_ += target_ && target_->how == How::track;
    point_tests_ += tests_;
  }

  /// Chooses the next target; without one, the side to turn to: the last target's, or that of a goal it has passed.
  void aim(const NavigationState& navigation, const Eigen::Vector3d& p_CG_C, bool turns_back) {
    const std::optional<Target> before = target_;
    const std::optional<cv::Point> followed =
        tracker_.follow(before ? std::optional(before->pixel) : std::nullopt, sight_->grey());
    target_ = turns_back ? std::nullopt : choose(p_CG_C, navigation, followed);
    if (turns_back) {
      turn_ = std::copysign(1.0, p_CG_C.x());
    } else if (before && !target_) {
      turn_ = before->pixel.x < sight_->geometry().center_u_px ? -1.0 : 1.0;
    }
  }

  /// The joined method, [Andert2007] sec. 4.3.4. Differs: before the direction of flight is kept, the course to the
  /// goal is tried, so that the vehicle takes it up again; and while the goal lies outside the image, the free
  /// corridor nearest to its direction is searched, so that it comes into view.
  std::optional<Target> choose(const Eigen::Vector3d& course_C, const NavigationState& navigation,
                               const std::optional<cv::Point>& followed) {
    const Eigen::Vector3d v_C = sight_->X_BC().linear().transpose() * navigation.v_WB_B_est;
    constexpr double kStandingMps = 0.5;
    const bool moving = v_C.norm() > kStandingMps;

    const std::optional<cv::Point> course = pixel_of(course_C);
    if (course) {
      if (const Free free = examine(*course)) return Target{*course, free->z_m, How::course};
      const std::optional<cv::Point> ahead = moving ? pixel_of(v_C) : std::nullopt;
      if (ahead) {
        if (const Free free = examine(*ahead)) return Target{*ahead, free->z_m, How::keep};
      }
      if (followed) {
        if (const Free free = examine(*followed)) return Target{*followed, free->z_m, How::track};
        const Eigen::Vector3d old_C = sight_->geometry().ray(*followed);
        for (const auto& candidates : {vision::stereo::fine_targets(*followed, config_.nearby),
                                       vision::stereo::coarse_targets(*followed, config_.nearby)}) {
          if (const auto best = cheapest(candidates, old_C, How::near)) return best;
        }
      }
    }
    return cheapest(far_blocks(), course && moving ? v_C : course_C, How::search);
  }

  /// The pixel that shows a direction, if it lies within the image.
  std::optional<cv::Point> pixel_of(const Eigen::Vector3d& direction_C) const {
    if (!(direction_C.z() > 0.0)) return std::nullopt;
    const vision::stereo::StereoGeometry& g = sight_->geometry();
    const Eigen::Vector2d on_plane = direction_C.head<2>() / direction_C.z();
    const double u = g.center_u_px + g.focal_px * on_plane.x(), v = g.center_v_px + g.focal_px * on_plane.y();
    const cv::Size size = sight_->image();
    if (!(u > -0.5 && v > -0.5 && u < size.width - 0.5 && v < size.height - 0.5)) return std::nullopt;
    return cv::Point(static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v)));
  }

  std::vector<cv::Point> far_blocks() const {
    return vision::stereo::quadtree_targets(pyramid_, sight_->geometry().disparity16(config_.target_m),
                                            config_.coarsest, config_.finest);
  }

  /// The corridor round a pixel's ray, if it is free in the image and of what has left it.
  Free corridor(const cv::Point& pixel, int* tests = nullptr) const {
    if (!passed_->free(R_WC_ * sight_->geometry().ray(pixel))) return std::nullopt;
    const vision::stereo::Corridor found =
        vision::stereo::examine_corridor(pyramid_, sight_->geometry(), pixel, config_.radius_m, config_.target_m);
    if (tests) *tests += found.tests;
    return found.state == vision::stereo::Corridor::State::free ? Free(found) : std::nullopt;
  }
  Free examine(const cv::Point& pixel) { return corridor(pixel, &tests_); }

  /// The free one of some candidates that costs least; the earlier one of equals.
  std::optional<Target> cheapest(const std::vector<cv::Point>& candidates, const Eigen::Vector3d& reference_C,
                                 How how) {
    std::optional<Target> best;
    double least = std::numeric_limits<double>::infinity();
    const bool by_depth = config_.cost.depth_per_m != 0.0;
    for (const cv::Point& pixel : candidates) {
      if (!cv::Rect({}, sight_->image()).contains(pixel)) continue;
      const Eigen::Vector3d ray = sight_->geometry().ray(pixel);
      // Without a term of depth the cost is known before the corridor is examined.
      if (!by_depth && vision::stereo::target_cost(config_.cost, ray, reference_C) >= least) continue;
      const Free free = examine(pixel);
      if (!free) continue;
      const double z_m = std::min(free->z_m, config_.look_ahead_m);
      const double cost = vision::stereo::target_cost(config_.cost, z_m * ray, reference_C);
      if (cost >= least) continue;
      least = cost;
      best = Target{pixel, free->z_m, how};
    }
    return best;
  }

  /// Slows down towards the goal, so that the circle it can turn in is no wider than its distance: a goal that was
  /// missed is not circled for ever. Ours.
  double speed_mps(const Observation& observation) const {
    const double goal_m = (observation.goal.p_WG - observation.navigation.p_WB_est).head<2>().norm();
    constexpr double kSlowestMps = 0.5;
    return std::min(config_.speed_mps, std::max(kSlowestMps, std::sqrt(0.5 * acceleration_mps2_ * goal_m)));
  }

  /// Flies where it looks; [Andert2007] eq. (18) for the target in B.
  Command steer(const Observation& observation) {
    const NavigationState& navigation = observation.navigation;
    if (!target_) return HoverCommand{turn_ * config_.yaw_rate_radps};
    const double z_m = std::min(target_->z_m, config_.look_ahead_m);
    const Eigen::Vector3d p_BT_B = sight_->X_BC() * (z_m * sight_->geometry().ray(target_->pixel));
    const Eigen::Vector3d p_BT_W = navigation.q_WB_est * p_BT_B;
    const Eigen::Vector2d way_W = p_BT_W.head<2>();
    VelocityCommand command;
    command.v_WB_W = speed_mps(observation) * way_W.normalized();
    command.heading_rad = std::atan2(way_W.y(), way_W.x());
    command.altitude_m = -observation.goal.p_WG.z();
    if (target_->how != How::course) {
      constexpr double kLeadS = 2.0;  // the height that the ray to the target has after this time
      const double slope = p_BT_W.z() / way_W.norm();
      command.altitude_m = -(navigation.p_WB_est.z() + kLeadS * config_.speed_mps * slope);
    }
    command.altitude_m = std::max(command.altitude_m, config_.lowest_m);
    return command;
  }

  std::vector<Metric> do_metrics() const override {
    const double flown_s = 1e-9 * static_cast<double>(last_t_ns_ - first_t_ns_);
    return {{"corridor_tests", pairs_ > 0 ? point_tests_ / pairs_ : 0.0, ""},
            {"decision_hz", flown_s > 0.0 ? (pairs_ - 1) / flown_s : 0.0, "Hz"},
            {"targets_tracked", static_cast<double>(tracked_), ""},
            {"hover_time_s", hover_s_, "s"}};
  }

  cv::Mat do_annotate() const override {
    if (pairs_ == 0) return {};
    TargetImage seen{sight_->grey(), matched16_, {}, std::nullopt, 0, kHowNames[static_cast<size_t>(How::none)]};
    for (const cv::Point& block : far_blocks()) seen.candidates.push_back({block, corridor(block).has_value()});
    if (target_) {
      const double z_m = std::min(target_->z_m, config_.look_ahead_m);
      seen.target = target_->pixel;
      seen.target_radius_px = static_cast<int>(sight_->geometry().focal_px * config_.radius_m / z_m);
      seen.chosen_by = kHowNames[static_cast<size_t>(target_->how)];
    }
    return draw(seen, pyramid_, sight_->geometry(), 2.0 * config_.target_m);
  }

  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  StereoCorridorConfig config_;
  std::optional<stereo::StereoSight> sight_;
  TargetTracker tracker_;
  std::optional<stereo::PassedObstacles> passed_;
  double acceleration_mps2_ = 0.0;                      ///< that the vehicle is allowed
  Eigen::Matrix3d R_WC_ = Eigen::Matrix3d::Identity();  ///< as estimated
  vision::stereo::DepthPyramid pyramid_;
  cv::Mat smooth_, matched16_;
  cv::RNG random_;  ///< of the noise that experiments ask for
  std::optional<Target> target_;
  TurnBack turn_back_;
  std::optional<Decision> last_;
  int64_t first_t_ns_ = -1, last_t_ns_ = -1;
  int64_t pairs_ = 0, tracked_ = 0;
  double point_tests_ = 0.0;  ///< of all pairs
  int tests_ = 0;             ///< of this one
  double hover_s_ = 0.0;
  double turn_ = 1.0;  ///< to the right
};

}  // namespace

std::unique_ptr<Module> make_stereo_corridor(const StereoCorridorConfig& config) {
  return std::make_unique<StereoCorridor>(config);
}

}  // namespace hedgehop::avoidance::stereo_corridor
