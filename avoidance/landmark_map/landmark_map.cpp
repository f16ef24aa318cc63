#include "avoidance/landmark_map/landmark_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "avoidance/camera_flow.h"
#include "avoidance/go_to_goal.h"
#include "avoidance/landmark_map/landmark_overlay.h"
#include "avoidance/landmark_map/map_route.h"
#include "avoidance/landmark_map/plan_overlay.h"

namespace hedgehop::avoidance::landmark_map {
namespace {

constexpr const char* kRole = "front";

void check(const LandmarkMapModuleConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("landmark_map: ") + message);
  };
  need(c.speed_mps > 0.0, "speed must be above 0 m/s");
  need(c.clearance_m > 0.0 && c.link_m >= 0.0 && c.most_sigma_m > 0.0,
       "clearance and most_sigma must be above 0 m, link not below");
  need(c.behind_m >= 0.0, "behind must not be negative");
  need(c.time_to_contact_s >= 0.0 && c.stop_range_m >= 0.0, "time_to_contact and stop_range must not be negative");
  need(c.loom_time_s >= 0.0, "loom_time must not be negative");
  need(c.flow_share > 0.0 && c.flow_share <= 1.0, "flow_share must lie in (0, 1]");
  need(c.braking_mps2 > 0.0, "braking must be above 0 m/s^2");
}

double greatest_variance(const Eigen::MatrixXd& P) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

class LandmarkMapModule final : public Module {
 public:
  explicit LandmarkMapModule(const LandmarkMapModuleConfig& config) : config_(config) { check(config); }

 private:
  Needs do_needs() const override { return {{LandmarkSight::need(config_.sight)}}; }
  std::vector<Signal> do_signals() const override {
    return {{"corners", ""}, {"landmarks", ""}, {"obstacles", ""}, {"loom_per_s", "1/s"}, {"off_course_m", "m"}};
  }

  void do_reset(const Setup& setup) override {
    const MountedCamera& camera = *std::ranges::find(setup.cameras, kRole, &MountedCamera::role);
    sight_.emplace(config_.sight, camera);
    flow_.emplace(camera, CameraFlow::Options{config_.flow, /*derotate=*/true, vision::flow::Missing::skip});
    clearance_m_ = config_.clearance_m + setup.limits.radius_m;
    hulls_.clear();
    way_.clear();
    start_NE_.reset();
    stopped_ = false;
    alarms_ = 0;
    loom_per_s_ = 0.0;
    off_course_m_ = most_off_course_m_ = 0.0;
  }

  Decision do_update(const Observation& observation) override {
    const NavigationState& navigation = observation.navigation;
    if (!start_NE_) start_NE_ = navigation.p_WB_est.head<2>();
    const auto frame = std::ranges::find(observation.frames, kRole, &CameraFrame::role);
    if (frame != observation.frames.end()) look(*frame, navigation);
    smooth_loom(flow_->measure(observation.t_ns));
    stopped_ = stopped_ || wall_ahead(navigation);

    Decision decision;
    if (stopped_) {
      decision = {HoverCommand{}, "stop", {}};
    } else if (config_.orbit) {
      decision = {fly_round(navigation, observation.goal), "orbit", {}};
    } else {
      decision = follow_course(navigation, observation.goal);
    }
    decision.signals = {static_cast<double>(sight_->corners_px().size()), static_cast<double>(confirmed()),
                        static_cast<double>(hulls_.size()), loom_per_s_, off_course_m_};
    return decision;
  }

  void look(const CameraFrame& frame, const NavigationState& navigation) {
    if (!sight_->update(frame, navigation)) return;
    flow_->update({frame.role, frame.t_ns, sight_->grey(), {}}, navigation.w_WB_B_est);
  }

  /// Whether something without corners is so near that the flight must stop: by the divergence of the flow, as
  /// [Shah2009] ch. 7 proposes, or by a single beam. Several times running, for one measurement may err.
  bool wall_ahead(const NavigationState& navigation) {
    const double v_mps = std::max(0.0, navigation.v_WB_B_est.x());
    const double reaction_m = v_mps * kReactionS + 0.5 * v_mps * v_mps / config_.braking_mps2;
    const bool near = loom_per_s_ * config_.time_to_contact_s > 1.0 ||
                      (navigation.range_m && *navigation.range_m < config_.stop_range_m + reaction_m);
    alarms_ = near ? alarms_ + 1 : 0;
    constexpr int kAlarms = 6;
    return alarms_ >= kAlarms;
  }

