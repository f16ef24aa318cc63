#include "avoidance/section_grid/section_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "avoidance/section_grid/section_pilot.h"
#include "avoidance/stereo/depth_overlay.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "avoidance/stereo/stereo_sight.h"
#include "vision/stereo/depth_pyramid.h"

namespace hedgehop::avoidance::section_grid {
namespace {

constexpr const char* kDepthRole = "depth";
constexpr double kDepthBaselineM = 0.25;  // of the pair that would have seen the depth that a camera knows

void check(const SectionGridConfig& c) {
  const auto need = [](bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(std::string("section_grid: ") + message);
  };
  need(c.threshold_m > 0.0, "threshold must be above 0 m");
  need(c.threshold_time_s >= 0.0, "threshold_time must be at least 0 s");
  need(c.most_share >= 0.0 && c.most_share <= 1.0, "most_share must lie in [0, 1]");
  need(c.speck_px >= 0, "speck must be at least 0 px");
  need(c.passed.radius_m >= 0.0, "passed needs a radius of at least 0");
  need(c.passed.near_m > 0.0 && c.passed.keep_s > 0.0, "passed needs near and keep above 0");
}

class SectionGridModule final : public Module {
 public:
  explicit SectionGridModule(const SectionGridConfig& config) : config_(config), pilot_(config.pilot) { check(config); }

 private:
  using State = SectionPilot::State;

  Needs do_needs() const override {
    if (config_.sight == SectionGridConfig::Sight::stereo) return stereo::StereoSight::needs();
    return {{{kDepthRole, CameraNeed::Channel::depth, /*pinhole=*/true}}};
  }

  std::vector<Signal> do_signals() const override {
    return {{"section", ""}, {"threat_share", ""}, {"unknown_share", ""}, {"rows_above_center", ""}};
  }

  void do_reset(const Setup& setup) override {
    sight_.reset();
    if (config_.sight == SectionGridConfig::Sight::stereo) {
      sight_.emplace(config_.stereo, setup);
      camera_ = {sight_->geometry(), sight_->X_BC(), sight_->image()};
    } else {
      const auto camera = std::ranges::find(setup.cameras, kDepthRole, &MountedCamera::role);
      const vision::camera::PinholeCamera lens = camera->model.pinhole();
      camera_ = {{lens.focal_x_px, lens.center_u_px, lens.center_v_px, kDepthBaselineM},
                 camera->X_BC,
                 {lens.width_px, lens.height_px}};
    }
    search_.emplace(config_.grid, camera_.image);
    pilot_.reset(camera_);
    passed_.emplace(config_.passed);
    depth_m_ = cv::Mat(camera_.image, CV_32FC1, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
    hull_ahead_m_ = std::max(0.0, setup.limits.radius_m - camera_.X_BC.translation().x());
    last_.reset();
    hover_s_ = 0.0;
    rejected_ = 0;
    rows_above_ = most_rows_above_ = 0;
    t_ns_ = -1;
  }

  Decision do_update(const Observation& observation) override {
    const bool looked = look(observation.frames);
    if (!looked && last_) return *last_;
    if (looked && config_.passed.radius_m > 0.0) remember(observation);
    const double speed_mps = observation.navigation.v_WB_B_est.norm();
    const double threshold_m = std::max(config_.threshold_m, hull_ahead_m_ + config_.threshold_time_s * speed_mps);
    choice_ = search_->choose(depth_m_, threshold_m, config_.most_share, config_.unknown, [&](int section) {
      const NavigationState& navigation = observation.navigation;
      return passed_->free(pilot_.place(navigation, *search_, section, threshold_m) - navigation.p_WB_est);
    });
    for (size_t i = 0; i < search_->sections().size(); ++i) {
      rejected_ += search_->threats()[i] > config_.most_share * search_->sections()[i].area();
    }
    Decision decision;
    decision.command =
        pilot_.update({*search_, choice_, *passed_, threshold_m, observation.navigation}, observation.goal);
    if (pilot_.state() == State::hover_and_yaw && t_ns_ >= 0)
      hover_s_ += 1e-9 * static_cast<double>(observation.t_ns - t_ns_);
    t_ns_ = observation.t_ns;
    decision.status = name_of(pilot_.state());
    const double unknown = 1.0 - cv::countNonZero(depth_m_ >= 0.0) / static_cast<double>(depth_m_.total());
    const int cols = config_.grid.cols;
    if (choice_.section >= 0) rows_above_ = search_->center() / cols - choice_.section / cols;
    most_rows_above_ = std::max(most_rows_above_, rows_above_);
    decision.signals = {static_cast<double>(choice_.section), choice_.share, unknown, static_cast<double>(rows_above_)};
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
      case State::hover_and_yaw:
        return "hover_and_yaw";
    }
    throw std::logic_error("unknown state");
  }

