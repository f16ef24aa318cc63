#include "sim/loop/module_pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "avoidance/blind_stop.h"
#include "sim/config/input_error.h"
#include "sim/fields/quantities.h"
#include "sim/loop/setpoints.h"
#include "sim/loop/takeover.h"
#include "sim/loop/truth_used.h"
#include "sim/plugin/plugin_module.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

/// The module that decides, and the one that takes over from it where the scenario has one.
std::unique_ptr<avoidance::Module> crew(const Scenario& scenario, const Ticks& ticks,
                                        std::unique_ptr<avoidance::Module> module) {
  if (!module) module = make_module(scenario.avoidance);
  if (!scenario.takeover) return module;
  return build_part("takeover.avoidance", [&] {
    return make_takeover(std::move(module), make_module(scenario.takeover->avoidance),
                         ticks.t_ns(ticks.ticks(scenario.takeover->at_s)));
  });
}

void require_cameras(const RigConfig& rig, const avoidance::Needs& needs) {
  std::vector<std::string> faults;
  for (const avoidance::CameraNeed& need : needs.cameras) {
    for (const std::string& fault : rig.lacks(need.role, need.channel, need.pinhole)) {
      faults.push_back("'avoidance': " + fault);
    }
  }
  if (!faults.empty()) throw InputError(faults);
}

}  // namespace

ModulePilot::ModulePilot(const Scenario& scenario, const Ticks& ticks, Cameras& cameras,
                         std::unique_ptr<avoidance::Module> module)
    : scenario_(scenario),
      ticks_(ticks),
      cameras_(cameras),
      module_(crew(scenario, ticks, std::move(module))),
      truth_used_(sim::truth_used(module_->needs(), scenario.avionics)),
      route_(scenario) {
  require_cameras(scenario.rig, module_->needs());
  int64_t slowest = 0;
  for (const avoidance::CameraNeed& need : module_->needs().cameras) {
    module_cameras_.push_back(cameras_.index(need.role));
    slowest = std::max(slowest, cameras_.period_ticks(module_cameras_.back()));
  }
  // A module without cameras decides as often as the rig's fastest camera, so that a control compares like with like.
  decision_period_ = ticks_.period(static_cast<double>(scenario.control_rate_hz));
  for (size_t i = 0; i < cameras_.count(); ++i) {
    decision_period_ = i == 0 ? cameras_.period_ticks(i) : std::min(decision_period_, cameras_.period_ticks(i));
  }
  for (const size_t camera : module_cameras_) {
    const int64_t blind_ns = avoidance::blind_after_ns(cameras_.mounted(camera).rate_hz);
    blind_after_ = std::max(blind_after_, ticks_.ticks(seconds(blind_ns)));
  }
  latency_ =
      scenario.command_latency_s ? ticks_.ticks(*scenario.command_latency_s) : std::max(slowest, decision_period_);
}

void ModulePilot::reset(const std::vector<dynamics::HullPart>& hull, const dynamics::control::Setpoint& hold) {
  setpoint_ = hold;
  try {
    module_->reset(module_setup(scenario_, hull));
  } catch (const std::exception& fault) {
    throw InputError(fmt::format("'avoidance': the module cannot begin: {}", fault.what()));
  }
}

bool ModulePilot::looks(int64_t tick) const {
  return std::ranges::any_of(module_cameras_, [&](size_t camera) { return cameras_.due(camera, tick); });
}

void ModulePilot::look(int64_t tick, const BodyMotion& body) {
  seen_.clear();
  looked_ = false;
  for (const size_t camera : module_cameras_) {
    if (!cameras_.due(camera, tick)) continue;
    looked_ = true;
    if (const avoidance::CameraFrame* const frame = cameras_.expose(camera, ticks_.t_ns(tick), body)) {
      seen_.push_back(*frame);
      last_seen_ = tick;
    }
  }
}

bool ModulePilot::decides(int64_t tick) const {
  if (module_cameras_.empty()) return tick % decision_period_ == 0;
  return !seen_.empty() || (looked_ && tick - last_seen_ > blind_after_);
}

avoidance::Observation ModulePilot::observe(int64_t tick, const avoidance::NavigationState& navigation) {
  route_.update(navigation.p_WB_est);
  return {ticks_.t_ns(tick), seen_, navigation, route_.goal()};
}

avoidance::Decision ModulePilot::decide(int64_t tick, const avoidance::Observation& observation) {
  avoidance::Decision decision = module_->update(observation);
  send(tick, decision.command);
  return decision;
}

avoidance::Command ModulePilot::obey(int64_t tick, avoidance::Command command) {
  avoidance::confine(command, scenario_.avionics.autopilot.speed_limit_mps);
  send(tick, command);
  return command;
}

/// Over the link, which keeps the order.
void ModulePilot::send(int64_t tick, const avoidance::Command& command) {
  int64_t latency = latency_;
  if (const FailureConfig* failure = failure_of(scenario_.failures, "link", ticks_.t_ns(tick))) {
    if (failure->mode == FailureConfig::Mode::off) return;
    latency += ticks_.ticks(failure->value.value_or(0.0));
  }
  pending_.push_back({tick + latency, command});
}

const dynamics::control::Setpoint& ModulePilot::setpoint(int64_t tick) {
  while (!pending_.empty() && pending_.front().tick <= tick) {
    setpoint_ = to_setpoint(pending_.front().command);
    pending_.pop_front();
  }
  return setpoint_;
}

bool ModulePilot::sees_through_walls() const {
  const std::vector<avoidance::CameraNeed> cameras = module_->needs().cameras;
  return !cameras.empty() && cameras.front().channel == avoidance::CameraNeed::Channel::corners;
}

std::optional<size_t> ModulePilot::first_camera() const {
  return module_cameras_.empty() ? std::nullopt : std::optional(module_cameras_.front());
}

}  // namespace hedgehop::sim
