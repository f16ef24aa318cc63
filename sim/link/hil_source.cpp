#include "sim/link/hil_source.h"

#include <fmt/format.h>

#include <array>

namespace hedgehop::sim::link {

HilSockets::HilSockets(const Px4LinkConfig& config, const std::string& bind)
    : config_(config),
      host_(required_host(bind, "--bind")),
      server_(opened<StreamServer>({"port", config.tcp_port(), config.port, "N"}, host_)),
      datagrams_(opened<DatagramSocket>({"offboard_port", config.own_udp_port(), config.offboard_port, "N"}, host_)) {}

/// Waits until something happens on the stream. @return false at the deadline or at the end of the autopilot's process.
bool HilSockets::wait(double deadline_s) {
  const double begin_s = now_s();
  if (begin_s >= deadline_s || (process_ && process_->ended())) return false;
  wait_readable(std::array{server_.descriptor(), process_ ? process_->descriptor() : -1}, deadline_s - begin_s);
  waited_s_ += now_s() - begin_s;
  return true;
}

bool HilSockets::connect(double deadline_s) {
  while (!server_.accept()) {
    if (!wait(deadline_s)) return false;
  }
  has_peer_ = true;
  return true;
}

std::optional<HilSource::Chunk> HilSockets::message(int64_t /*step*/) {
  while (const auto datagram = datagrams_.receive()) {
    const bool is_autopilot = has_peer_ && datagram->from.host == server_.peer().host &&
                              datagram->from.port == static_cast<uint16_t>(config_.autopilot_udp_port());
    if (is_autopilot) return Chunk{true, datagram->bytes};
    ++strangers_;
  }
  return std::nullopt;
}

std::optional<HilSource::Chunk> HilSockets::stream(int64_t /*step*/, double deadline_s) {
  if (ended_) return std::nullopt;
  do {
    bytes_.clear();
    server_.connection().receive(bytes_);
    ended_ = bytes_.empty() && !server_.connection().connected();
    if (ended_ || !bytes_.empty()) return Chunk{false, bytes_};
  } while (wait(deadline_s));
  return std::nullopt;
}

void HilSockets::send_message(std::span<const uint8_t> bytes) {
  if (bytes.empty() || !has_peer_) return;
  datagrams_.send({server_.peer().host, static_cast<uint16_t>(config_.autopilot_udp_port())},
                  {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string HilSockets::absence() const {
  if (process_ && process_->ended()) {
    return fmt::format("the autopilot ended before its connection: {}; its output: {}", process_->end_words(),
                       process_->log().string());
  }
  return fmt::format("no autopilot within {:g} s; start: make px4_sitl none_iris", config_.start.first_packet_s);
}

std::optional<HilSource::Chunk> HilReplay::recorded(int64_t step, bool is_message) {
  const RecordedPacket* const packet = reader_.peek();
  if (!packet || packet->is_serial != is_message || packet->step != step) return std::nullopt;
  current_ = *packet;
  reader_.take();
  return Chunk{is_message, current_.bytes};
}

}  // namespace hedgehop::sim::link
