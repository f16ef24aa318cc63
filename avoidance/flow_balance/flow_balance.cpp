#include "avoidance/flow_balance/flow_balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>

#include "avoidance/camera_flow.h"
#include "avoidance/flow_balance/balance_law.h"
#include "avoidance/flow_balance/camera_ranges.h"
#include "avoidance/flow_balance/camera_walls.h"
#include "avoidance/flow_balance/detour.h"
#include "avoidance/flow_balance/flow_overlay.h"
#include "avoidance/flow_balance/zig_zag.h"
#include "avoidance/go_to_goal.h"
#include "avoidance/heading.h"
#include "vision/flow/flow_range.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

constexpr std::array<const char*, 4> kRoles = {"left", "right", "front", "rear"};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void check(const FlowBalanceConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("flow_balance: ") + message);
  };
  need(c.divisor_floor_mps > 0.0, "divisor_floor must be above 0 m/s");
  need(c.near_share > 0.0 && c.near_share <= 1.0, "near_share must lie in (0, 1]");
  need(c.speed_mps > 0.0, "speed must be above 0 m/s");
  need(c.slow_radius_m >= 0.0, "slow_radius must be at least 0 m");
  need(c.loom_gain_m2ps >= 0.0 && c.flow_gain_m2ps >= 0.0, "gains must be at least 0 m^2/s");
  need(std::abs(c.spiral_angle_rad) <= std::numbers::pi / 3, "spiral_angle must lie within 60 deg");
  need(c.patience_s >= 0.0 && c.detour_duration_s > 0.0, "patience must be at least 0 s, detour_duration above 0 s");
  need(c.detour_angle_rad > 0.0 && c.detour_angle_rad <= std::numbers::pi, "detour_angle must lie in (0, 180] deg");
  need(c.command_time_constant_s >= 0.0, "command_time_constant must be at least 0 s");
  need(c.forward_speed_mps > 0.0 && c.sideways_speed_mps > 0.0, "simple: speeds must be above 0 m/s");
  need(c.range_threshold_m > 0.0, "simple: range_threshold must be above 0 m");
  need(c.near_images >= 1, "near_images must be at least 1");
  need(c.braking_mps2 > 0.0 && c.reaction_s >= 0.0, "simple: braking must be above 0 m/s^2, reaction at least 0 s");
  need(c.way_angle_rad > 0.0 && c.way_angle_rad <= std::numbers::pi / 2, "simple: way_angle must lie in (0, 90] deg");
  need(c.range_memory_s >= 0.0, "range_memory must be at least 0 s");
  need(c.wall_error >= 0.0 && c.tail_m >= 0.0, "simple: wall_error must be at least 0, tail at least 0 m");
  need(c.stray_rad >= 0.0 && c.stray_rad <= std::numbers::pi / 6, "simple: stray must lie in [0, 30] deg");
  need(c.confirmations >= 1, "simple: at least one confirmation");
}

Eigen::Vector2d turned(const Eigen::Vector2d& v, double angle_rad) { return Eigen::Rotation2Dd(angle_rad) * v; }

class FlowBalance final : public Module {
 public:
  explicit FlowBalance(const FlowBalanceConfig& config) : config_(config) { check(config); }

 private:
  Needs do_needs() const override {
    Needs needs;
    for (const char* role : kRoles) needs.cameras.push_back({role, CameraNeed::Channel::grey, /*pinhole=*/true});
    return needs;
  }

  std::vector<Signal> do_signals() const override {
    std::vector<Signal> signals;
    for (const std::string role : kRoles) {
      signals.push_back({"flow_" + role + "_radps", "rad/s"});
      signals.push_back({"loom_" + role + "_per_s", "1/s"});
      signals.push_back({"valid_share_" + role, ""});
      signals.push_back({"near_" + role + "_per_m", "1/m"});
    }
    signals.push_back({"target_v_north_mps", "m/s"});
    signals.push_back({"target_v_east_mps", "m/s"});
    return signals;
  }

