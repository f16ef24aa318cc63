#include "avoidance/registry.h"

#include "avoidance/blind_stop.h"

namespace hedgehop::avoidance {
namespace {

struct Make {
  std::unique_ptr<Module> operator()(const GoToGoalConfig& c) const { return make_go_to_goal(c); }
  std::unique_ptr<Module> operator()(const flow_balance::FlowBalanceConfig& c) const {
    return flow_balance::make_flow_balance(c);
  }
  std::unique_ptr<Module> operator()(const flow_balance::ZigZagConfig& c) const {
    return flow_balance::make_zig_zag(c);
  }
  std::unique_ptr<Module> operator()(const section_grid::SectionGridConfig& c) const {
    return section_grid::make_section_grid(c);
  }
  std::unique_ptr<Module> operator()(const stereo_corridor::StereoCorridorConfig& c) const {
    return stereo_corridor::make_stereo_corridor(c);
  }
  std::unique_ptr<Module> operator()(const corridor_centering::CorridorCenteringConfig& c) const {
    return corridor_centering::make_corridor_centering(c);
  }
  std::unique_ptr<Module> operator()(const landmark_map::LandmarkMapModuleConfig& c) const {
    return landmark_map::make_landmark_map(c);
  }
  std::unique_ptr<Module> operator()(const local_map::LocalMapConfig& c) const { return local_map::make_local_map(c); }
  std::unique_ptr<Module> operator()(const policy::OnnxPolicyConfig& c) const { return policy::make_onnx_policy(c); }
};

}  // namespace

std::unique_ptr<Module> make_module(const ModuleConfig& config) {
  return stopping_when_blind(std::visit(Make{}, config));
}

}  // namespace hedgehop::avoidance
