#include "avoidance/section_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "avoidance/depth_picture.h"
#include "avoidance/heading.h"
#include "avoidance/stereo_sight.h"

namespace hedgehop::avoidance {
namespace {

constexpr const char* kDepthRole = "depth";

void check(const SectionGridConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("section_grid: ") + message);
  };
  need(c.threshold_m > 0.0, "threshold must be above 0 m");
  need(c.most_share >= 0.0 && c.most_share <= 1.0, "most_share must lie in [0, 1]");
  need(c.aligned_rad > 0.0, "aligned must be above 0 deg");
  need(c.arrived_m > 0.0, "arrived must be above 0 m");
  need(c.yaw_rate_radps > 0.0, "yaw_rate must be above 0 deg/s");
  need(c.speck_px >= 0, "speck must be at least 0 px");
}

class SectionGridModule final : public Module {
 public:
  explicit SectionGridModule(const SectionGridConfig& config) : config_(config) { check(config); }

 private:
  enum class State { cruise, avoid, resume, look_round };

  Needs do_needs() const override {
    if (config_.sight == SectionGridConfig::Sight::stereo) return StereoSight::needs();
    return {{{kDepthRole, CameraNeed::Channel::depth, /*pinhole=*/true}}};
  }

  std::vector<Signal> do_signals() const override {
    return {{"section", ""}, {"threat_share", ""}, {"unknown_share", ""}};
  }

