#include "sim/mavlink/perception.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "avoidance/stereo/disparity_source.h"
#include "sim/mavlink/obstacle_sectors.h"
#include "sim/mavlink/perceived_messages.h"
#include "vision/flow/ground_velocity.h"
#include "vision/stereo/disparity.h"

namespace hedgehop::sim::mavlink {
namespace {

using avoidance::CameraNeed;
using avoidance::stereo::DisparitySource;

// ArduPilot takes a proximity sensor for broken after 0.5 s without a message; range finders and poses have rates of
// usual sensors.
constexpr int64_t kSectorsEveryNs = 100'000'000, kHeightEveryNs = 50'000'000, kPoseEveryNs = 40'000'000;
constexpr int64_t kSectorsLastNs = 500'000'000;  // older images do not count

/// Whether a message with this period is due; then the next one is due a period later, without drift.
class Period {
 public:
  explicit Period(int64_t period_ns) : period_ns_(period_ns) {}
  bool due(int64_t t_ns) {
    if (t_ns < next_ns_) return false;
    next_ns_ = (next_ns_ + period_ns_ > t_ns ? next_ns_ : t_ns) + period_ns_;
    return true;
  }

 private:
  int64_t period_ns_, next_ns_ = 0;
};

const avoidance::MountedCamera& mounted(const avoidance::Setup& setup, const std::string& role) {
  const auto camera = std::ranges::find(setup.cameras, role, &avoidance::MountedCamera::role);
  if (camera == setup.cameras.end()) throw std::invalid_argument("a camera '" + role + "' is needed");
  return *camera;
}

/// Returns the height band around Bo that contains the hull.
SectorLimits limits_of(const PerceptionConfig& config, const avoidance::VehicleLimits& vehicle) {
  SectorLimits limits{config.band_m, config.band_m, config.min_m, config.max_m};
  for (const Eigen::AlignedBox3d& part : vehicle.outline_B) {
    limits.above_m = std::max(limits.above_m, config.band_m - part.min().z());
    limits.below_m = std::max(limits.below_m, config.band_m + part.max().z());
  }
  return limits;
}

/// Sectors from one depth camera or one stereo pair.
class SectorSource {
 public:
  SectorSource(const CameraNeed& depth, const avoidance::Setup& setup, const SectorLimits& limits)
      : role_(depth.role), to_sectors_(mounted(setup, depth.role).model, mounted(setup, depth.role).X_BC, limits) {}
  SectorSource(const std::string& pair, const std::string& left, const avoidance::Setup& setup,
               const PerceptionConfig& config, const SectorLimits& limits)
      : to_sectors_(mounted(setup, left).model, mounted(setup, left).X_BC, limits) {
    stereo_.emplace(DisparitySource::From::stereo, DisparitySource::Grey::unused, config.stereo, setup, pair);
  }

  /// Uses only the images that the next message needs.
  void update(int64_t t_ns, const avoidance::Observation& observation) {
    if (seen_ns_ && t_ns - *seen_ns_ < kSectorsEveryNs - kJitterNs) return;
    if (stereo_) {
      if (!stereo_->update(observation.frames)) return;
      vision::stereo::remove_specks(stereo_->disparity16(), kSpeckDifference16, kSpeckPixels);
      cv::Mat depth_m;
      vision::stereo::to_depth(stereo_->disparity16(), stereo_->geometry(), depth_m);
      set(t_ns, depth_m, observation);
      return;
    }
    const auto frame = std::ranges::find(observation.frames, role_, &avoidance::CameraFrame::role);
    if (frame != observation.frames.end()) set(t_ns, frame->image, observation);
  }
  /// Returns the sectors of the last image; null if there is none or it is old.
  const ObstacleSectors* sectors(int64_t t_ns) const {
    return seen_ns_ && t_ns - *seen_ns_ <= kSectorsLastNs ? &sectors_ : nullptr;
  }

 private:
  // As in avoidance/local_map: segments of fewer pixels are mismatches.
  static constexpr int kSpeckDifference16 = 32, kSpeckPixels = 100;
  static constexpr int64_t kJitterNs = 1'000'000;

  void set(int64_t t_ns, const cv::Mat& depth_m, const avoidance::Observation& observation) {
    sectors_ = to_sectors_.sectors(depth_m, observation.navigation.q_WB_est);
    seen_ns_ = t_ns;
  }

  std::string role_;
  std::optional<DisparitySource> stereo_;
  DepthToSectors to_sectors_;
  ObstacleSectors sectors_;
  std::optional<int64_t> seen_ns_;
};

/// Returns the sources that the module's cameras permit: each depth camera, and each pair "left" and "right", with or
/// without a common prefix.
std::vector<SectorSource> sector_sources(const PerceptionConfig& config, const avoidance::Needs& needs,
                                         const avoidance::Setup& setup, const SectorLimits& limits) {
  std::vector<SectorSource> sources;
  const auto has_grey = [&](const std::string& role) {
    return std::ranges::any_of(needs.cameras, [&](const CameraNeed& need) {
      return need.role == role && need.channel == CameraNeed::Channel::grey;
    });
  };
  const std::string left_end = DisparitySource::kLeft, right_end = DisparitySource::kRight;
  for (const CameraNeed& need : needs.cameras) {
    if (need.channel == CameraNeed::Channel::depth) sources.emplace_back(need, setup, limits);
    if (need.channel != CameraNeed::Channel::grey || !need.role.ends_with(left_end)) continue;
    const std::string prefix = need.role.substr(0, need.role.size() - left_end.size());
    if (!prefix.empty() && !prefix.ends_with("_")) continue;
    const avoidance::MountedCamera& left = mounted(setup, need.role);
    if (!has_grey(prefix + right_end) || !left.model.is_undistorted_pinhole()) continue;
    const Eigen::Isometry3d X_CCr = left.X_BC.inverse() * mounted(setup, prefix + right_end).X_BC;
    constexpr double kParallelRad = 1e-6;  // side cameras are called left and right, too
    if (Eigen::AngleAxisd(X_CCr.linear()).angle() > kParallelRad) continue;
    sources.emplace_back(prefix.empty() ? "" : prefix.substr(0, prefix.size() - 1), need.role, setup, config, limits);
  }
  return sources;
}

/// Optical flow from the first camera of the module that looks down.
class FlowSource {
 public:
  explicit FlowSource(const avoidance::MountedCamera& camera)
      : role_(camera.role),
        focal_px_(camera.model.pinhole().focal_x_px),
        ground_(camera.model.pinhole(), camera.X_BC) {}

