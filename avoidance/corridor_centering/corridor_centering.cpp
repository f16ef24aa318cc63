#include "avoidance/corridor_centering/corridor_centering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "avoidance/corridor_centering/corridor_overlay.h"
#include "avoidance/corridor_centering/pursuit.h"
#include "avoidance/corridor_centering/wall_observer.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

class CorridorCentering final : public Module {
 public:
  explicit CorridorCentering(const CorridorCenteringConfig& config)
      : config_(config), published_(published_config()), pursuit_(pursuit_config(0.0)) {
    fields::require_bounds(config);
  }

 private:
  bool is_modified() const { return config_.law == Law::modified; }

  CenteringLaw::Config published_config() const {
    return {config_.gains, config_.sample_s, config_.pitch_rad, config_.probe_s};
  }
  Pursuit::Config pursuit_config(double radius_m) const {
    Pursuit::Config pursuit;
    pursuit.limits.speed_mps = config_.speed_mps;
    pursuit.limits.stop_mps2 = config_.braking_mps2;
    pursuit.lookahead_m = config_.lookahead_m;
    pursuit.margin_m = config_.margin_m;
    pursuit.probe_mps = config_.probe_mps;
    pursuit.probe_s = config_.probe_s;
    pursuit.yaw_rate_radps = config_.yaw_rate_radps;
    pursuit.radius_m = radius_m;
    return pursuit;
  }

  Needs do_needs() const override {
    return {{{WallObserver::kRole, CameraNeed::Channel::grey}},
            {is_modified() ? CommandType::velocity : CommandType::attitude}};
  }

  std::vector<Signal> do_signals() const override {
    return {{"centering_error", ""}, {"left_m", "m"},           {"right_m", "m"},     {"vectors_left", ""},
            {"vectors_right", ""},   {"gap_left_m", "m"},       {"gap_right_m", "m"}, {"free_time_s", "s"},
            {"walls_rad", "rad"},    {"approach_per_s", "1/s"}, {"off_middle_m", "m"}};
  }

  void do_reset(const Setup& setup) override {
    observer_.emplace(config_.law, config_.attitude_lag_s, required_camera(setup, WallObserver::kRole));
    radius_m_ = setup.limits.radius_m;
    published_ = CenteringLaw(published_config());
    pursuit_ = Pursuit(pursuit_config(radius_m_));
    seen_.reset();
    t_ns_ = -1;
    status_ = "wait";
    vectors_.clear();
    unknown_ = 0;
    hover_s_ = 0.0;
  }

  Decision do_update(const Observation& observation) override {
    const bool is_new = observe(observation);
    const double dt_s = t_ns_ < 0 ? 0.0 : seconds(observation.t_ns - t_ns_);
    t_ns_ = observation.t_ns;
    const WallObservation* seen = seen_ ? &*seen_ : nullptr;
    Decision decision;
    decision.command =
        is_modified() ? pursuit_.update(observation, seen, is_new, dt_s) : published_.update(observation, dt_s);
    status_ = is_modified() ? pursuit_.status() : published_.status();
    if (std::holds_alternative<HoverCommand>(decision.command)) hover_s_ += dt_s;
    decision.status = status_;
    decision.signals = signals(is_new);
    return decision;
  }

  std::vector<double> signals(bool is_new) const {
    const WallObservation* seen = seen_ ? &*seen_ : nullptr;
    const WallObservation* now = is_new ? seen : nullptr;
    const vision::corridor::Gap& gap = pursuit_.gap();
    return {now ? now->error : kUnknown,
            now ? now->left.distance_m : kUnknown,
            now ? now->right.distance_m : kUnknown,
            seen ? seen->left.count : 0.0,
            seen ? seen->right.count : 0.0,
            gap.left_m,
            gap.right_m,
            std::isfinite(pursuit_.free_s()) ? pursuit_.free_s() : kUnknown,
            now ? now->direction_rad : kUnknown,
            now && now->approach ? now->approach->rate_per_s : kUnknown,
            now ? -vision::corridor::middle_offset_m(now->left.distance_m, now->right.distance_m) : kUnknown};
  }

  /// Reads the image, if there is one. @return whether it was compared with the previous image.
  bool observe(const Observation& observation) {
    const CameraFrame* const frame = find_frame(observation.frames, WallObserver::kRole);
    if (!frame) return false;
    std::optional<WallObservation> seen = observer_->update(*frame, observation.navigation);
    if (!seen) return false;
    seen_ = std::move(seen);
    vectors_.push_back(seen_->left.count + seen_->right.count);
    unknown_ += std::isnan(seen_->error);
    if (is_modified()) {
      pursuit_.observe(*seen_, observation.t_ns);
    } else {
      published_.observe(seen_->error, observation.t_ns);
    }
    return true;
  }

  std::vector<Metric> do_metrics() const override {
    std::vector<int> vectors = vectors_;
    std::ranges::sort(vectors);
    const auto images = static_cast<double>(vectors.size());
    return {{"vectors_median", vectors.empty() ? 0.0 : vectors[vectors.size() / 2], ""},
            {"unknown_share", vectors.empty() ? 1.0 : unknown_ / images, ""},
            {"hover_time_s", hover_s_, "s"}};
  }

  cv::Mat do_annotate() const override {
    if (!observer_ || observer_->image().empty()) return {};
    const WallObservation* seen = seen_ ? &*seen_ : nullptr;
    CorridorScene scene{seen, pursuit_.gap(), pursuit_.course_rad(), radius_m_, status_};
    if (seen) {
      scene.caption += "  vectors " + std::to_string(seen->left.count) + " + " + std::to_string(seen->right.count);
      if (!std::isnan(seen->error)) {
        scene.caption += "  error " + std::to_string(std::lround(100.0 * seen->error)) + " %";
      }
    }
    return corridor_overlay(*observer_, scene);
  }

  CorridorCenteringConfig config_;
  std::optional<WallObserver> observer_;
  CenteringLaw published_;
  Pursuit pursuit_;
  double radius_m_ = 0.0;                ///< of the vehicle
  std::optional<WallObservation> seen_;  ///< in the last image
  int64_t t_ns_ = -1;
  const char* status_ = "wait";
  std::vector<int> vectors_;  ///< accepted vectors of both sides in each image
  int unknown_ = 0;           ///< images without an error
  double hover_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Module> make_corridor_centering(const CorridorCenteringConfig& config) {
  return std::make_unique<CorridorCentering>(config);
}

}  // namespace hedgehop::avoidance::corridor_centering
