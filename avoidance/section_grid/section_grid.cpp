#include "avoidance/section_grid/section_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>

#include "avoidance/section_grid/section_law.h"
#include "avoidance/section_grid/section_pilot.h"
#include "avoidance/section_grid/seen_space.h"
#include "avoidance/section_grid/upright_view.h"
#include "avoidance/stereo/depth_overlay.h"
#include "avoidance/stereo/passed_obstacles.h"
#include "sim/fields/bounds.h"
#include "sim/fields/quantities.h"
#include "vision/stereo/flight_corridor.h"

namespace hedgehop::avoidance::section_grid {
namespace {

using stereo::DisparitySource;

/// Lifetime of obstacles that have left the image: at 1 m/s the vehicle has then passed them.
constexpr double kKeepPassedS = 8.0;

class SectionGridModule final : public Module {
 public:
  explicit SectionGridModule(const SectionGridConfig& config) : config_(config), law_(config.lowest_m), pilot_(config) {
    fields::require_bounds(config);
  }

 private:
  bool is_modified() const { return config_.law == Law::modified; }
  State state() const { return is_modified() ? pilot_.state() : law_.state(); }

  Needs do_needs() const override {
    Needs needs = DisparitySource::needs(config_.depth, DisparitySource::Grey::unused);
    needs.commands = {CommandType::position};
    return needs;
  }

  std::vector<Signal> do_signals() const override {
    return {{"section", ""}, {"threat_share", ""}, {"unknown_share", ""}, {"rows_above_center", ""}};
  }

