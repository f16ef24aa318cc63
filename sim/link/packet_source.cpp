#include "sim/link/packet_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hedgehop::sim::link {
namespace {

constexpr double kConnectEachS = 0.1;  // an autopilot opens its serial line a moment after its start

}  // namespace

std::optional<std::string> PacketSource::end_by_repeats(uint32_t count) {
  return fmt::format("it refuses our state (frame {})", count);
}

SocketSource::SocketSource(const ArduPilotLinkConfig& config, const std::string& bind)
    : config_(config),
      datagrams_(
          opened<DatagramSocket>({"port", config.udp_port(), config.port, "10 N"}, required_host(bind, "--bind"))),
      has_serial_(config.tcp_port() != 0),
      serial_({required_host(config.host, "link.host"), static_cast<uint16_t>(config.tcp_port())}) {}

std::optional<PacketSource::Packet> SocketSource::arrived(int64_t /*step*/) {
  while (const auto datagram = datagrams_.receive()) {
    if (!peer_) peer_ = datagram->from;
    if (datagram->from == *peer_) return Packet{false, datagram->bytes};
    ++strangers_;
    return std::nullopt;  // to the caller's deadline
  }
  if (!serial_.connection().connected()) return std::nullopt;
  serial_bytes_.clear();
  serial_.connection().receive(serial_bytes_);
  if (serial_bytes_.empty()) return std::nullopt;
  return Packet{true, serial_bytes_};
}

std::variant<PacketSource::Packet, PacketSource::Absence> SocketSource::next(int64_t step, double deadline_s) {
  // In lockstep, no packet has arrived yet: waiting first saves a system call per step.
  for (;;) {
    const double now = now_s();
    if (now >= deadline_s) return absence();
    const bool connecting = has_serial_ && !serial_.connection().connected();
    if (connecting && now - tried_s_ >= kConnectEachS) {
      tried_s_ = now;
      serial_.connect();
    }
    wait_readable(
        std::array{datagrams_.descriptor(), serial_.connection().descriptor(), process_ ? process_->descriptor() : -1},
        connecting ? std::min(kConnectEachS, deadline_s - now) : deadline_s - now);
    waited_s_ += now_s() - now;
    if (const std::optional<Packet> packet = arrived(step)) return *packet;
    if (process_ && process_->ended()) return absence();
  }
}

PacketSource::Absence SocketSource::absence() const {
  if (process_ && process_->ended()) {
    return {fmt::format("the autopilot ended{}: {}; its output: {}", peer_ ? "" : " before its first packet",
                        process_->end_words(), process_->log().string())};
  }
  if (peer_) return {fmt::format("no new packet for {:g} s", config_.silence_s)};
  return {fmt::format("no autopilot within {:g} s; start: arducopter --model JSON:127.0.0.1{}",
                      config_.start.first_packet_s,
                      config_.start.instance == 0 ? "" : fmt::format(" -I {}", config_.start.instance))};
}

std::optional<PacketSource::Packet> ReplaySource::arrived(int64_t step) {
  const RecordedPacket* const packet = reader_.peek();
  if (!packet || !packet->is_serial || packet->step > step) return std::nullopt;
  current_ = *packet;
  reader_.take();
  return Packet{true, current_.bytes};
}

std::optional<std::string> ReplaySource::end_by_repeats(uint32_t count) {
  if (reader_.peek()) return std::nullopt;
  return fmt::format("the recording ends with repeats of packet {}: refused or unanswered", count);
}

std::variant<PacketSource::Packet, PacketSource::Absence> ReplaySource::next(int64_t /*step*/, double /*deadline_s*/) {
  const RecordedPacket* const packet = reader_.peek();
  if (!packet) return Absence{"the recording ends"};
  current_ = *packet;
  reader_.take();
  return Packet{current_.is_serial, current_.bytes};
}

}  // namespace hedgehop::sim::link
