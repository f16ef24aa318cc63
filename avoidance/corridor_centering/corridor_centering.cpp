#include "avoidance/corridor_centering/corridor_centering.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "avoidance/corridor_centering/corridor_overlay.h"
#include "avoidance/heading.h"

namespace hedgehop::avoidance::corridor_centering {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void check(const CorridorCenteringConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(message);
  };
  need(c.patience_s >= 0.0, "patience: must be at least 0 s");
  need(c.sample_s > 0.0, "sample: must be above 0 s");
  need(c.gap.slice_m > 0.0 && c.gap.ahead_m > 0.0, "gap: lengths must be above 0 m");
  need(c.gap.least >= 1, "gap.least: must be at least 1");
  need(c.lookahead_m > 0.0, "lookahead: must be above 0 m");
  need(c.most_course_rad > 0.0, "most_course: must be above 0 deg");
  need(c.speed.speed_mps > 0.0 && c.probe_mps > 0.0, "speed: must be above 0 m/s");
  need(c.speed.aside_s > 0.0 && c.speed.stop_mps2 > 0.0, "limits: aside and braking must be above 0");
  need(c.probe_s > 0.0, "probe_time: must be above 0 s");
}

double seconds(int64_t ns) { return 1e-9 * static_cast<double>(ns); }

class CorridorCentering final : public Module {
 public:
  explicit CorridorCentering(const CorridorCenteringConfig& config) : config_(config) { check(config); }

 private:
  Needs do_needs() const override { return {{{CorridorSight::kRole, CameraNeed::Channel::grey}}}; }

  std::vector<Signal> do_signals() const override {
    return {{"centering_error", ""}, {"left_m", "m"},           {"right_m", "m"},     {"vectors_left", ""},
            {"vectors_right", ""},   {"gap_left_m", "m"},       {"gap_right_m", "m"}, {"free_time_s", "s"},
            {"walls_rad", "rad"},    {"approach_per_s", "1/s"}, {"off_middle_m", "m"}};
  }

  void do_reset(const Setup& setup) override {
    const auto camera = std::ranges::find(setup.cameras, CorridorSight::kRole, &MountedCamera::role);
    sight_.emplace(config_.sight, *camera);
    memory_ = {};
    memory_.radius_m = setup.limits.radius_m;
  }

  Decision do_update(const Observation& observation) override {
    Memory& m = memory_;
    const bool looked = look(observation);
    const double dt_s = m.t_ns < 0 ? 0.0 : seconds(observation.t_ns - m.t_ns);
    m.t_ns = observation.t_ns;
    if (m.begun_ns < 0) m.begun_ns = observation.t_ns;

    Decision decision;
    m.course_rad.reset();
    const bool fresh = m.known_ns >= 0 && seconds(m.t_ns - m.known_ns) <= config_.patience_s;
    decision.command = config_.law == CorridorCenteringConfig::Law::printed ? steer_as_printed(observation, fresh, dt_s)
                                                                            : pursue(observation, fresh, looked, dt_s);
    if (std::holds_alternative<HoverCommand>(decision.command)) m.hover_s += dt_s;
    decision.status = m.status;
    const CorridorView* view = m.view ? &*m.view : nullptr;
    decision.signals = {
        view && looked ? view->error : kUnknown,
        view && looked ? view->left.distance_m : kUnknown,
        view && looked ? view->right.distance_m : kUnknown,
        view ? view->left.count : 0.0,
        view ? view->right.count : 0.0,
        m.gap.left_m,
        m.gap.right_m,
        std::isfinite(m.free_s) ? m.free_s : kUnknown,
        view && looked ? view->direction_rad : kUnknown,
        view && looked && view->approach ? view->approach->rate_per_s : kUnknown,
        view && looked ? -vision::corridor::middle_offset_m(view->left.distance_m, view->right.distance_m) : kUnknown};
    return decision;
  }

