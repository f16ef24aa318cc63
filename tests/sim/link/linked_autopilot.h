#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "sim/link/ardupilot_link.h"

namespace hedgehop::sim::link {

inline constexpr uint32_t kLoopback = 0x7f000001;
inline constexpr double kNeverS = 3600.0;  // longer than any test

/// Returns a packet of ArduPilot with 16 equal pulses at 1200 Hz.
inline std::vector<uint8_t> servo_packet(uint32_t count, uint16_t pulse_us) {
  std::vector<uint8_t> bytes = {0x1a, 0x48, 0xb0, 0x04};
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<uint8_t>(count >> (8 * i)));
  for (int i = 0; i < 16; ++i)
    bytes.insert(bytes.end(), {static_cast<uint8_t>(pulse_us), static_cast<uint8_t>(pulse_us >> 8)});
  return bytes;
}

/// An autopilot of the tests on a real socket.
class PeerSocket {
 public:
  explicit PeerSocket(uint16_t port) : socket_({kLoopback, 0}), server_({kLoopback, port}) {}

  void send(uint32_t count, uint16_t pulse_us = 1500) { send_bytes(servo_packet(count, pulse_us)); }
  void send_bytes(const std::vector<uint8_t>& bytes) {
    socket_.send(server_, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  std::string receive() {
    for (;;) {
      if (const auto datagram = socket_.receive()) return {datagram->bytes.begin(), datagram->bytes.end()};
      wait_readable(std::array{socket_.descriptor()}, 60.0);
    }
  }

 private:
  DatagramSocket socket_;
  Address server_;
};

/// An autopilot without sockets that sends its packets at regular times of a simulated clock, whatever it receives.
class TimedSource : public PacketSource {
 public:
  /// @param packets  the first one at once, each other one `pause_s` after the one before. @param now_s  of the clock,
  /// which moves only if someone waits; it outlives the source.
  TimedSource(std::vector<std::vector<uint8_t>> packets, double pause_s, double& now_s)
      : packets_(std::move(packets)), pause_s_(pause_s), now_s_(now_s) {}

  std::variant<Packet, Absence> next(int64_t /*step*/, double deadline_s) override {
    const double next_s = sent_ > 0 ? now_s_ + pause_s_ : now_s_;
    const bool silent = sent_ == packets_.size() || next_s > deadline_s;
    now_s_ = silent ? deadline_s : next_s;
    if (silent) return Absence{"silent"};
    return Packet{false, packets_[sent_++]};
  }
  std::optional<Packet> arrived(int64_t /*step*/) override { return std::nullopt; }
  void answer(std::string_view) override {}
  bool send_serial(std::span<const uint8_t>) override { return true; }
  double now_s() const override { return now_s_; }
  int64_t strangers() const override { return 0; }
  std::string peer() const override { return ""; }
  double waited_s() const override { return 0.0; }

 private:
  const std::vector<std::vector<uint8_t>> packets_;
  const double pause_s_;
  double& now_s_;
  size_t sent_ = 0;
};

/// A UDP port that no process uses. Processes begin at different ports, because another one may take a port after the
/// probe.
inline uint16_t free_port() {
  for (int number = 20000 + 7 * (::getpid() % 2000); number < 60000; number += 7) {
    const auto port = static_cast<uint16_t>(number);
    try {
      DatagramSocket socket({kLoopback, port});
      return port;
    } catch (const std::system_error&) {  // used by another process
    }
  }
  throw std::runtime_error("no free port");
}

class LinkedAutopilot : public testing::Test {
 protected:
  LinkedAutopilot() {
    scenario_.vehicle = dynamics::multicopter::MulticopterConfig{};
    scenario_.physics_rate_hz = 1000;
    config_.port = free_port();
    config_.serial_port = 0;
    config_.multicopter.frame_type = 0;
    config_.start.first_packet_s = config_.silence_s = config_.resend_s = kNeverS;
  }

  std::unique_ptr<ArduPilotLink> open(const std::filesystem::path& recording = {}) {
    scenario_.link = config_;
    return std::make_unique<ArduPilotLink>(scenario_, std::make_unique<SocketSource>(config_, "127.0.0.1"), nullptr,
                                           recording);
  }
  uint16_t port() const { return static_cast<uint16_t>(config_.port); }

  static OutsideInput input(int64_t step) {
    OutsideInput input{.step = step};
    input.specific_force_B = {0.0, 0.0, -9.81};
    return input;
  }
  /// Runs exchanges 0 to `last`, and returns the end of the link, if it ends.
  static std::optional<LinkEnd> run(ArduPilotLink& link, int64_t last) {
    for (int64_t step = 0; step <= last; ++step) {
      auto answer = link.exchange(input(step));
      if (auto* const end = std::get_if<LinkEnd>(&answer)) return *end;
    }
    return std::nullopt;
  }
  /// Runs exchanges against a scripted peer.
  std::optional<LinkEnd> run_against(int64_t last, const std::function<void(PeerSocket&)>& script) {
    auto link = open();
    std::thread peer([&] {
      PeerSocket socket(port());
      script(socket);
    });
    std::optional<LinkEnd> end = run(*link, last);
    peer.join();
    figures_ = link->figures();
    return end;
  }

  Scenario scenario_;
  ArduPilotLinkConfig config_;
  LinkFigures figures_;
};

}  // namespace hedgehop::sim::link
