#include "avoidance/registry.h"

namespace hedgehop::avoidance {
namespace {

struct Make {
  std::unique_ptr<Module> operator()(const GoToGoalConfig& c) const { return make_go_to_goal(c); }
  std::unique_ptr<Module> operator()(const FlowBalanceConfig& c) const { return make_flow_balance(c); }
  std::unique_ptr<Module> operator()(const SectionGridConfig& c) const { return make_section_grid(c); }
  std::unique_ptr<Module> operator()(const StereoCorridorConfig& c) const { return make_stereo_corridor(c); }
  std::unique_ptr<Module> operator()(const CorridorCenteringConfig& c) const { return make_corridor_centering(c); }
  std::unique_ptr<Module> operator()(const LandmarkMapModuleConfig& c) const { return make_landmark_map(c); }
};

}  // namespace

std::unique_ptr<Module> make_module(const ModuleConfig& config) { return std::visit(Make{}, config); }

}  // namespace hedgehop::avoidance
