#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/link/child_process.h"
#include "sim/link/recording.h"
#include "sim/link/sockets.h"
#include "sim/scenario/px4_link_config.h"

namespace hedgehop::sim::link {

/// The bytes of an autopilot that we lead, and the way back: a stream for the simulation, and messages.
class HilSource {
 public:
  struct Chunk {
    bool is_message = false;         ///< of the messages; otherwise, of the stream
    std::span<const uint8_t> bytes;  ///< valid until the next call; an empty chunk of the stream is its end
  };

  virtual ~HilSource() = default;
  /// Waits for the autopilot's connection until `deadline_s`. @return whether it is connected.
  virtual bool connect(double deadline_s) = 0;
  /// Returns messages that have arrived; nullopt without. @param step  physics step on which they act.
  virtual std::optional<Chunk> message(int64_t step) = 0;
  /// Returns bytes of the stream that have arrived; waits for them until `deadline_s`.
  virtual std::optional<Chunk> stream(int64_t step, double deadline_s) = 0;
  /// Returns false if the autopilot does not read its stream.
  virtual bool send(std::span<const uint8_t> bytes) = 0;
  virtual void send_message(std::span<const uint8_t> bytes) = 0;
  /// Wall time since an arbitrary instant.
  virtual double now_s() const = 0;
  virtual double waited_s() const = 0;
  virtual int64_t strangers() const = 0;
  /// Address of the autopilot; empty before its connection.
  virtual std::string peer() const = 0;
  /// Returns why it does not connect: "no autopilot within 60 s; start: make px4_sitl none_iris".
  virtual std::string absence() const = 0;
};

/// Bytes from sockets: a TCP server for the stream, UDP for messages.
class HilSockets : public HilSource {
 public:
  /// Binds both ports. @param bind  numeric address. Throws InputError if a port is in use.
  HilSockets(const Px4LinkConfig& config, const std::string& bind);

  /// Keeps the process of the autopilot, whose end ends the link.
  void own(std::unique_ptr<ChildProcess> process) { process_ = std::move(process); }

  bool connect(double deadline_s) override;
  std::optional<Chunk> message(int64_t step) override;
  std::optional<Chunk> stream(int64_t step, double deadline_s) override;
  bool send(std::span<const uint8_t> bytes) override { return server_.connection().send(bytes); }
  void send_message(std::span<const uint8_t> bytes) override;
  double now_s() const override { return wall_s(); }
  double waited_s() const override { return waited_s_; }
  int64_t strangers() const override { return strangers_; }
  std::string peer() const override { return has_peer_ ? host_text(server_.peer().host) : ""; }
  std::string absence() const override;

 private:
  bool wait(double deadline_s);

  const Px4LinkConfig config_;
  uint32_t host_;
  StreamServer server_;
  DatagramSocket datagrams_;
  std::unique_ptr<ChildProcess> process_;
  std::vector<uint8_t> bytes_;
  bool has_peer_ = false, ended_ = false;
  int64_t strangers_ = 0;
  double waited_s_ = 0.0;
};

/// Bytes from a recording. Sent bytes have no effect.
class HilReplay : public HilSource {
 public:
  explicit HilReplay(const std::filesystem::path& file) : reader_(file) {}

  bool connect(double) override { return true; }
  std::optional<Chunk> message(int64_t step) override { return recorded(step, true); }
  std::optional<Chunk> stream(int64_t step, double) override { return recorded(step, false); }
  bool send(std::span<const uint8_t>) override { return true; }
  void send_message(std::span<const uint8_t>) override {}
  double now_s() const override { return 0.0; }
  double waited_s() const override { return 0.0; }
  int64_t strangers() const override { return 0; }
  std::string peer() const override { return ""; }
  std::string absence() const override { return "the recording ends"; }

 private:
  std::optional<Chunk> recorded(int64_t step, bool is_message);

  RecordingReader reader_;
  RecordedPacket current_;
};

}  // namespace hedgehop::sim::link
