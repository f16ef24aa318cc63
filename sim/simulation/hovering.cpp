#include <fmt/format.h>

#include "sim/simulation/simulation.h"

namespace hedgehop::sim {
namespace {

class Hovering : public avoidance::Module {
 public:
  explicit Hovering(avoidance::Needs needs) : needs_(std::move(needs)) {}

 private:
  avoidance::Needs do_needs() const override { return needs_; }
  void do_reset(const avoidance::Setup&) override {}
  avoidance::Decision do_update(const avoidance::Observation&) override {
    return {avoidance::HoverCommand{}, "hover", {}};
  }
  avoidance::Needs needs_;
};

}  // namespace

ModuleMaker hovering(const RigConfig& rig, const std::vector<std::string>& roles) {
  avoidance::Needs needs;
  for (const std::string& role : roles) {
    const CameraConfig* const camera = rig.find(role);
    if (!camera) throw InputError(fmt::format("the rig has no camera '{}'", role));
    needs.cameras.push_back({role, camera->channel});
  }
  return [needs] { return std::make_unique<Hovering>(needs); };
}

}  // namespace hedgehop::sim