  static std::optional<FlowSource> find(const avoidance::Needs& needs, const avoidance::Setup& setup) {
    constexpr double kDown = 0.94;  // within 20 deg of the body's down axis
    for (const CameraNeed& need : needs.cameras) {
      if (need.channel != CameraNeed::Channel::grey) continue;
      const avoidance::MountedCamera& camera = mounted(setup, need.role);
      const bool looks_down = (camera.X_BC.linear() * Eigen::Vector3d::UnitZ()).z() > kDown;
      if (looks_down && camera.model.is_undistorted_pinhole()) return FlowSource(camera);
    }
    return {};
  }

  void update(const avoidance::Observation& observation) {
    const auto frame = std::ranges::find(observation.frames, role_, &avoidance::CameraFrame::role);
    if (frame == observation.frames.end()) return;
    const avoidance::NavigationState& navigation = observation.navigation;
    const auto reading = ground_.measure(
        frame->image, {frame->t_ns, navigation.q_WB_est, navigation.q_WB_gyro, navigation.height_above_ground_m});
    if (reading) flow_ = perceived_flow(*reading);
  }
  void send(int64_t t_ns, FrameWriter& writer, std::vector<uint8_t>& bytes) {
    if (!flow_) return;
    writer.append(optical_flow(t_ns, *flow_, focal_px_), bytes);
    writer.append(optical_flow_rad(t_ns, *flow_), bytes);
    flow_.reset();
  }

 private:
  std::string role_;
  double focal_px_;
  vision::flow::GroundVelocity ground_;
  std::optional<PerceivedFlow> flow_;  ///< not yet sent
};

}  // namespace

class Perception::Impl {
 public:
  Impl(const PerceptionConfig& config, const avoidance::Needs& needs, const avoidance::Setup& setup,
       const Eigen::Vector3d& p_origin_W)
      : config_(config), limits_(limits_of(config, setup.limits)), p_origin_W_(p_origin_W) {
    if (config.max_m <= config.min_m) throw std::invalid_argument("max: must be above min");
    if (config.obstacle_distance) sources_ = sector_sources(config, needs, setup, limits_);
    if (config.optical_flow) flow_ = FlowSource::find(needs, setup);
  }

  void observe(int64_t t_ns, const avoidance::Observation& observation) {
    for (SectorSource& source : sources_) source.update(t_ns, observation);
    if (flow_) flow_->update(observation);
  }

  void send(int64_t t_ns, const avoidance::NavigationState* navigation, FrameWriter& writer,
            std::vector<uint8_t>& bytes) {
    if (!sources_.empty() && sectors_.due(t_ns))
      writer.append(obstacle_distance(t_ns, sectors_at(t_ns), limits_), bytes);
    if (config_.distance_sensor && height_.due(t_ns)) {
      writer.append(navigation ? height_reading(t_ns, navigation->height_above_ground_m, navigation->q_WB_est)
                               : height_reading_on_ground(t_ns),
                    bytes);
    }
    if (flow_) flow_->send(t_ns, writer, bytes);
    if (!navigation || !pose_.due(t_ns)) return;
    if (config_.vision_position) writer.append(vision_position(t_ns, *navigation, p_origin_W_), bytes);
    if (config_.odometry) writer.append(odometry(t_ns, *navigation, p_origin_W_), bytes);
  }

 private:
  ObstacleSectors sectors_at(int64_t t_ns) const {
    ObstacleSectors all;
    for (const SectorSource& source : sources_) {
      if (const ObstacleSectors* const sectors = source.sectors(t_ns)) all.merge(*sectors);
    }
    return all;
  }

  PerceptionConfig config_;
  SectorLimits limits_;
  Eigen::Vector3d p_origin_W_;
  std::vector<SectorSource> sources_;
  std::optional<FlowSource> flow_;
  Period sectors_{kSectorsEveryNs}, height_{kHeightEveryNs}, pose_{kPoseEveryNs};
};

Perception::Perception(const PerceptionConfig& config, const avoidance::Needs& needs, const avoidance::Setup& setup,
                       const Eigen::Vector3d& p_origin_W)
    : impl_(std::make_unique<Impl>(config, needs, setup, p_origin_W)) {}
Perception::Perception(Perception&&) noexcept = default;
Perception& Perception::operator=(Perception&&) noexcept = default;
Perception::~Perception() = default;

void Perception::observe(int64_t t_ns, const avoidance::Observation& observation) { impl_->observe(t_ns, observation); }
void Perception::send(int64_t t_ns, const avoidance::NavigationState* navigation, FrameWriter& writer,
                      std::vector<uint8_t>& bytes) {
  impl_->send(t_ns, navigation, writer, bytes);
}

}  // namespace hedgehop::sim::mavlink
