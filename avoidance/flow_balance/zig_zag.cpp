#include "avoidance/flow_balance/zig_zag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "avoidance/flow_balance/confirmed_zig_zag.h"
#include "avoidance/flow_balance/ranging.h"
#include "avoidance/flow_balance/side_cameras.h"
#include "avoidance/flow_balance/turn_clearance.h"
#include "avoidance/flow_balance/visited_floor.h"
#include "avoidance/flow_balance/zig_zag_law.h"
#include "avoidance/heading.h"
#include "sim/fields/bounds.h"

namespace hedgehop::avoidance::flow_balance {
namespace {

/// Ranges of patches, used if no wall fits. In a room all patches see walls. A low floor and a memory of 1 s keep the
/// range of a wall straight ahead. One image is sufficient, because reversals are confirmed.
constexpr PatchRanging::Options kRoomPatches{.floor_mps = 0.05, .memory_s = 1.0, .images = 1};

class ZigZag final : public Module {
 public:
  explicit ZigZag(const ZigZagConfig& config) : config_(config) { fields::require_bounds(config); }

 private:
  bool is_published() const { return config_.law == Law::published; }

  Needs do_needs() const override { return SideCameras::needs(); }

  std::vector<Signal> do_signals() const override { return SideCameras::signals(); }

  void do_reset(const Setup& setup) override {
    cameras_.emplace(setup, config_.flow, /*derotate=*/!is_published());
    const Diagonal diagonal{{config_.forward_speed_mps, config_.sideways_speed_mps}, config_.range_threshold_m};
    law_.emplace(diagonal);
    confirmed_.emplace(diagonal, config_.stray_rad, setup.seed);
    means_ = {};
    walls_.emplace(kRoomPatches);
    floor_ = VisitedFloor();
    v_cmd_W_.setZero();
    heading_rad_ = 0.0;
    decisions_ = turns_ = 0;
  }

  Decision do_update(const Observation& observation) override {
    heading_rad_ = heading_rad(observation.navigation.q_WB_est);
    cameras_->update(observation);
    ranging().update(*cameras_, observation.navigation);
    const bool turned = is_published() ? law_->update(sides(means_.nearest_per_m())) : explore(observation.navigation);
    v_cmd_W_ = rotated(velocity_cmd_H(), heading_rad_);

    Decision decision;
    decision.command = VelocityCommand{v_cmd_W_, -observation.goal.p_WG.z(), observation.goal.heading_rad};
    decision.status = turned ? "turn" : "cruise";
    decision.signals =
        cameras_->signal_values(is_published() ? std::nullopt : std::optional(walls_->nearest_per_m()), v_cmd_W_);
    ++decisions_;
    turns_ += turned ? 1 : 0;
    return decision;
  }

  Ranging& ranging() { return is_published() ? static_cast<Ranging&>(means_) : *walls_; }

  /// The modified law. @return whether it reversed a component.
  bool explore(const NavigationState& navigation) {
    const Eigen::Vector2d v_H = velocity_H(navigation), p_NE = navigation.p_WB_est.head<2>();
    floor_.visit(p_NE);
    const auto foresee = [&](const Eigen::Vector2d& v_new_H) {
      return this->foresee({v_H, v_new_H, {config_.reaction_s, config_.braking_mps2}}, p_NE);
    };
    return confirmed_->update(sides_in_approach(v_H, foresee), foresee);
  }

  /// Returns the properties of the path that begins with a turn. A path ends at its first wall, or after 8 m if none is
  /// known.
  ConfirmedZigZag::Path foresee(const Turn& turn, const Eigen::Vector2d& p_NE) const {
    constexpr double kMaxLengthM = 8.0;
    ConfirmedZigZag::Path path{.clearance_m = config_.range_threshold_m, .unvisited = 0.0};
    const Eigen::Vector2d direction_H = turn.to_H.normalized();
    double length_m = kMaxLengthM;
    for (const vision::flow::WallEstimate& wall : walls_->walls()) {
      const Eigen::Vector2d towards_H = wall.inverse_range_per_m.normalized();
      const double range_m = 1.0 / wall.inverse_range_per_m.norm() - config_.tail_m * std::max(0.0, -towards_H.x());
      path.clearance_m = std::min(path.clearance_m, clearance_after_turn_m(turn, towards_H, range_m));
      const double approach = direction_H.dot(towards_H);
      const double to_threshold_m = std::max(0.0, range_m - config_.range_threshold_m);
      if (approach * length_m > to_threshold_m) length_m = to_threshold_m / approach;
    }
    path.unvisited = floor_.unvisited(p_NE, rotated(direction_H, heading_rad_), length_m);
    return path;
  }

  Eigen::Vector2d velocity_cmd_H() const { return is_published() ? law_->velocity_H() : confirmed_->velocity_H(); }

  std::array<SideRange, kSideCount> sides(const PerSide& inverse_ranges_per_m) const {
    std::array<SideRange, kSideCount> sides;
    for (size_t i = 0; i < kSideCount; ++i) {
      sides[i] = {cameras_->axes_H()[i], inverse_ranges_per_m[i], cameras_->fresh(i)};
    }
    return sides;
  }

  /// Returns the ranges that remain after a stop. If both components are reversed, each decreases as slowly as the
  /// whole velocity.
  std::array<SideRange, kSideCount> sides_in_approach(const Eigen::Vector2d& v_H,
                                                      const ConfirmedZigZag::Foresee& foresee) const {
    Approach approach{.v_H = v_H,
                      .v_cmd_H = confirmed_->velocity_H(),
                      .stopping = {config_.reaction_s, config_.braking_mps2},
                      .tail_m = config_.tail_m,
                      .reverses_both = true};
    const auto to_stop = sides(walls_->left_once_stopped_per_m(approach));
    if (confirmed_->reverses_both(to_stop, foresee)) return to_stop;
    approach.reverses_both = false;
    return sides(walls_->left_once_stopped_per_m(approach));
  }

  std::vector<Metric> do_metrics() const override {
    const int reversals = !confirmed_ ? 0 : is_published() ? law_->reversals() : confirmed_->reversals();
    return {{"least_valid_share", cameras_ ? cameras_->least_valid_share() : 1.0, ""},
            {"avoiding_share", decisions_ > 0 ? static_cast<double>(turns_) / decisions_ : 0.0, ""},
            {"reversals", static_cast<double>(reversals), ""}};
  }

  cv::Mat do_annotate() const override {
    if (!cameras_) return {};
    const Eigen::Vector2d v_cmd_H = rotated(v_cmd_W_, -heading_rad_);
    return cameras_->annotate(v_cmd_H, v_cmd_H, std::hypot(config_.forward_speed_mps, config_.sideways_speed_mps));
  }

  ZigZagConfig config_;
  std::optional<SideCameras> cameras_;
  MeanRanging means_;                         ///< of the published law
  std::optional<WallRanging> walls_;          ///< of the modified law
  VisitedFloor floor_;                        ///< of the modified law
  std::optional<ZigZagLaw> law_;              ///< the published law
  std::optional<ConfirmedZigZag> confirmed_;  ///< the modified law
  Eigen::Vector2d v_cmd_W_ = Eigen::Vector2d::Zero();
  double heading_rad_ = 0.0;
  int decisions_ = 0, turns_ = 0;
};

}  // namespace

std::unique_ptr<Module> make_zig_zag(const ZigZagConfig& config) { return std::make_unique<ZigZag>(config); }

}  // namespace hedgehop::avoidance::flow_balance