  void do_reset(const Setup& setup) override {
    sight_.reset();
    cv::Size picture;
    if (config_.sight == SectionGridConfig::Sight::stereo) {
      sight_.emplace(config_.stereo, setup);
      geometry_ = sight_->geometry();
      X_BC_ = sight_->X_BC();
      picture = sight_->picture();
    } else {
      const auto camera = std::ranges::find(setup.cameras, kDepthRole, &MountedCamera::role);
      const vision::PinholeCamera lens = camera->model.pinhole();
      geometry_ = {lens.focal_x_px, lens.center_u_px, lens.center_v_px, /*baseline_m=*/1.0};
      X_BC_ = camera->X_BC;
      picture = {lens.width_px, lens.height_px};
    }
    search_.emplace(config_.grid, picture);
    depth_m_ = cv::Mat(picture, CV_32FC1, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
    centre_ = search_->choose(depth_m_, config_.threshold_m, 1.0, vision::Unknown::free).section;
    state_ = State::cruise;
    aside_W_.reset();
    held_W_.reset();
    last_.reset();
    hover_s_ = 0.0;
    rejected_ = 0;
    t_ns_ = -1;
  }

  Decision do_update(const Observation& observation) override {
    if (!look(observation.frames) && last_) return *last_;
    choice_ = search_->choose(depth_m_, config_.threshold_m, config_.most_share, config_.unknown);
    for (size_t i = 0; i < search_->sections().size(); ++i) {
      rejected_ += search_->threats()[i] > config_.most_share * search_->sections()[i].area();
    }
    Decision decision;
    decision.command = steer(observation);
    if (state_ == State::look_round && t_ns_ >= 0) hover_s_ += 1e-9 * static_cast<double>(observation.t_ns - t_ns_);
    t_ns_ = observation.t_ns;
    decision.status = name_of(state_);
    const double unknown = 1.0 - cv::countNonZero(depth_m_ >= 0.0) / static_cast<double>(depth_m_.total());
    decision.signals = {static_cast<double>(choice_.section), choice_.share, unknown};
    last_ = decision;
    return decision;
  }

  static const char* name_of(State state) {
    switch (state) {
      case State::cruise:
        return "cruise";
      case State::avoid:
        return "avoid";
      case State::resume:
        return "resume";
      case State::look_round:
        return "look_round";
    }
    throw std::logic_error("unknown state");
  }

  /// Brings the depth picture up to date. @return whether there is a new one.
  bool look(std::span<const CameraFrame> frames) {
    if (sight_) {
      if (!sight_->update(frames)) return false;
      constexpr int kSameSegment16 = 32;  // two pixels of disparity
      vision::remove_specks(sight_->disparity16(), kSameSegment16, config_.speck_px);
      vision::to_depth(sight_->disparity16(), geometry_, depth_m_);
      return true;
    }
    const auto frame = std::ranges::find(frames, kDepthRole, &CameraFrame::role);
    if (frame == frames.end()) return false;
    frame->image.copyTo(depth_m_);
    return true;
  }

  /// [Perez2018] sec. on movement. Differs: on its way to a position aside the vehicle takes a better choice only where
  /// the way ahead is no way out any more; else every pixel's change would put the position off again.
  Command steer(const Observation& observation) {
    const Eigen::Vector3d& p_WB = observation.navigation.p_WB_est;
    if (choice_.section < 0) {
      if (state_ != State::look_round) turn_ = section_ray(choice_.best).x() < 0.0 ? -1.0 : 1.0;
      state_ = State::look_round;
      aside_W_.reset();
      return HoverCommand{turn_ * config_.yaw_rate_radps};
    }
    const bool new_way = choice_.section != centre_ || state_ == State::look_round;
    const bool arrived = aside_W_ && (*aside_W_ - p_WB).norm() < config_.arrived_m;
    if (new_way && (!aside_W_ || arrived || (turns() && !ahead_is_free()))) {
      aside_W_ = place(observation.navigation, choice_.section);
      state_ = State::avoid;
    } else if (arrived) {
      aside_W_.reset();
      state_ = State::resume;
    }
    if (aside_W_ && !turns()) return PositionCommand{*aside_W_, heading_rad(observation.navigation.q_WB_est)};
    if (aside_W_) return go_to(*aside_W_, observation);
    const Command command = go_to(observation.goal.p_WG, observation);
    if (!held_W_) state_ = State::cruise;
    return command;
  }

  /// Direction of a section's centre in C, of length 1.
  Eigen::Vector3d section_ray(int section) const {
    const cv::Rect& s = search_->sections()[static_cast<size_t>(section)];
    return geometry_.ray({s.x + s.width / 2, s.y + s.height / 2}).normalized();
  }

  /// Where to go about a threat: as a rule a threshold's distance ahead in the section's direction.
  Eigen::Vector3d place(const NavigationState& navigation, int section) const {
    using Answer = SectionGridConfig::Answer;
    const Eigen::Vector3d ray_B = X_BC_.linear() * section_ray(section);
    const double side = ray_B.y() < 0.0 ? -1.0 : 1.0;
    Eigen::Vector3d p_BS_B = Eigen::Vector3d::Zero();
    switch (config_.answer) {
      case Answer::waypoint:
        p_BS_B = ray_B;
        break;
      case Answer::heading:
        p_BS_B = {ray_B.x(), ray_B.y(), 0.0};
        break;
      case Answer::sideways:
        p_BS_B.y() = side;
        break;
      case Answer::climb:
        p_BS_B.z() = -1.0;
        break;
      case Answer::combined:
        p_BS_B = {0.0, side, -1.0};
        break;
    }
    Eigen::Vector3d p_WS = navigation.p_WB_est + navigation.q_WB_est * (config_.threshold_m * p_BS_B.normalized());
    p_WS.z() = std::min(p_WS.z(), -config_.lowest_m);
    return p_WS;
  }

  bool ahead_is_free() const {
    const auto centre = static_cast<size_t>(centre_);
    return search_->threats()[centre] <= config_.most_share * search_->sections()[centre].area();
  }

  /// Whether the vehicle faces the places it goes to.
  bool turns() const {
    return config_.answer == SectionGridConfig::Answer::waypoint ||
           config_.answer == SectionGridConfig::Answer::heading;
  }

  /// Turns to face a place, waiting where it is, then moves there.
  Command go_to(const Eigen::Vector3d& p_W, const Observation& observation) {
    const Eigen::Vector3d& p_WB = observation.navigation.p_WB_est;
    const Eigen::Vector2d way_W = (p_W - p_WB).head<2>();
    const double now_rad = heading_rad(observation.navigation.q_WB_est);
    constexpr double kTooNearToFace_m = 1.0;
    const double bearing_rad = way_W.norm() > kTooNearToFace_m ? std::atan2(way_W.y(), way_W.x()) : now_rad;
    if (std::abs(std::remainder(bearing_rad - now_rad, 2.0 * M_PI)) > config_.aligned_rad) {
      if (!held_W_) held_W_ = p_WB;
      return PositionCommand{*held_W_, bearing_rad};
    }
    held_W_.reset();
    return PositionCommand{p_W, bearing_rad};
  }

  std::vector<Metric> do_metrics() const override {
    return {{"sections_rejected", static_cast<double>(rejected_), ""}, {"hover_time_s", hover_s_, "s"}};
  }

  cv::Mat do_annotate() const override {
    if (t_ns_ < 0) return {};
    cv::Mat picture = depth_picture(depth_m_, 2.0 * config_.threshold_m);
    const bool found = choice_.section >= 0;
    const cv::Rect& winner = search_->sections()[static_cast<size_t>(choice_.best)];
    const cv::Scalar green(90, 230, 110), red(240, 80, 60);
    cv::rectangle(picture, winner, found ? green : red, 2);
    cv::drawMarker(picture, {winner.x + winner.width / 2, winner.y + winner.height / 2}, found ? green : red);
    caption(picture, std::string(name_of(state_)) + "  section " + std::to_string(choice_.section) + "  threats " +
                         std::to_string(std::lround(100.0 * choice_.share)) + " %");
    return picture;
  }

  SectionGridConfig config_;
  std::optional<StereoSight> sight_;  ///< none when depth is known
  vision::StereoGeometry geometry_;
  Eigen::Isometry3d X_BC_ = Eigen::Isometry3d::Identity();
  std::optional<vision::SectionSearch> search_;
  cv::Mat depth_m_;
  int centre_ = 0;  ///< the section straight ahead
  vision::SectionChoice choice_;
  State state_ = State::cruise;
  double turn_ = 1.0;                       ///< to the right
  std::optional<Eigen::Vector3d> aside_W_;  ///< temporary position
  std::optional<Eigen::Vector3d> held_W_;   ///< where it waits while it turns
  std::optional<Decision> last_;
  int64_t t_ns_ = -1, rejected_ = 0;
  double hover_s_ = 0.0;
};

}  // namespace

std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config) {
  return std::make_unique<SectionGridModule>(config);
}

}  // namespace hedgehop::avoidance
