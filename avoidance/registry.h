#pragma once

#include <memory>
#include <variant>

#include "avoidance/corridor_centering/corridor_centering.h"
#include "avoidance/flow_balance/flow_balance.h"
#include "avoidance/flow_balance/zig_zag.h"
#include "avoidance/go_to_goal.h"
#include "avoidance/landmark_map/landmark_map.h"
#include "avoidance/local_map/local_map.h"
#include "avoidance/module.h"
#include "avoidance/policy/onnx_policy.h"
#include "avoidance/section_grid/section_grid.h"
#include "avoidance/stereo_corridor/stereo_corridor.h"

namespace hedgehop::avoidance {

/// The modules of this tree: one config struct per row. `kName` is the name of the module in a scenario.
using ModuleConfig = std::variant<GoToGoalConfig, flow_balance::FlowBalanceConfig, flow_balance::ZigZagConfig,
                                  section_grid::SectionGridConfig, stereo_corridor::StereoCorridorConfig,
                                  corridor_centering::CorridorCenteringConfig, landmark_map::LandmarkMapModuleConfig,
                                  local_map::LocalMapConfig, policy::OnnxPolicyConfig>;

/// Returns the module of a config, with a blindness monitor (blind_stop.h). Call reset() before update(). Throws
/// std::invalid_argument on a bad config.
std::unique_ptr<Module> make_module(const ModuleConfig& config);

}  // namespace hedgehop::avoidance