  void do_reset(const Setup& setup) override {
    source_.emplace(config_.depth, DisparitySource::Grey::unused, config_.stereo, setup);
    view_ = UprightView({source_->geometry(), source_->X_BC(), source_->image()});
    const SectionCamera& camera = view_.camera();
    search_.emplace(grid(), camera.image);
    law_.reset(camera);
    pilot_.reset(camera, setup.limits.radius_m);
    seen_.reset();
    passed_.emplace(stereo::PassedObstaclesConfig{.radius_m = is_modified() ? config_.passed_radius_m : 0.0,
                                                  .near_m = config_.threshold_m,
                                                  .keep_s = kKeepPassedS});
    depth_m_ = cv::Mat(camera.image, CV_32FC1, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
    hull_ahead_m_ = std::max(0.0, setup.limits.radius_m - camera.X_BC.translation().x());
    last_.reset();
    hover_s_ = 0.0;
    rejected_ = 0;
    rows_above_ = most_rows_above_ = 0;
    t_ns_ = -1;
  }

  vision::sections::SectionGrid grid() const {
    vision::sections::SectionGrid grid{.rows = config_.sections, .cols = config_.sections};
    if (!config_.overlapping) grid.width_share = grid.height_share = 1.0 / config_.sections;
    if (is_modified()) grid.grow_px = config_.grow_px;
    return grid;
  }

  Decision do_update(const Observation& observation) override {
    const bool is_new = read_depth(observation.frames);
    if (!is_new && last_) return *last_;
    const NavigationState& navigation = observation.navigation;
    if (is_new && is_modified()) remember(observation);
    const double threshold_m = threshold(navigation.v_WB_B_est.norm());
    choice_ = choose(navigation, threshold_m);

    Decision decision;
    const SectionView view{*search_, choice_, *passed_, seen_, threshold_m, navigation};
    decision.command = is_modified() ? pilot_.update(view, observation.goal) : law_.update(view, observation.goal);
    if (state() == State::hover_and_yaw && t_ns_ >= 0) {
      hover_s_ += seconds(observation.t_ns - t_ns_);
    }
    t_ns_ = observation.t_ns;
    decision.status = name_of(state());
    const double unknown = 1.0 - cv::countNonZero(depth_m_ >= 0.0) / static_cast<double>(depth_m_.total());
    const int cols = config_.sections;
    if (choice_.section >= 0) rows_above_ = search_->center() / cols - choice_.section / cols;
    most_rows_above_ = std::max(most_rows_above_, rows_above_);
    decision.signals = {static_cast<double>(choice_.section), choice_.share, unknown, static_cast<double>(rows_above_)};
    last_ = decision;
    return decision;
  }

  /// Updates the depth image. @return whether there is a new image.
  bool read_depth(std::span<const CameraFrame> frames) {
    if (!source_->update(frames)) return false;
    if (config_.depth == DisparitySource::From::camera) {
      source_->depth_m().copyTo(mounted_depth_m_);
      view_.rotate(mounted_depth_m_, depth_m_);
      return true;
    }
    constexpr int kSameSegment16 = 32;  // two pixels of disparity: the block matcher has about one pixel of noise
    vision::stereo::remove_specks(source_->disparity16(), kSameSegment16, config_.speck_px);
    vision::stereo::to_depth(source_->disparity16(), source_->geometry(), mounted_depth_m_);
    view_.rotate(mounted_depth_m_, depth_m_);
    return true;
  }

  /// Stores the newest image for the time after it has left the view.
  void remember(const Observation& observation) {
    const NavigationState& navigation = observation.navigation;
    const Eigen::Isometry3d X_WC = Eigen::Translation3d(navigation.p_WB_est) * navigation.q_WB_est * source_->X_BC();
    pyramid_.build(source_->disparity16(), SeenSpace::kBlockLevel);
    passed_->update(observation.t_ns, pyramid_, source_->geometry(), X_WC);
    seen_.update(observation.t_ns, pyramid_, source_->geometry(), X_WC);
  }

  /// Distance below which an obstacle is a threat, m. With the modified law it grows with speed.
  double threshold(double speed_mps) const {
    if (!is_modified()) return config_.threshold_m;
    return std::max(config_.threshold_m, hull_ahead_m_ + config_.threshold_time_s * speed_mps);
  }

  /// [Perez2018] sec. V-C. The modified law excludes sections that lead to obstacles that have left the image.
  vision::sections::SectionChoice choose(const NavigationState& navigation, double threshold_m) {
    std::function<bool(int)> open;
    if (is_modified()) {
      open = [&](int section) {
        return passed_->free(pilot_.position_W(navigation, *search_, section, threshold_m) - navigation.p_WB_est);
      };
    }
    // In the published law, a pixel without depth is no threat: it is usually sky or not visible in both images.
    const auto unknown = is_modified() ? config_.unknown : vision::sections::UnknownDepth::free;
    const vision::sections::SectionChoice choice =
        search_->choose(depth_m_, threshold_m, kMaxThreatShare, unknown, open);
    for (size_t i = 0; i < search_->sections().size(); ++i) {
      rejected_ += search_->threats()[i] > kMaxThreatShare * search_->sections()[i].area();
    }
    return choice;
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
    stereo::caption(image, std::string(name_of(state())) + "  section " + std::to_string(choice_.section) +
                               "  threats " + std::to_string(std::lround(100.0 * choice_.share)) + " %");
    return image;
  }

  SectionGridConfig config_;
  std::optional<DisparitySource> source_;
  UprightView view_;
  std::optional<vision::sections::SectionSearch> search_;
  cv::Mat mounted_depth_m_, depth_m_;  ///< of the camera as it is mounted, and upright
  vision::sections::SectionChoice choice_;
  SectionLaw law_;
  SectionPilot pilot_;
  vision::stereo::DepthPyramid pyramid_;
  std::optional<stereo::PassedObstacles> passed_;
  SeenSpace seen_;
  std::optional<Decision> last_;
  int64_t t_ns_ = -1, rejected_ = 0;
  double hover_s_ = 0.0;
  int rows_above_ = 0, most_rows_above_ = 0;  ///< of the chosen section, above the center's row
  double hull_ahead_m_ = 0.0;                 ///< extent of the hull in front of the camera
};

}  // namespace

std::unique_ptr<Module> make_section_grid(const SectionGridConfig& config) {
  return std::make_unique<SectionGridModule>(config);
}

}  // namespace hedgehop::avoidance::section_grid