  void do_reset(const Setup& setup) override {
    cameras_.clear();
    const auto missing = config_.average == FlowBalanceConfig::Average::all ? vision::flow::Missing::far_away
                                                                            : vision::flow::Missing::skip;
    for (const std::string role : kRoles) {
      const auto mounted = std::find_if(setup.cameras.begin(), setup.cameras.end(),
                                        [&](const MountedCamera& camera) { return camera.role == role; });
      cameras_.emplace_back(*mounted, CameraFlow::Options{config_.flow, config_.derotate, missing});
    }
    zig_zag_.emplace(ZigZag::Config{{config_.forward_speed_mps, config_.sideways_speed_mps},
                                    config_.range_threshold_m,
                                    config_.confirmations,
                                    config_.stray_rad,
                                    setup.seed});
    detour_.emplace(Detour::Config{config_.patience_s, config_.detour_angle_rad, config_.detour_duration_s});
    sense_.assign(kRoles.size(), {});
    const CameraRanges::Options ranging{config_.divisor_floor_mps, config_.range_memory_s, config_.near_images};
    ranges_.assign(kRoles.size(), CameraRanges(ranging));
    walls_.clear();
    v_cmd_W_.reset();
    v_tgt_W_.setZero();
    heading_rad_ = 0.0;
    least_valid_share_ = 1.0;
    decisions_ = avoiding_ = 0;
  }

  Decision do_update(const Observation& observation) override {
    const NavigationState& navigation = observation.navigation;
    heading_rad_ = heading_rad(navigation.q_WB_est);
    look(observation);
    const Eigen::Vector2d v_W = (navigation.q_WB_est * navigation.v_WB_B_est).head<2>();
    const Eigen::Vector2d v_H = turned(v_W, -heading_rad_);

    Decision decision;
    VelocityCommand command;
    if (config_.scheme == FlowBalanceConfig::Scheme::simple) {
      command.v_WB_W = explore(observation, v_H, decision.status);
    } else {
      command.v_WB_W = seek_goal(observation, v_H, decision.status);
    }
    v_cmd_W_ = command.v_WB_W;
    last_t_ns_ = observation.t_ns;
    command.altitude_m = -observation.goal.p_WG.z();
    command.heading_rad = observation.goal.heading_rad;
    decision.command = command;
    decision.signals = signal_values(observation.t_ns);
    ++decisions_;
    if (decision.status != "cruise") ++avoiding_;
    return decision;
  }

  /// Brings flow and loom of every camera up to date.
  void look(const Observation& observation) {
    for (size_t i = 0; i < cameras_.size(); ++i) {
      CameraFlow& camera = cameras_[i];
      fresh_[i] = false;
      for (const CameraFrame& frame : observation.frames) {
        if (frame.role == kRoles[i]) fresh_[i] |= camera.update(frame, observation.navigation.w_WB_B_est);
      }
      // Tilt is left out: the cameras' axes are taken level as they are mounted in B.
      const Eigen::Matrix3d& R_BC = camera.camera().X_BC.linear();
      sense_[i] = {R_BC.col(2).head<2>(), R_BC.col(0).head<2>()};
      if (const auto measure = camera.measure(observation.t_ns)) {
        sense_[i].flow_radps = measure->flow_radps;
        sense_[i].loom_per_s = measure->loom_per_s;
        if (fresh_[i] && config_.ranging == FlowBalanceConfig::Ranging::nearest) {
          ranges_[i].update(camera, observation.navigation, measure->dt_s);
        }
        sense_[i].near_per_m = vision::flow::nearest_inverse_range_per_m(ranges_[i].near_per_m(), config_.near_share);
        if (fresh_[i]) least_valid_share_ = std::min(least_valid_share_, measure->valid_share);
      }
    }
  }

  /// The goal-directed scheme, [Garratt2009] sec. 4.1: target velocity and push from the walls, brought to cruise
  /// speed.
  Eigen::Vector2d seek_goal(const Observation& observation, const Eigen::Vector2d& v_H, std::string& status) {
    const Eigen::Vector2d p_BG_W = (observation.goal.p_WG - observation.navigation.p_WB_est).head<2>();
    const double aside_rad = detour_->update(p_BG_W.norm(), 1e-9 * static_cast<double>(observation.t_ns));
    const Eigen::Vector2d aim_W = turned(p_BG_W, config_.spiral_angle_rad + aside_rad);
    v_tgt_W_ = velocity_to_goal(aim_W, config_.speed_mps, config_.slow_radius_m);
    // The way is chosen as at full speed, so that walls do not outweigh a goal that is near; then the speed is set.
    const Eigen::Vector2d full_H = turned(velocity_to_goal(aim_W, config_.speed_mps, 0.0), -heading_rad_);
    const Eigen::Vector2d push_H =
        config_.ranging == FlowBalanceConfig::Ranging::nearest
            ? push_from_nearest(sense_, config_.loom_gain_m2ps + config_.flow_gain_m2ps)
            : push_from_walls(sense_, v_H, config_.loom_gain_m2ps, config_.flow_gain_m2ps, config_.divisor_floor_mps);
    Eigen::Vector2d way_H = full_H + push_H;
    constexpr double kNoWayMps = 1e-6;
    if (way_H.norm() < kNoWayMps) way_H = full_H;
    const double speed_mps = v_tgt_W_.norm();
    const Eigen::Vector2d v_W = speed_mps > 0.0 ? turned(way_H.normalized() * speed_mps, heading_rad_) : v_tgt_W_;
    constexpr double kAvoidCosine = 0.966;  // 15 deg off the target
    status = v_W.dot(v_tgt_W_) < kAvoidCosine * v_W.norm() * v_tgt_W_.norm() ? "avoid" : "cruise";
    return filtered(v_W, observation.t_ns);
  }

