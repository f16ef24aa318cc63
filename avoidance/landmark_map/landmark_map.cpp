#include "avoidance/landmark_map/landmark_map.h"

#include <algorithm>
#include <string>

#include "avoidance/camera_flow.h"
#include "avoidance/dead_reckoning.h"
#include "avoidance/landmark_map/course.h"
#include "avoidance/landmark_map/map_overlay.h"
#include "avoidance/landmark_map/wall_stop.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

constexpr const char* kRole = "front";
// Time constant with which the position follows the estimate. Satellite positions wander within a minute, and landmarks
// inherit every change during their observation. With a longer time, a lasting error of the velocity would displace the
// route more: 0.03 m/s by 0.6 m.
constexpr double kConvergeS = 20.0;

class LandmarkMapModule final : public Module {
 public:
  explicit LandmarkMapModule(const LandmarkMapModuleConfig& config) : config_(config) {
    fields::require_bounds(config);
  }

 private:
  Needs do_needs() const override { return {{LandmarkObserver::need(config_.observer)}, {CommandType::velocity}}; }
  std::vector<Signal> do_signals() const override {
    return {{"corners", ""}, {"landmarks", ""}, {"obstacles", ""}, {"loom_per_s", "1/s"}, {"off_course_m", "m"}};
  }

  void do_reset(const Setup& setup) override {
    const MountedCamera& camera = required_camera(setup, kRole);
    observer_.emplace(config_.observer, config_.law, camera);
    flow_.reset();
    if (stops_before_walls() && config_.time_to_contact_s > 0.0 && config_.observer.source != CornerSource::corners) {
      flow_.emplace(camera, CameraFlow::Options{{}, /*derotate=*/true, vision::flow::Missing::skip});
    }
    wall_stop_ = WallStop(config_.time_to_contact_s);
    radius_m_ = setup.limits.radius_m;
    keeper_.reset();
    reckoning_ = DeadReckoning(kConvergeS);
    start_NE_.reset();
  }

  Decision do_update(const Observation& observation) override {
    const NavigationState navigation =
        reckons() ? reckoning_.update(observation.navigation, seconds(observation.t_ns)) : observation.navigation;
    at_NE_ = navigation.p_WB_est.head<2>();
    if (!start_NE_) begin();
    if (const CameraFrame* const frame = find_frame(observation.frames, kRole)) look(*frame, navigation);

    Decision decision;
    if (stops_before_walls() &&
        wall_stop_.update(flow_ ? flow_->measure(observation.t_ns) : std::nullopt, navigation)) {
      decision = {HoverCommand{}, "stop", {}};
    } else if (config_.orbit) {
      decision = {orbit_command(*config_.orbit, *start_NE_, at_NE_, -observation.goal.p_WG.z()), "orbit", {}};
    } else {
      end_NE_ = observation.goal.p_WG.head<2>();
      if (avoids()) keeper_->set_obstacles(map());
      decision = keeper_->follow(at_NE_, observation.goal);
    }
    decision.signals = {static_cast<double>(observer_->corners_px().size()), static_cast<double>(confirmed()),
                        static_cast<double>(keeper_->obstacles().size()), wall_stop_.loom_per_s(),
                        keeper_->off_course_m()};
    return decision;
  }

  void begin() {
    start_NE_ = at_NE_;
    keeper_.emplace(CourseKeeper::Config{config_.speed_mps, config_.clearance_m + radius_m_, config_.behind_m},
                    *start_NE_);
  }

  void look(const CameraFrame& frame, const NavigationState& navigation) {
    if (!observer_->update(frame, navigation) || !flow_) return;
    flow_->update({frame.role, frame.t_ns, observer_->grey()}, navigation.w_WB_B_est);
  }

  bool stops_before_walls() const { return config_.law == Law::modified; }
  /// The adjustment integrates the velocity itself, and requires positions whose errors do not depend on it.
  bool reckons() const { return config_.law == Law::modified && !config_.observer.adjustment; }
  bool avoids() const { return config_.law == Law::modified && config_.clearance_m > 0.0; }
  const vision::landmarks::LandmarkMap& map() const { return observer_->map(); }

  int64_t confirmed() const {
    if (!observer_) return 0;
    return std::ranges::count_if(map().landmarks(), [&](const auto& mapped) { return map().confirmed(mapped); });
  }

  std::vector<Metric> do_metrics() const override {
    return {{"landmarks", static_cast<double>(confirmed()), ""},
            {"obstacles", keeper_ ? static_cast<double>(keeper_->obstacles().size()) : 0.0, ""},
            {"most_off_course", keeper_ ? keeper_->max_off_course_m() : 0.0, "m"},
            {"stopped", wall_stop_.stopped() ? 1.0 : 0.0, ""},
            {"filter_ms_total", observer_ ? observer_->filter_ms() : 0.0, "ms", /*is_wall_time=*/true}};
  }

  /// Returns the landmarks that are known to a meter, and all that may bound an obstacle, so that the evaluation of the
  /// map includes every landmark that the module uses. Apparent corners at occlusions move with the camera; they fit no
  /// fixed point and remain uncertain.
  std::vector<MapPoint> known_points() const {
    constexpr double kKnownSigmaM = 1.0;
    std::vector<MapPoint> points;
    if (!observer_) return points;
    for (const vision::landmarks::MappedLandmark& mapped : map().landmarks()) {
      if (!map().confirmed(mapped)) continue;
      const Eigen::Vector3d p_W = vision::landmarks::position_W(mapped.landmark);
      const Eigen::Matrix3d P_W = vision::landmarks::covariance_W(mapped.landmark);
      const bool known = max_variance(P_W) <= kKnownSigmaM * kKnownSigmaM;
      if (known || bounds_obstacle(map(), mapped)) points.push_back({p_W, P_W});
    }
    return points;
  }

  Map do_map() const override {
    if (!start_NE_) return {};
    const std::vector<Eigen::Vector2d> straight = {*start_NE_, end_NE_};
    return {known_points(), config_.orbit ? orbit_course(*config_.orbit, *start_NE_) : straight, keeper_->path_NE()};
  }

  cv::Mat do_annotate() const override {
    if (!observer_ || observer_->grey().empty()) return {};
    cv::Mat image =
        landmark_overlay(observer_->grey(), observer_->corners_px(), map(), observer_->pose(), observer_->camera());
    if (!config_.orbit && start_NE_) {
      PlanView view{{}, keeper_->obstacles(), *start_NE_, end_NE_, at_NE_, keeper_->path_NE()};
      for (const MapPoint& point : known_points()) view.landmarks_NE.emplace_back(point.p_W.head<2>());
      draw_plan(view, image);
    }
    return image;
  }

  LandmarkMapModuleConfig config_;
  std::optional<LandmarkObserver> observer_;
  std::optional<CameraFlow> flow_;  ///< only with images, to stop in front of walls
  WallStop wall_stop_{0.0};
  std::optional<CourseKeeper> keeper_;
  double radius_m_ = 0.0;  ///< of the vehicle
  DeadReckoning reckoning_;
  std::optional<Eigen::Vector2d> start_NE_;
  Eigen::Vector2d at_NE_ = Eigen::Vector2d::Zero(), end_NE_ = Eigen::Vector2d::Zero();
};

}  // namespace

std::unique_ptr<Module> make_landmark_map(const LandmarkMapModuleConfig& config) {
  return std::make_unique<LandmarkMapModule>(config);
}

}  // namespace hedgehop::avoidance::landmark_map
