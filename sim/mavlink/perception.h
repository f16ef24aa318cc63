#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "avoidance/module.h"
#include "sim/fields/field.h"
#include "sim/mavlink/frame.h"
#include "vision/stereo/stereo_matcher.h"

namespace hedgehop::sim::mavlink {

/// Messages about the surroundings and the vehicle's motion, for an autopilot.
struct PerceptionConfig {
  bool obstacle_distance = true, distance_sensor = true, optical_flow = true, vision_position = true, odometry = true;
  double min_m = 0.3, max_m = 20.0;
  double band_m = 0.5;
  vision::stereo::StereoMatcherConfig stereo;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PerceptionConfig> auto& c) {
  v("obstacle_distance", c.obstacle_distance,
    {.meaning = "OBSTACLE_DISTANCE: 72 sectors from the depth or stereo images of the module"});
  v("distance_sensor", c.distance_sensor, {.meaning = "DISTANCE_SENSOR: height above ground"});
  v("optical_flow", c.optical_flow,
    {.meaning = "OPTICAL_FLOW and OPTICAL_FLOW_RAD from the images of the module's camera that looks down"});
  v("vision_position", c.vision_position, {.meaning = "VISION_POSITION_ESTIMATE: estimated position and attitude"});
  v("odometry", c.odometry, {.meaning = "ODOMETRY: estimated position, attitude and velocities"});
  v("min", c.min_m, {.unit = "m", .at_least = 0.01, .at_most = 100.0, .meaning = "minimum range of a sector"});
  v("max", c.max_m, {.unit = "m", .at_least = 0.02, .at_most = 600.0, .meaning = "maximum range of a sector"});
  v("band", c.band_m,
    {.unit = "m",
     .above = 0.0,
     .at_most = 100.0,
     .meaning = "height above and below the hull in which obstacles count for the sectors"});
  v("stereo", c.stereo, {.meaning = "stereo matching for the sectors"});
}

/// Perception from the module's images and the estimate of its navigation, never from the truth. Times are those of the
/// autopilot.
class Perception {
 public:
  /// @param needs, setup  of the module: its cameras are the only ones. @param p_origin_W  origin of the autopilot's
  /// local frame in W, m. Throws std::invalid_argument on a bad config or if stereo cameras do not fit together.
  Perception(const PerceptionConfig& config, const avoidance::Needs& needs, const avoidance::Setup& setup,
             const Eigen::Vector3d& p_origin_W);
  Perception(Perception&&) noexcept;
  Perception& operator=(Perception&&) noexcept;
  ~Perception();

  /// Measures with the new images of an observation.
  void observe(int64_t t_ns, const avoidance::Observation& observation);
  /// Appends the messages that are due. Before the flight there is no estimate: then the sectors are unknown and the
  /// height is 0, so that the autopilot has readings for its checks before it arms.
  /// @param t_ns  time of the autopilot, rising. @param navigation  null before the flight.
  void send(int64_t t_ns, const avoidance::NavigationState* navigation, FrameWriter& writer,
            std::vector<uint8_t>& bytes);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hedgehop::sim::mavlink