  Eigen::Vector2d filtered(const Eigen::Vector2d& v_W, int64_t t_ns) const {
    if (config_.command_time_constant_s <= 0.0 || !v_cmd_W_) return v_W;
    const double dt_s = 1e-9 * static_cast<double>(t_ns - last_t_ns_);
    return *v_cmd_W_ + (1.0 - std::exp(-dt_s / config_.command_time_constant_s)) * (v_W - *v_cmd_W_);
  }

  /// The simple scheme, [Garratt2009] sec. 4.
  Eigen::Vector2d explore(const Observation& observation, const Eigen::Vector2d& v_H, std::string& status) {
    if (config_.wall_error > 0.0) {
      walls_ =
          walls_round(cameras_, observation.navigation, observation.t_ns, {config_.flow_noise_px, config_.wall_error});
    }
    const auto sides_with = [&](bool turns_whole) {
      std::array<ZigZag::Side, kRoles.size()> sides;
      for (size_t i = 0; i < cameras_.size(); ++i) {
        sides[i] = {sense_[i].axis_H, near_per_m(i, v_H, zig_zag_->way_H(), turns_whole), fresh_[i]};
      }
      return sides;
    };
    // In a corner both components turn round, and each as slowly as the whole velocity.
    auto sides = sides_with(/*turns_whole=*/!walls_.empty());
    if (!walls_.empty() && !zig_zag_->cornered(sides)) sides = sides_with(/*turns_whole=*/false);
    status = zig_zag_->update(sides) ? "turn" : "cruise";
    v_tgt_W_ = turned(zig_zag_->way_H(), heading_rad_);
    return v_tgt_W_;
  }

  /// Inverse range of the wall before a camera, 1/m, as far as it bars a way.
  double near_per_m(size_t i, const Eigen::Vector2d& v_H, const Eigen::Vector2d& way_H, bool turns_whole) const {
    if (config_.ranging == FlowBalanceConfig::Ranging::mean) {
      const InverseRanges near = inverse_ranges(sense_[i], v_H, config_.divisor_floor_mps);
      return std::max(near.from_flow_per_m, near.from_loom_per_m);
    }
    if (!walls_.empty()) return nearest_wall_per_m(i, v_H, way_H, turns_whole);
    const Stopping stopping{config_.reaction_s, config_.braking_mps2};
    std::vector<double> near = ranges_[i].near_per_m();
    const std::vector<double> bearings_rad = vision::flow::bearings_rad(cameras_[i].field(), cameras_[i].pinhole());
    for (size_t patch = 0; patch < near.size(); ++patch) {
      const Eigen::Vector2d to_patch_H =
          std::cos(bearings_rad[patch]) * sense_[i].axis_H + std::sin(bearings_rad[patch]) * sense_[i].right_H;
      const bool on_the_way = to_patch_H.dot(way_H) >= std::cos(config_.way_angle_rad) * way_H.norm();
      const double closing_mps = std::max(v_H.dot(to_patch_H), way_H.dot(to_patch_H));
      const double stops_m = stopping_distance_m(closing_mps, closing_mps, stopping);
      near[patch] = on_the_way ? near_once_stopped_per_m(near[patch], stops_m) : 0.0;
    }
    return vision::flow::nearest_inverse_range_per_m(std::move(near), config_.near_share);
  }

