#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avoidance/camera_flow.h"
#include "avoidance/module.h"
#include "vision/flow/wall_flow.h"

namespace hedgehop::avoidance::flow_balance {

struct WallOptions {
  double flow_noise_px = 0.1;   ///< standard deviation of a flow vector, per axis, > 0
  double relative_error = 0.3;  ///< of a wall's distance, at most; > 0
};

/// Returns the upright walls round a vehicle by the newest flow of all its cameras, in frame H (B turned level, x along
/// the heading). Tilt is left out: the cameras' axes are taken level as they are mounted in B.
/// @param cameras  derotated, looking level. @param now_ns  measures that are too old by then are left aside.
std::vector<vision::flow::WallEstimate> walls_round(std::span<const CameraFlow> cameras,
                                                    const NavigationState& navigation, int64_t now_ns,
                                                    const WallOptions& options);

}  // namespace hedgehop::avoidance::flow_balance
