#include "sim/link/mavlink_channel.h"

#include <fmt/format.h>

#include <stdexcept>
#include <variant>

#include "sim/config/input_error.h"
#include "sim/libm/random.h"

namespace hedgehop::sim::link {
namespace {

mavlink::CompanionSetup companion_setup(const Scenario& scenario, mavlink::AutopilotMake make) {
  mavlink::CompanionSetup setup{.make = make};
  // The stand is surveyed. Autopilots put the origin of their local frame where they start.
  setup.p_start_W = scenario.start.draw_p_WB(stream_seed(scenario.world(), "start"));
  setup.p_origin_W = setup.p_start_W;
  if (const std::optional<double> stand_m = stand_altitude_m(scenario)) setup.p_origin_W.z() = -*stand_m;
  setup.start_heading_rad = scenario.start.heading_rad;
  setup.has_interlock = std::holds_alternative<dynamics::helicopter::HelicopterConfig>(scenario.vehicle);
  return setup;
}

}  // namespace

MavlinkChannel::MavlinkChannel(const Scenario& scenario, mavlink::AutopilotMake make,
                               const mavlink::CompanionConfig& config)
    : config_(config), setup_(companion_setup(scenario, make)), physics_rate_hz_(scenario.physics_rate_hz.value()) {}

void MavlinkChannel::prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) {
  setup_.needs = needs;
  setup_.module = setup;
  try {
    companion_.emplace(config_, setup_);
  } catch (const std::invalid_argument& error) {
    throw InputError(FieldError{"link.companion", error.what()});
  }
}

void MavlinkChannel::receive(const OutsideInput& now, std::span<const uint8_t> bytes) {
  if (!bytes.empty()) companion_->receive(bytes);
  if (now.observation) companion_->observe(t_ns(now), *now.observation);
}

void MavlinkChannel::send(const OutsideInput& now, std::vector<uint8_t>& bytes) {
  companion_->send(t_ns(now), now.navigation, now.command, bytes);
}

std::string MavlinkChannel::awaited() const {
  if (!companion_) return "";
  const std::string awaited = companion_->awaited(), fault = companion_->fault();
  return awaited.empty() || fault.empty() ? awaited : fmt::format("{} ({})", awaited, fault);
}

int64_t MavlinkChannel::malformed() const {
  return companion_ ? companion_->counts().malformed + companion_->counts().signed_frames : 0;
}

/// Returns the autopilot's time, which runs from the first step.
int64_t MavlinkChannel::t_ns(const OutsideInput& now) const { return now.step * 1'000'000'000 / physics_rate_hz_; }

}  // namespace hedgehop::sim::link