  /// Takes in the image, if there is one. @return whether it tells of walls, known or not.
  bool look(const Observation& observation) {
    const auto frame = std::ranges::find(observation.frames, CorridorSight::kRole, &CameraFrame::role);
    if (frame == observation.frames.end()) return false;
    std::optional<CorridorView> view = sight_->update(*frame, observation.navigation);
    if (!view) return false;
    Memory& m = memory_;
    m.view = std::move(view);
    m.vectors.push_back(m.view->left.count + m.view->right.count);
    m.free_s = std::numeric_limits<double>::infinity();
    constexpr double kStandingMps = 0.2;  // below, what lies ahead is told by noise
    if (m.view->v_H.norm() <= kStandingMps || m.view->approach) {
      m.dark_ns = -1;
    } else if (m.dark_ns < 0) {
      m.dark_ns = observation.t_ns;
    }
    if (m.view->v_H.norm() > kStandingMps) {
      m.free_s =
          vision::corridor::free_time_s(m.view->points, m.view->v_H, m.radius_m + config_.margin_m, config_.gap.least);
      if (m.view->approach && m.view->approach->rate_per_s > 0.0) {
        m.free_s = std::min(m.free_s, 1.0 / m.view->approach->rate_per_s);
      }
    }
    if (std::isnan(m.view->error)) {
      ++m.unknown;
      return true;
    }
    const vision::corridor::Gap gap = vision::corridor::gap_ahead(m.view->points, config_.gap);
    const bool follows = m.known_ns >= 0 && seconds(observation.t_ns - m.known_ns) <= config_.patience_s;
    const double share =
        follows ? -std::expm1(-seconds(observation.t_ns - m.known_ns) / std::max(config_.smoothing_s, 1e-9)) : 1.0;
    const auto follow = [share](double& known_m, double seen_m, double median_m) {
      const double now_m = std::isnan(seen_m) ? median_m : seen_m;
      known_m = share < 1.0 ? known_m + share * (now_m - known_m) : now_m;
    };
    follow(m.gap.left_m, gap.left_m, m.view->left.distance_m);
    follow(m.gap.right_m, gap.right_m, m.view->right.distance_m);
    m.known_ns = observation.t_ns;
    return true;
  }

  /// [Zingg2010] sec. V-C. Differs: the height is held with the height sensor, and without walls in sight it hovers.
  Command steer_as_printed(const Observation& observation, bool fresh, double dt_s) {
    Memory& m = memory_;
    if (!m.heading_rad) m.heading_rad = heading_rad(observation.navigation.q_WB_est);
    m.heading_rad = *m.heading_rad + m.control * dt_s;  // roll, rad, and turn rate, rad/s, are the same number
    if (!fresh && seconds(m.t_ns - m.begun_ns) > config_.probe_s) {
      m.status = "blind";
      m.control = 0.0;
      m.last_error.reset();
      m.heading_rad.reset();
      return HoverCommand{};
    }
    m.status = fresh ? "cruise" : "probe";
    const bool due = m.sampled_ns < 0 || seconds(m.t_ns - m.sampled_ns) >= config_.sample_s - 1e-6;
    if (fresh && due && !std::isnan(m.view->error)) {
      m.control = printed_control(config_.gains, m.view->error, m.last_error.value_or(m.view->error));
      m.last_error = m.view->error;
      m.sampled_ns = m.t_ns;
    }
    return AttitudeCommand{m.control, -config_.pitch_rad, *m.heading_rad, -observation.goal.p_WG.z()};
  }

  /// Towards the middle of the gap ahead; turned away from what blocks the way; slowly where nothing is known yet.
  Command pursue(const Observation& observation, bool fresh, bool looked, double dt_s) {
    Memory& m = memory_;
    const NavigationState& navigation = observation.navigation;
    const double heading = heading_rad(navigation.q_WB_est);
    if (m.turn_from_rad) {
      if (std::abs(std::remainder(heading - *m.turn_from_rad, 2.0 * M_PI)) < kTurnRad) return turn_away();
      m.turn_from_rad.reset();
      m.known_ns = m.probing_ns = m.dark_ns = -1;  // what was known was known of another direction
      fresh = false;
    }
    const double ahead_m = m.free_s * (m.view ? m.view->v_H.norm() : 0.0) - m.radius_m - config_.margin_m;
    const bool blank = m.dark_ns >= 0 && seconds(m.t_ns - m.dark_ns) > config_.patience_s;
    if (blank || (m.view && std::isfinite(m.free_s) && ahead_m <= 0.0)) {
      m.turn_from_rad = heading;
      m.turn = m.gap.right_m < m.gap.left_m ? -1.0 : 1.0;
      return turn_away();
    }
    double speed_mps = config_.probe_mps, course_rad = 0.0;
    if (fresh) {
      m.probing_ns = -1;
      m.status = "cruise";
      const double aside_m = std::min(m.gap.left_m, m.gap.right_m) - m.radius_m;
      const double free_m = std::isfinite(m.free_s) ? ahead_m : std::numeric_limits<double>::infinity();
      speed_mps = std::max(config_.probe_mps, clearance_speed_mps(aside_m, free_m, config_.speed));
      // As far off the walls' direction, not the heading, which follows the course and would turn on and on.
      const double walls_rad = m.view->direction_rad, most_rad = config_.most_course_rad;
      course_rad = pursuit_course_rad(m.gap, config_.lookahead_m, most_rad);
      course_rad = std::clamp(course_rad, walls_rad - most_rad, walls_rad + most_rad);
    } else {
      if (m.probing_ns < 0) m.probing_ns = m.t_ns;
      const int least = config_.sight.least_vectors;
      const bool corners = m.view && m.view->corners_left >= least && m.view->corners_right >= least;
      const bool patient = seconds(m.t_ns - m.probing_ns) <= config_.probe_s;
      if (!looked || !corners || !patient) {
        m.status = "blind";
        m.heading_rad.reset();
        return HoverCommand{};
      }
      m.status = "probe";
    }
    m.course_rad = course_rad;
    const double way_rad = std::remainder(heading + course_rad, 2.0 * M_PI);
    if (!m.heading_rad) m.heading_rad = heading;
    const double share = -std::expm1(-dt_s / std::max(config_.heading_s, 1e-9));
    m.heading_rad =
        std::remainder(*m.heading_rad + share * std::remainder(way_rad - *m.heading_rad, 2.0 * M_PI), 2.0 * M_PI);
    return VelocityCommand{speed_mps * Eigen::Vector2d(std::cos(way_rad), std::sin(way_rad)),
                           -observation.goal.p_WG.z(), *m.heading_rad};
  }

