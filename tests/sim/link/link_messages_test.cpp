#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "sim/link/ardupilot_link.h"
#include "sim/link/mavlink_channel.h"
#include "tests/sim/link/linked_autopilot.h"

namespace hedgehop::sim::link {
namespace {

TEST_F(LinkedAutopilot, RangeFindersAreCastFromTheirMounts) {
  config_.range_finders = {{.direction_B = {0, 0, 2}, .p_BI_m = {0.1, 0, 0.2}, .max_m = 30.0},
                           {.direction_B = {1, 0, 0}}};
  const auto link = open();
  std::string text;
  std::thread autopilot([&] {
    PeerSocket peer(port());
    peer.send(0);
    text = peer.receive();
    peer.send(1);
  });
  OutsideInput state = input(0);
  state.body.p_WB = {0, 0, -10};
  // Ground at altitude 0 and no obstacle.
  state.beam_distance = [](const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W, double reach_m) {
    EXPECT_NEAR(direction_W.norm(), 1.0, 1e-15);
    if (direction_W.z() < 0.5) return std::numeric_limits<double>::infinity();
    EXPECT_EQ(reach_m, 30.0);
    return -p_W.z();
  };
  link->exchange(state);
  state.step = 1;
  link->exchange(state);
  autopilot.join();
  EXPECT_NE(text.find("\"rng_1\":9.8,\"rng_2\":-1,"), std::string::npos) << text;
}

/// Sends a mark per step and counts the bytes that it receives.
class MarkChannel : public MessageChannel {
 public:
  void receive(const OutsideInput&, std::span<const uint8_t> bytes) override { received += bytes.size(); }
  void send(const OutsideInput& now, std::vector<uint8_t>& bytes) override {
    if (now.command && std::holds_alternative<avoidance::AttitudeCommand>(*now.command)) {
      throw std::invalid_argument("link: AttitudeCommand cannot be sent to this autopilot");
    }
    bytes.push_back(0xfd);
  }
  size_t received = 0;
};

TEST_F(LinkedAutopilot, CommandThatTheChannelRefusesIsAFault) {
  scenario_.link = config_;
  MarkChannel channel;
  ArduPilotLink link(scenario_, std::make_unique<SocketSource>(config_, "127.0.0.1"), &channel);
  OutsideInput state = input(0);
  const avoidance::Command command = avoidance::AttitudeCommand{};
  state.command = &command;
  const auto answer = link.exchange(state);
  EXPECT_EQ(std::get<LinkEnd>(answer).outcome, Outcome::fault);
  EXPECT_EQ(std::get<LinkEnd>(answer).cause, "link: AttitudeCommand cannot be sent to this autopilot");
}

TEST_F(LinkedAutopilot, AwaitedHeartbeatNamesMavlink1) {
  scenario_.link = config_;
  MavlinkChannel channel(scenario_, mavlink::AutopilotMake::ardupilot, {});
  EXPECT_EQ(channel.awaited(), "");
  channel.prepare({}, {});
  const std::string awaited = channel.awaited();
  channel.receive(input(0), std::vector<uint8_t>{0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 2, 3, 0, 4, 3, 0x11, 0x22});
  EXPECT_EQ(channel.awaited(), awaited + " (MAVLink 1; valid: MAVLink 2)");
}

/// The serial line of an autopilot: a TCP server with one client, on a port that the system chooses.
class SerialServer {
 public:
  SerialServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_addr.s_addr = htonl(kLoopback);
    auto* const general = reinterpret_cast<sockaddr*>(&name);
    socklen_t size = sizeof name;
    if (::bind(listener_.number(), general, size) != 0 || ::listen(listener_.number(), 1) != 0 ||
        ::getsockname(listener_.number(), general, &size) != 0) {
      throw std::runtime_error("no serial line");
    }
    port_ = ntohs(name.sin_port);
  }
  uint16_t port() const { return port_; }
  void accept() { client_ = Descriptor(::accept(listener_.number(), nullptr, nullptr)); }
  void send(size_t bytes) { ::send(client_.number(), std::string(bytes, 'x').data(), bytes, MSG_NOSIGNAL); }
  /// The number of bytes that have arrived.
  size_t take() {
    std::array<char, 4096> buffer;
    const ssize_t got = ::recv(client_.number(), buffer.data(), buffer.size(), MSG_DONTWAIT);
    return got > 0 ? static_cast<size_t>(got) : 0;
  }

 private:
  Descriptor listener_, client_;
  uint16_t port_ = 0;
};

TEST_F(LinkedAutopilot, MessagesArriveBeforeTheStateOfTheirStep) {
  SerialServer serial;
  config_.serial_port = serial.port();
  scenario_.link = config_;
  MarkChannel channel;
  ArduPilotLink link(scenario_, std::make_unique<SocketSource>(config_, "127.0.0.1"), &channel);
  std::vector<size_t> marks;
  std::thread autopilot([&] {
    serial.accept();  // the autopilot waits for its client before its first packet
    PeerSocket peer(port());
    for (uint32_t count = 0; count < 20; ++count) {
      serial.send(3);
      peer.send(count);
      if (count == 19) break;
      peer.receive();
      marks.push_back(serial.take());
    }
  });
  EXPECT_FALSE(run(link, 19));
  autopilot.join();
  ASSERT_EQ(marks.size(), 19u);
  EXPECT_EQ(marks.front(), 2u);  // of step 0, before the first packet, and of step 1
  for (size_t i = 1; i < marks.size(); ++i) EXPECT_EQ(marks[i], 1u);
  EXPECT_GE(channel.received, 3u * 18u);
  EXPECT_LE(channel.received, 3u * 20u);
}

}  // namespace
}  // namespace hedgehop::sim::link
