#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "avoidance/module.h"
#include "sim/mavlink/autopilot_state.h"
#include "sim/mavlink/companion_config.h"
#include "sim/mavlink/frame.h"

namespace hedgehop::sim::mavlink {

/// Perception from the module's images and the estimate of its navigation, never from the truth. Times are those of the
/// autopilot.
class Perception {
 public:
  /// @param needs, setup  of the module: its cameras are the only ones. @param p_origin_W  origin of the autopilot's
  /// local frame in W, m. @param make  decides the message for optic flow: ArduPilot publishes each of two messages as
  /// a reading of its own. Throws std::invalid_argument on a bad config or if stereo cameras do not fit together.
  Perception(const PerceptionConfig& config, const avoidance::Needs& needs, const avoidance::Setup& setup,
             const Eigen::Vector3d& p_origin_W, AutopilotMake make);
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
