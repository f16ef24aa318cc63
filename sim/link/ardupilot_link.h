#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/link/actuator_mixing.h"
#include "sim/link/packet_order.h"
#include "sim/link/packet_source.h"
#include "sim/link/recording.h"
#include "sim/loop/message_channel.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::link {

/// ArduPilot as the autopilot of a flight, through its JSON physics backend. It leads: each of its packets is one
/// physics step, and the state after the step is the answer.
class ArduPilotLink : public OutsideAutopilot {
 public:
  /// @param scenario  with a link of this kind; validated. @param source  of the packets.
  /// @param channel  messages over the serial line, or null; it outlives the link. @param recording  file of all
  /// packets, written from the first packet on; empty: none.
  ArduPilotLink(const Scenario& scenario, std::unique_ptr<PacketSource> source, MessageChannel* channel = nullptr,
                std::filesystem::path recording = {});

  /// Keeps the channel of the constructor.
  void own(std::unique_ptr<MessageChannel> channel) { owned_channel_ = std::move(channel); }

  void prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) override;
  std::string awaited() const override { return channel_ ? channel_->awaited() : ""; }
  /// Throws InputError if the first packet does not come or is of another format.
  std::variant<OutsideCommand, LinkEnd> exchange(const OutsideInput& input) override;
  void on_start(int64_t step) override { figures_.start_tick = step; }
  LinkFigures figures() const override;

 private:
  /// A decision on one packet: the commands of the next one, an end, or none for a dropped packet.
  using Taken = std::optional<std::variant<OutsideCommand, LinkEnd>>;

  std::optional<LinkEnd> take_arrived(int64_t step);
  std::optional<LinkEnd> exchange_messages(const OutsideInput& input);
  std::optional<LinkEnd> answer(const OutsideInput& input);
  std::variant<OutsideCommand, LinkEnd> wait_for_next(const OutsideInput& input);
  Taken take(const PacketSource::Packet& packet, int64_t step, int64_t serial_step);
  void measure_ranges(const OutsideInput& input);
  void record(int64_t step, const PacketSource::Packet& packet);

  const ArduPilotLinkConfig config_;
  const double physics_rate_hz_;
  const int64_t range_period_;
  const bool keeps_rotor_speed_;  ///< whether the rotor speed of a helicopter is constant
  std::unique_ptr<PacketSource> source_;
  MessageChannel* const channel_;
  std::unique_ptr<MessageChannel> owned_channel_;
  std::filesystem::path recording_file_;
  std::optional<RecordingWriter> recording_;
  ActuatorMixing mixing_;
  PacketOrder order_;
  LinkFigures figures_;
  std::vector<double> range_m_;
  std::string state_text_;
  std::vector<uint8_t> serial_in_, serial_out_;
  double answered_s_ = 0.0;       ///< wall time of the last answer, which may repeat an earlier one
  double waiting_since_s_ = 0.0;  ///< wall time from which a silence counts: repeats of packet and answer keep it
};

}  // namespace hedgehop::sim::link
