#include "sim/link/open_link.h"

#include <stdexcept>
#include <utility>
#include <variant>

#include "sim/link/ardupilot_link.h"
#include "sim/link/mavlink_channel.h"
#include "sim/link/px4_link.h"

namespace hedgehop::sim::link {
namespace {

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  return std::filesystem::equivalent(a, b, ignored);
}

template <class Config>
std::unique_ptr<ChildProcess> started(const Config& config, int64_t port, const Scenario& scenario,
                                      const std::filesystem::path& out) {
  return std::make_unique<ChildProcess>(
      filled_command(config.start.command, config.start.instance, port, scenario.seed), out / "autopilot",
      out / "autopilot.log");
}

/// Opens the link of each kind. A replay does not write over its own recording.
struct LinkOpening {
  const Scenario& scenario;
  const LinkOptions& options;

  std::filesystem::path recording() const {
    const std::filesystem::path file = options.out / kRecordingName;
    return options.out.empty() || is_same_file(options.replay, file) ? std::filesystem::path() : file;
  }

  std::unique_ptr<OutsideAutopilot> operator()(const ArduPilotLinkConfig& config) const {
    std::unique_ptr<MessageChannel> channel;
    if (config.tcp_port() != 0) {
      channel = std::make_unique<MavlinkChannel>(scenario, mavlink::AutopilotMake::ardupilot, config.companion);
    }
    auto link = std::make_unique<ArduPilotLink>(scenario, packets(config), channel.get(), recording());
    link->own(std::move(channel));
    return link;
  }

  std::unique_ptr<PacketSource> packets(ArduPilotLinkConfig config) const {
    if (!options.replay.empty()) return std::make_unique<ReplaySource>(options.replay);
    config.start.instance += options.worker;
    auto source = std::make_unique<SocketSource>(config, options.bind);
    if (!config.start.command.empty()) source->own(started(config, config.udp_port(), scenario, options.out));
    return source;
  }

  std::unique_ptr<OutsideAutopilot> operator()(const Px4LinkConfig& config) const {
    auto channel = std::make_unique<MavlinkChannel>(scenario, mavlink::AutopilotMake::px4, config.companion);
    return std::make_unique<Px4Link>(scenario, streams(config), std::move(channel), recording());
  }

  std::unique_ptr<HilSource> streams(Px4LinkConfig config) const {
    if (!options.replay.empty()) return std::make_unique<HilReplay>(options.replay);
    config.start.instance += options.worker;
    auto source = std::make_unique<HilSockets>(config, options.bind);
    if (!config.start.command.empty()) source->own(started(config, config.tcp_port(), scenario, options.out));
    return source;
  }
};

}  // namespace

std::unique_ptr<OutsideAutopilot> open_link(const Scenario& scenario, const LinkOptions& options) {
  if (!scenario.link) throw std::logic_error("the scenario has no link");
  return std::visit(LinkOpening{scenario, options}, *scenario.link);
}

std::unique_ptr<OutsideAutopilot> recorded_link(const Scenario& scenario, const std::filesystem::path& run_folder) {
  if (!scenario.link) return nullptr;
  LinkOptions options;
  options.replay = run_folder / kRecordingName;
  return open_link(scenario, options);
}

}  // namespace hedgehop::sim::link