  /// The flow's divergence, smoothed; 0 while too little of the image flows to judge by.
  void smooth_loom(const std::optional<CameraFlow::Measure>& measure) {
    if (!measure || measure->valid_share < config_.flow_share) {
      loom_per_s_ = 0.0;
      return;
    }
    const double share = 1.0 - std::exp(-measure->dt_s / std::max(config_.loom_time_s, kInstantS));
    loom_per_s_ += share * (measure->loom_per_s - loom_per_s_);
  }

  Command fly_round(const NavigationState& navigation, const Goal& goal) {
    const Eigen::Vector2d middle(config_.orbit->north_m, config_.orbit->east_m);
    const Eigen::Vector2d out = navigation.p_WB_est.head<2>() - middle;
    const double radius_m = std::max((*start_NE_ - middle).norm(), 1.0), now_m = std::max(out.norm(), 1.0);
    constexpr double kBackPerS = 0.2;
    VelocityCommand command;
    command.v_WB_W =
        config_.orbit->rate_radps * Eigen::Vector2d(-out.y(), out.x()) + kBackPerS * (radius_m - now_m) * out / now_m;
    command.heading_rad = std::atan2(-out.y(), -out.x());
    command.altitude_m = -goal.p_WG.z();
    return command;
  }

  /// Along the course from the start to the goal; where the map has something on it, the shortest way to the first
  /// place from which the rest of the course is free.
  Decision follow_course(const NavigationState& navigation, const Goal& goal) {
    const Eigen::Vector2d at = navigation.p_WB_est.head<2>(), end = goal.p_WG.head<2>();
    at_NE_ = at;
    end_NE_ = end;
    const Eigen::Vector2d course = end - *start_NE_;
    const double length_m = course.norm();
    const Eigen::Vector2d along = length_m > 0.0 ? Eigen::Vector2d(course / length_m) : Eigen::Vector2d::UnitX();
    const double done_m = (at - *start_NE_).dot(along);
    off_course_m_ = std::abs((at - *start_NE_).dot(Eigen::Vector2d(-along.y(), along.x())));
    most_off_course_m_ = std::max(most_off_course_m_, off_course_m_);
    hulls_ = obstacles();

    const auto free = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
      return std::ranges::all_of(hulls_,
                                 [&](const PlanHull& hull) { return distance_to_hull(hull, from, to) > clearance_m_; });
    };
    constexpr double kLeadM = 6.0, kStepM = 3.0, kOnCourseM = 2.0;
    Eigen::Vector2d join = end;
    for (double s = done_m + kLeadM; s < length_m; s += kStepM) {
      const Eigen::Vector2d place = *start_NE_ + s * along;
      if (!free(place, end)) continue;
      join = place;
      break;
    }
    const auto way = way_round(hulls_, at, join, clearance_m_);
    if (!way) return {HoverCommand{}, "no_way", {}};
    way_ = *way;
    const char* status = way_.size() > 1 ? "avoid" : off_course_m_ > kOnCourseM ? "rejoin" : "cruise";
    const Eigen::Vector2d to_end = end - at;
    constexpr double kSlowM = 4.0;
    VelocityCommand command;
    command.v_WB_W = velocity_to_goal(way_.front() - at, config_.speed_mps, 0.0);
    if (to_end.norm() < kSlowM) command.v_WB_W *= to_end.norm() / kSlowM;
    command.heading_rad = std::atan2(command.v_WB_W.y(), command.v_WB_W.x());
    command.altitude_m = -goal.p_WG.z();
    return {command, status, {}};
  }

  /// What the map knows well enough and high enough to matter, from above, and what may stand behind it.
  std::vector<PlanHull> obstacles() const {
    std::vector<Eigen::Vector2d> points, seen_from;
    for (const vision::landmarks::MappedLandmark& mapped : map().landmarks()) {
      if (!map().confirmed(mapped)) continue;
      const Eigen::Vector3d p_W = vision::landmarks::position_W(mapped.landmark);
      const Eigen::Matrix3d P = vision::landmarks::covariance_W(mapped.landmark);
      const double variance = greatest_variance(P.topLeftCorner<2, 2>());
      if (-p_W.z() < config_.lowest_m || variance > config_.most_sigma_m * config_.most_sigma_m) continue;
      points.push_back(p_W.head<2>());
      seen_from.push_back(mapped.landmark.X_WA.translation().head<2>());
    }
    std::vector<Eigen::Vector2d> filled;
    for (size_t i = 0; i < points.size(); ++i) {
      const auto near = [&](const Eigen::Vector2d& p) { return (p - points[i]).norm() <= config_.link_m; };
      if (std::ranges::count_if(points, near) < 2) continue;  // a corner alone bounds nothing
      filled.push_back(points[i]);
      filled.push_back(points[i] + config_.behind_m * (points[i] - seen_from[i]).normalized());
    }
    return plan_hulls(filled, std::max(config_.link_m, config_.behind_m));
  }

  const vision::landmarks::LandmarkMap& map() const { return sight_->map(); }

  int64_t confirmed() const {
    if (!sight_) return 0;
    return std::ranges::count_if(map().landmarks(), [&](const auto& mapped) { return map().confirmed(mapped); });
  }

  std::vector<Metric> do_metrics() const override {
    return {{"landmarks", static_cast<double>(confirmed()), ""},
            {"obstacles", static_cast<double>(hulls_.size()), ""},
            {"most_off_course", most_off_course_m_, "m"},
            {"off_course_at_end", off_course_m_, "m"},
            {"stopped", stopped_ ? 1.0 : 0.0, ""},
            {"filter_ms_total", sight_ ? sight_->filter_ms() : 0.0, "ms", /*is_wall_time=*/true},
            {"true_corners", config_.sight.front_end == FrontEnd::corners ? 1.0 : 0.0, ""}};
  }

  /// The landmarks that are known to a tenth of their distance. What one thing hides of another ends at places that
  /// wander over the world as the camera moves: they fit no point, and stay vague.
  std::vector<ChartPoint> known_points() const {
    constexpr double kKnownShare = 0.1;
    std::vector<ChartPoint> points;
    if (!sight_) return points;
    for (const vision::landmarks::MappedLandmark& mapped : map().landmarks()) {
      if (!map().confirmed(mapped)) continue;
      const Eigen::Vector3d p_W = vision::landmarks::position_W(mapped.landmark);
      const double distance_m = (p_W - sight_->pose().X_WC_est.translation()).norm();
      const Eigen::Matrix3d P_W = vision::landmarks::covariance_W(mapped.landmark);
      if (greatest_variance(P_W) <= kKnownShare * kKnownShare * distance_m * distance_m) points.push_back({p_W, P_W});
    }
    return points;
  }

  Chart do_chart() const override { return {known_points(), course(), way_}; }

  /// From the start to the goal, or round the orbit's middle.
  std::vector<Eigen::Vector2d> course() const {
    if (!start_NE_) return {};
    if (!config_.orbit) return {*start_NE_, end_NE_};
    constexpr int kCorners = 72;
    const Eigen::Vector2d middle(config_.orbit->north_m, config_.orbit->east_m);
    std::vector<Eigen::Vector2d> circle;
    for (int k = 0; k <= kCorners; ++k) {
      circle.push_back(middle + Eigen::Rotation2Dd(2.0 * std::numbers::pi * k / kCorners) * (*start_NE_ - middle));
    }
    return circle;
  }

  cv::Mat do_annotate() const override {
    if (!sight_ || sight_->grey().empty()) return {};
    cv::Mat image = landmark_overlay(sight_->grey(), sight_->corners_px(), map(), sight_->pose(), flow_->pinhole());
    if (!config_.orbit && start_NE_) {
      PlanView view{{}, hulls_, *start_NE_, end_NE_, at_NE_, way_};
      for (const ChartPoint& point : known_points()) view.landmarks_NE.emplace_back(point.p_W.head<2>());
      draw_plan(view, image);
    }
    return image;
  }

  static constexpr double kInstantS = 1e-6;
  static constexpr double kReactionS = 0.5;  ///< until a stop takes effect: latency and the vehicle's tilt

  LandmarkMapModuleConfig config_;
  std::optional<LandmarkSight> sight_;
  std::optional<CameraFlow> flow_;
  double clearance_m_ = 0.0;  ///< of B: the hull's radius added
  std::vector<PlanHull> hulls_;
  std::vector<Eigen::Vector2d> way_;
  std::optional<Eigen::Vector2d> start_NE_;
  Eigen::Vector2d at_NE_ = Eigen::Vector2d::Zero(), end_NE_ = Eigen::Vector2d::Zero();
  bool stopped_ = false;
  int alarms_ = 0;
  double loom_per_s_ = 0.0;
  double off_course_m_ = 0.0, most_off_course_m_ = 0.0;
};

}  // namespace

std::unique_ptr<Module> make_landmark_map(const LandmarkMapModuleConfig& config) {
  return std::make_unique<LandmarkMapModule>(config);
}

}  // namespace hedgehop::avoidance::landmark_map
