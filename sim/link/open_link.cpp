#include "sim/link/open_link.h"

#include <utility>

#include "sim/link/ardupilot_link.h"

namespace hedgehop::sim::link {
namespace {

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

std::unique_ptr<OutsideAutopilot> open_link(const Scenario& scenario, const LinkOptions& options,
                                            MessageChannel* channel) {
  const std::filesystem::path recording = options.out / kRecordingName;
  if (!options.replay.empty()) {
    return std::make_unique<ArduPilotLink>(scenario, std::make_unique<ReplaySource>(options.replay), channel,
                                           is_same_file(options.replay, recording) ? "" : recording);
  }
  ArduPilotLinkConfig config = ardupilot_config(scenario);
  config.instance += options.worker;
  auto source = std::make_unique<SocketSource>(config, options.bind);
  if (!config.command.empty()) {
    source->own(std::make_unique<ChildProcess>(
        filled_command(config.command, config.instance, config.udp_port(), scenario.seed), options.out / "autopilot",
        options.out / "autopilot.log"));
  }
  return std::make_unique<ArduPilotLink>(scenario, std::move(source), channel, recording);
}

std::unique_ptr<OutsideAutopilot> recorded_link(const Scenario& scenario, const std::filesystem::path& run_folder) {
  if (!scenario.link) return nullptr;
  return std::make_unique<ArduPilotLink>(scenario, std::make_unique<ReplaySource>(run_folder / kRecordingName));
}

}  // namespace hedgehop::sim::link
