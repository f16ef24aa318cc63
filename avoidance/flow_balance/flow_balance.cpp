#include "avoidance/flow_balance/flow_balance.h"

#include <optional>

#include "avoidance/flow_balance/approach_limit.h"
#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/flow_balance/modified_balance.h"
#include "avoidance/flow_balance/ranging.h"
#include "avoidance/flow_balance/side_cameras.h"
#include "avoidance/go_to_goal.h"
#include "avoidance/heading.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Much of the view of a city is sky and open ground. A patch counts as near only if the last three images agree, and
/// there is no memory beyond them.
constexpr PatchRanging::Options kCityPatches{.floor_mps = 0.2, .memory_s = 0.0, .images = 3};

class FlowBalance final : public Module {
 public:
  explicit FlowBalance(const FlowBalanceConfig& config) : config_(config) { fields::require_bounds(config); }

 private:
  bool is_published() const { return config_.law == Law::published; }

  Needs do_needs() const override { return SideCameras::needs(); }

  std::vector<Signal> do_signals() const override { return SideCameras::signals(); }

  void do_reset(const Setup& setup) override {
    cameras_.emplace(setup, config_.flow, /*derotate=*/!is_published());
    PatchRanging::Options patches = kCityPatches;
    patches.max_elevation_rad = config_.max_elevation_rad;
    ranging_.emplace(patches);
    ring_.emplace(RangeRing::Options{config_.memory_s, config_.release_s});
    detour_.emplace(config_.patience_s);
    radius_m_ = setup.limits.radius_m;
    v_cmd_W_.reset();
    v_tgt_W_.setZero();
    heading_rad_ = 0.0;
    decisions_ = avoiding_ = 0;
  }

  Decision do_update(const Observation& observation) override {
    heading_rad_ = heading_rad(observation.navigation.q_WB_est);
    cameras_->update(observation);
    if (!is_published()) update_ring(observation);
    const Eigen::Vector2d p_BG_W = (observation.goal.p_WG - observation.navigation.p_WB_est).head<2>();
    const Eigen::Vector2d v_W = is_published() ? published_command(p_BG_W, velocity_H(observation.navigation))
                                               : modified_command(p_BG_W, observation.t_ns);
    constexpr double kAvoidCosine = 0.966;  // 15 deg off the target
    const bool avoids = v_W.dot(v_tgt_W_) < kAvoidCosine * v_W.norm() * v_tgt_W_.norm();
    v_cmd_W_ = is_published() ? v_W : filtered(v_W, observation.t_ns);
    last_t_ns_ = observation.t_ns;

    Decision decision;
    decision.command = VelocityCommand{*v_cmd_W_, -observation.goal.p_WG.z(), observation.goal.heading_rad};
    decision.status = avoids ? "avoid" : "cruise";
    decision.signals =
        cameras_->signal_values(is_published() ? std::nullopt : std::optional(ranging_->nearest_per_m()), v_tgt_W_);
    ++decisions_;
    avoiding_ += avoids ? 1 : 0;
    return decision;
  }

  /// Adds the ranges of the cameras to the ring.
  void update_ring(const Observation& observation) {
    const NavigationState& navigation = observation.navigation;
    ranging_->update(*cameras_, navigation);
    ring_->carry((navigation.q_WB_est * navigation.v_WB_B_est).head<2>(), observation.t_ns);
    for (size_t side = 0; side < kSideCount; ++side) {
      if (cameras_->fresh(side)) ring_->add(ranging_->columns(side), heading_rad_, cameras_->measure(side)->dt_s);
    }
  }

  /// Returns the command of [Garratt2009] eq. (4), in W, m/s.
  Eigen::Vector2d published_command(const Eigen::Vector2d& p_BG_W, const Eigen::Vector2d& v_H) {
    v_tgt_W_ = velocity_to_goal(rotated(p_BG_W, config_.spiral_angle_rad), config_.speed_mps, /*slow_radius_m=*/0.0);
    const Eigen::Vector2d push_H =
        push_from_walls(cameras_->flows(), v_H, {config_.loom_gain_m2ps, config_.flow_gain_m2ps});
    return rotated(normalized_command(rotated(v_tgt_W_, -heading_rad_), push_H, v_tgt_W_.norm()), heading_rad_);
  }

  /// Returns the command with the push of the nearest obstacles in all directions, with detours and with a limited
  /// approach, in W, m/s.
  Eigen::Vector2d modified_command(const Eigen::Vector2d& p_BG_W, int64_t t_ns) {
    const double aside_rad = detour_->update(p_BG_W.norm(), seconds(t_ns));
    const Eigen::Vector2d aim_W = rotated(p_BG_W, config_.spiral_angle_rad + aside_rad);
    v_tgt_W_ = velocity_to_goal(aim_W, config_.speed_mps, config_.slow_radius_m);
    // The direction is computed at full speed, so that walls do not outweigh a near goal.
    const Eigen::Vector2d full_W = velocity_to_goal(aim_W, config_.speed_mps, 0.0);
    const std::vector<Eigen::Vector2d> obstacles_W = ring_->obstacles_W();
    const Eigen::Vector2d push_W =
        push_from_obstacles(obstacles_W, aim_W, config_.loom_gain_m2ps + config_.flow_gain_m2ps);
    const Eigen::Vector2d v_W = normalized_command(full_W, push_W, v_tgt_W_.norm());
    if (config_.clearance_m <= 0.0) return v_W;
    return limited_approach(v_W, confirmed_obstacles(obstacles_W),
                            {radius_m_ + config_.clearance_m, config_.braking_mps2, config_.reaction_s},
                            config_.speed_mps);
  }

  Eigen::Vector2d filtered(const Eigen::Vector2d& v_W, int64_t t_ns) const {
    if (!v_cmd_W_) return v_W;
    return low_pass(*v_cmd_W_, v_W, seconds(t_ns - last_t_ns_), config_.command_time_constant_s);
  }

  std::vector<Metric> do_metrics() const override {
    return {{"least_valid_share", cameras_ ? cameras_->least_valid_share() : 1.0, ""},
            {"avoiding_share", decisions_ > 0 ? static_cast<double>(avoiding_) / decisions_ : 0.0, ""},
            {"detours", static_cast<double>(detour_ ? detour_->count() : 0), ""}};
  }

  cv::Mat do_annotate() const override {
    if (!cameras_) return {};
    return cameras_->annotate(rotated(v_tgt_W_, -heading_rad_),
                              rotated(v_cmd_W_.value_or(Eigen::Vector2d::Zero()), -heading_rad_), config_.speed_mps);
  }

  FlowBalanceConfig config_;
  std::optional<SideCameras> cameras_;
  std::optional<PatchRanging> ranging_;
  std::optional<RangeRing> ring_;
  std::optional<Detour> detour_;
  Eigen::Vector2d v_tgt_W_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> v_cmd_W_;
  int64_t last_t_ns_ = 0;
  double heading_rad_ = 0.0;
  double radius_m_ = 0.0;
  int decisions_ = 0, avoiding_ = 0;
};

}  // namespace

std::unique_ptr<Module> make_flow_balance(const FlowBalanceConfig& config) {
  return std::make_unique<FlowBalance>(config);
}

}  // namespace hedgehop::avoidance::flow_balance