  /// The same from upright walls that face the camera, counted from the vehicle's side, so that the cameras' places do
  /// not matter.
  double nearest_wall_per_m(size_t i, const Eigen::Vector2d& v_H, const Eigen::Vector2d& way_H,
                            bool turns_whole) const {
    constexpr double kLeastM = 1e-3;
    const Stopping stopping{config_.reaction_s, config_.braking_mps2};
    double nearest_per_m = 0.0;
    for (const vision::flow::WallEstimate& wall : walls_) {
      const Eigen::Vector2d to_wall_H = wall.inverse_range_per_m.normalized();
      if (to_wall_H.dot(sense_[i].axis_H) < std::sqrt(0.5)) continue;  // another camera's
      if (way_H.dot(to_wall_H) <= 0.0) continue;
      const double closing_mps = std::max(v_H.dot(to_wall_H), way_H.dot(to_wall_H));
      const double tail_m = config_.tail_m * std::max(0.0, -to_wall_H.x());
      const double left_m = std::max(1.0 / wall.inverse_range_per_m.norm() - tail_m, kLeastM);
      const double turning_mps = turns_whole ? std::max(v_H.norm(), way_H.norm()) : closing_mps;
      const double stops_m = stopping_distance_m(closing_mps, turning_mps, stopping);
      nearest_per_m = std::max(nearest_per_m, near_once_stopped_per_m(1.0 / left_m, stops_m));
    }
    return nearest_per_m;
  }

  std::vector<double> signal_values(int64_t now_ns) const {
    std::vector<double> values;
    for (size_t i = 0; i < cameras_.size(); ++i) {
      const auto measure = cameras_[i].measure(now_ns);
      const bool ranged = measure && config_.ranging == FlowBalanceConfig::Ranging::nearest;
      values.push_back(measure ? measure->flow_radps : kUnknown);
      values.push_back(measure ? measure->loom_per_s : kUnknown);
      values.push_back(measure ? measure->valid_share : kUnknown);
      values.push_back(ranged ? sense_[i].near_per_m : kUnknown);
    }
    values.push_back(v_tgt_W_.x());
    values.push_back(v_tgt_W_.y());
    return values;
  }

  std::vector<Metric> do_metrics() const override {
    return {{"least_valid_share", least_valid_share_, ""},
            {"avoiding_share", decisions_ > 0 ? static_cast<double>(avoiding_) / decisions_ : 0.0, ""},
            {"detours", static_cast<double>(detour_ ? detour_->count() : 0), ""},
            {"reversals", static_cast<double>(zig_zag_ ? zig_zag_->reversals() : 0), ""}};
  }

  cv::Mat do_annotate() const override {
    std::vector<FlowTile> tiles;
    for (size_t i = 0; i < cameras_.size(); ++i) {
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), "Q %+.3f rad/s  L %+.3f /s", sense_[i].flow_radps, sense_[i].loom_per_s);
      tiles.push_back({kRoles[i], cameras_[i].image(), &cameras_[i].field(), text.data()});
    }
    if (tiles.empty() || tiles.front().grey.empty()) return {};
    const cv::Scalar blue(90, 170, 255), green(90, 230, 110);
    const std::array<CompassArrow, 2> arrows = {
        CompassArrow{turned(v_tgt_W_, -heading_rad_), blue},
        CompassArrow{turned(v_cmd_W_.value_or(Eigen::Vector2d::Zero()), -heading_rad_), green}};
    return flow_overlay(tiles, arrows, 1.1 * std::max(config_.speed_mps, v_tgt_W_.norm()));
  }

  FlowBalanceConfig config_;
  std::vector<CameraFlow> cameras_;  ///< in the order of kRoles, as are the next three
  std::vector<WallSense> sense_;
  std::vector<CameraRanges> ranges_;
  std::vector<vision::flow::WallEstimate> walls_;
  std::array<bool, kRoles.size()> fresh_{};
  std::optional<Detour> detour_;
  std::optional<ZigZag> zig_zag_;
  Eigen::Vector2d v_tgt_W_ = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector2d> v_cmd_W_;
  int64_t last_t_ns_ = 0;
  double heading_rad_ = 0.0;
  double least_valid_share_ = 1.0;
  int decisions_ = 0, avoiding_ = 0;
};

}  // namespace

std::unique_ptr<Module> make_flow_balance(const FlowBalanceConfig& config) {
  return std::make_unique<FlowBalance>(config);
}

}  // namespace hedgehop::avoidance::flow_balance
