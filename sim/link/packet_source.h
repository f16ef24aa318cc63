#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/link/child_process.h"
#include "sim/link/recording.h"
#include "sim/link/sockets.h"
#include "sim/scenario/link_config.h"

namespace hedgehop::sim::link {

/// The packets of an autopilot, and the way back.
class PacketSource {
 public:
  struct Packet {
    bool is_serial = false;          ///< bytes of the serial line; otherwise, a datagram
    std::span<const uint8_t> bytes;  ///< valid until the next call
  };
  /// The reason for the end of the packets.
  struct Absence {
    std::string words;
  };

  virtual ~PacketSource() = default;
  /// Waits for the next packet until `deadline_s`. @param step  physics step on which a servo packet would act.
  virtual std::variant<Packet, Absence> next(int64_t step, double deadline_s) = 0;
  /// Returns a packet that has arrived; nullopt without one. @param step  on which serial bytes act.
  virtual std::optional<Packet> arrived(int64_t step) = 0;
  /// Returns why repeats of a packet at once after its answer end the link; nullopt if they do not.
  virtual std::optional<std::string> end_by_repeats(uint32_t count);
  virtual void answer(std::string_view text) = 0;
  /// Returns false if the autopilot does not read its serial line.
  virtual bool send_serial(std::span<const uint8_t> bytes) = 0;
  /// Wall time since an arbitrary instant.
  virtual double now_s() const = 0;
  virtual int64_t strangers() const = 0;
  /// Address of the autopilot; empty before its first packet.
  virtual std::string peer() const = 0;
  virtual double waited_s() const = 0;
};

/// Packets from sockets: datagrams of the first sender, and its serial line over TCP.
class SocketSource : public PacketSource {
 public:
  /// Binds the UDP port. @param bind  numeric address. Throws InputError if the port is in use.
  SocketSource(const ArduPilotLinkConfig& config, const std::string& bind);

  /// Keeps the process of the autopilot, whose end ends the link.
  void own(std::unique_ptr<ChildProcess> process) { process_ = std::move(process); }

  std::variant<Packet, Absence> next(int64_t step, double deadline_s) override;
  std::optional<Packet> arrived(int64_t step) override;
  void answer(std::string_view text) override { datagrams_.send(*peer_, text); }
  bool send_serial(std::span<const uint8_t> bytes) override { return !has_serial_ || serial_.connection().send(bytes); }
  double now_s() const override { return wall_s(); }
  int64_t strangers() const override { return strangers_; }
  std::string peer() const override { return peer_ ? host_text(peer_->host) : ""; }
  double waited_s() const override { return waited_s_; }

 private:
  Absence absence() const;

  const ArduPilotLinkConfig config_;
  DatagramSocket datagrams_;
  bool has_serial_;
  StreamClient serial_;
  std::vector<uint8_t> serial_bytes_;
  std::optional<Address> peer_;
  std::unique_ptr<ChildProcess> process_;
  int64_t strangers_ = 0;
  double tried_s_ = 0.0;  ///< wall time of the last attempt to connect the serial line
  double waited_s_ = 0.0;
};

/// Packets from a recording. Answers have no effect. A recording has no wall times: each of its repeats seems to come
/// at once, and the last ones may be a refusal or the beginning of a silence.
class ReplaySource : public PacketSource {
 public:
  explicit ReplaySource(const std::filesystem::path& file) : reader_(file) {}

  std::variant<Packet, Absence> next(int64_t step, double deadline_s) override;
  std::optional<Packet> arrived(int64_t step) override;
  std::optional<std::string> end_by_repeats(uint32_t count) override;
  void answer(std::string_view) override {}
  bool send_serial(std::span<const uint8_t>) override { return true; }
  double now_s() const override { return 0.0; }
  int64_t strangers() const override { return 0; }
  std::string peer() const override { return ""; }
  double waited_s() const override { return 0.0; }

 private:
  RecordingReader reader_;
  RecordedPacket current_;
};

}  // namespace hedgehop::sim::link
