#include "sim/mavlink/perception.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "sim/mavlink/obstacle_sectors.h"
#include "sim/mavlink/perceived_messages.h"
#include "sim/mavlink/sector_source.h"
#include "vision/flow/ground_velocity.h"

namespace hedgehop::sim::mavlink {
namespace {

using avoidance::CameraNeed;

// ArduPilot takes a proximity sensor for broken after 0.5 s without a message; range finders and poses have rates of
// usual sensors.
constexpr int64_t kSectorsEveryNs = SectorSource::kPeriodNs, kHeightEveryNs = 50'000'000, kPoseEveryNs = 40'000'000;

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

/// Returns the height band around Bo that contains the hull.
SectorLimits limits_of(const PerceptionConfig& config, const avoidance::VehicleLimits& vehicle) {
  SectorLimits limits{config.band_m, config.band_m, config.min_m, config.max_m};
  for (const Eigen::AlignedBox3d& part : vehicle.outline_B) {
    limits.above_m = std::max(limits.above_m, config.band_m - part.min().z());
    limits.below_m = std::max(limits.below_m, config.band_m + part.max().z());
  }
  return limits;
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
      const avoidance::MountedCamera& camera = avoidance::required_camera(setup, need.role);
      const bool looks_down = (camera.X_BC.linear() * Eigen::Vector3d::UnitZ()).z() > kDown;
      if (looks_down && camera.model.is_undistorted_pinhole()) return FlowSource(camera);
    }
    return {};
  }

  void update(const avoidance::Observation& observation) {
    const avoidance::CameraFrame* const frame = avoidance::find_frame(observation.frames, role_);
    if (!frame) return;
    const avoidance::NavigationState& navigation = observation.navigation;
    const auto reading = ground_.measure(
        frame->image, {frame->t_ns, navigation.q_WB_est, navigation.q_WB_gyro, navigation.height_above_ground_m});
    if (reading) flow_ = perceived_flow(*reading);
  }
  void send(int64_t t_ns, AutopilotMake make, FrameWriter& writer, std::vector<uint8_t>& bytes) {
    if (!flow_) return;
    if (make == AutopilotMake::ardupilot) {
      writer.append(optical_flow(t_ns, *flow_, focal_px_), bytes);
    } else {
      writer.append(optical_flow_rad(t_ns, *flow_), bytes);
    }
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
       const Eigen::Vector3d& p_origin_W, AutopilotMake make)
      : config_(config), limits_(limits_of(config, setup.limits)), p_origin_W_(p_origin_W), make_(make) {
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
    if (flow_) flow_->send(t_ns, make_, writer, bytes);
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
  AutopilotMake make_;
  std::vector<SectorSource> sources_;
  std::optional<FlowSource> flow_;
  Period sectors_{kSectorsEveryNs}, height_{kHeightEveryNs}, pose_{kPoseEveryNs};
};

Perception::Perception(const PerceptionConfig& config, const avoidance::Needs& needs, const avoidance::Setup& setup,
                       const Eigen::Vector3d& p_origin_W, AutopilotMake make)
    : impl_(std::make_unique<Impl>(config, needs, setup, p_origin_W, make)) {}
Perception::Perception(Perception&&) noexcept = default;
Perception& Perception::operator=(Perception&&) noexcept = default;
Perception::~Perception() = default;

void Perception::observe(int64_t t_ns, const avoidance::Observation& observation) { impl_->observe(t_ns, observation); }
void Perception::send(int64_t t_ns, const avoidance::NavigationState* navigation, FrameWriter& writer,
                      std::vector<uint8_t>& bytes) {
  impl_->send(t_ns, navigation, writer, bytes);
}

}  // namespace hedgehop::sim::mavlink