  Command turn_away() {
    memory_.heading_rad.reset();
    memory_.status = "blocked";
    return HoverCommand{memory_.turn * config_.yaw_rate_radps};
  }

  std::vector<Metric> do_metrics() const override {
    std::vector<int> vectors = memory_.vectors;
    std::ranges::sort(vectors);
    const auto images = static_cast<double>(vectors.size());
    return {{"vectors_median", vectors.empty() ? 0.0 : vectors[vectors.size() / 2], ""},
            {"unknown_share", vectors.empty() ? 1.0 : memory_.unknown / images, ""},
            {"hover_time_s", memory_.hover_s, "s"}};
  }

  cv::Mat do_annotate() const override {
    if (!sight_ || sight_->image().empty()) return {};
    const CorridorView* view = memory_.view ? &*memory_.view : nullptr;
    CorridorScene scene{view, memory_.gap, memory_.course_rad, memory_.radius_m, memory_.status};
    if (view) {
      scene.caption += "  vectors " + std::to_string(view->left.count) + " + " + std::to_string(view->right.count);
      if (!std::isnan(view->error))
        scene.caption += "  error " + std::to_string(std::lround(100.0 * view->error)) + " %";
    }
    return corridor_overlay(*sight_, scene);
  }

  static constexpr double kTurnRad = 25.0 * std::numbers::pi / 180.0;  ///< then what lies ahead is another thing

  /// All that changes in flight.
  struct Memory {
    double radius_m = 0.0;
    std::optional<CorridorView> view;  ///< of the last image
    vision::corridor::Gap gap{kUnknown, kUnknown};
    double free_s = std::numeric_limits<double>::infinity();  ///< until the hull meets what lies straight ahead
    int64_t t_ns = -1, begun_ns = -1;
    int64_t known_ns = -1;    ///< when both sides were known last
    int64_t probing_ns = -1;  ///< since when they have not been
    int64_t dark_ns = -1;     ///< since when, flying, nothing was known of what lies ahead
    const char* status = "wait";
    std::optional<double> course_rad;  ///< to the right of the heading

    std::optional<double> heading_rad;  ///< the nose's, commanded

    double control = 0.0;  ///< printed: roll, rad, and turn rate, rad/s
    std::optional<double> last_error;
    int64_t sampled_ns = -1;

    std::optional<double> turn_from_rad;  ///< heading at which the way was blocked
    double turn = 1.0;                    ///< to the right

    std::vector<int> vectors;  ///< good ones of both sides, image by image
    int unknown = 0;           ///< images without an error
    double hover_s = 0.0;
  };

  CorridorCenteringConfig config_;
  std::optional<CorridorSight> sight_;
  Memory memory_;
};

}  // namespace

std::unique_ptr<Module> make_corridor_centering(const CorridorCenteringConfig& config) {
  return std::make_unique<CorridorCentering>(config);
}

}  // namespace hedgehop::avoidance::corridor_centering