  /// Brings the depth image up to date. @return whether there is a new one.
  bool look(std::span<const CameraFrame> frames) {
    if (sight_) {
      if (!sight_->update(frames)) return false;
      constexpr int kSameSegment16 = 32;  // two pixels of disparity
      vision::stereo::remove_specks(sight_->disparity16(), kSameSegment16, config_.speck_px);
      vision::stereo::to_depth(sight_->disparity16(), camera_.geometry, depth_m_);
      return true;
    }
    const auto frame = std::ranges::find(frames, kDepthRole, &CameraFrame::role);
    if (frame == frames.end()) return false;
    frame->image.copyTo(depth_m_);
    return true;
  }

  /// Takes the newest image in, that what leaves the next ones is not forgotten.
  void remember(const Observation& observation) {
    constexpr int kBlockLevel = 3;  // blocks of 8 px
    const NavigationState& navigation = observation.navigation;
    pyramid_.build(sight_ ? sight_->disparity16() : known_disparity16(), kBlockLevel);
    passed_->update(observation.t_ns, pyramid_, camera_.geometry,
                    Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * camera_.X_BC);
  }

  /// The disparity that a pair would have seen.
  cv::Mat known_disparity16() const {
    cv::Mat disparity, disparity16;
    cv::divide(camera_.geometry.disparity16(1.0), depth_m_, disparity);
    disparity.setTo(vision::stereo::kNoDisparity, disparity != disparity);
    disparity.convertTo(disparity16, CV_16S);
    return disparity16;
  }

  std::vector<Metric> do_metrics() const override {
    return {{"sections_rejected", static_cast<double>(rejected_), ""},
            {"hover_time_s", hover_s_, "s"},
            {"most_rows_above_center", static_cast<double>(most_rows_above_), ""},
            {"last_rows_above_center", static_cast<double>(rows_above_), ""}};
  }

  cv::Mat do_annotate() const override {
    if (t_ns_ < 0) return {};
    cv::Mat image = stereo::depth_overlay(depth_m_, 2.0 * config_.threshold_m);
    const bool found = choice_.section >= 0;
    const cv::Rect& winner = search_->sections()[static_cast<size_t>(choice_.best)];
    const cv::Scalar green(90, 230, 110), red(240, 80, 60);
    cv::rectangle(image, winner, found ? green : red, 2);
    cv::drawMarker(image, {winner.x + winner.width / 2, winner.y + winner.height / 2}, found ? green : red);
    stereo::caption(image, std::string(name_of(pilot_.state())) + "  section " + std::to_string(choice_.section) +
                               "  threats " + std::to_string(std::lround(100.0 * choice_.share)) + " %");
    return image;
  }

  SectionGridConfig config_;
  std::optional<stereo::StereoSight> sight_;  ///< none when depth is known
  SectionCamera camera_;
  std::optional<vision::sections::SectionSearch> search_;
  cv::Mat depth_m_;
  vision::sections::SectionChoice choice_;
  SectionPilot pilot_;
  vision::stereo::DepthPyramid pyramid_;
  std::optional<stereo::PassedObstacles> passed_;
  std::optional<Decision> last_;
  int64_t t_ns_ = -1, rejected_ = 0;
  double hover_s_ = 0.0;
  int rows_above_ = 0, most_rows_above_ = 0;  ///< of the chosen section, from the center's row
  double hull_ahead_m_ = 0.0;                 ///< how far the vehicle reaches before the camera
};

}  // namespace

std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config) {
  return std::make_unique<SectionGridModule>(config);
}

}  // namespace hedgehop::avoidance::section_grid
