#include "sim/link/ardupilot_link.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "sim/config/input_error.h"
#include "tests/sim/link/linked_autopilot.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::link {
namespace {

TEST_F(LinkedAutopilot, FliesInLockstepOneStepPerPacket) {
  std::vector<std::string> texts;
  const auto end = run_against(100, [&](PeerSocket& peer) {
    for (uint32_t count = 0; count <= 100; ++count) {
      peer.send(count);
      if (count < 100) texts.push_back(peer.receive());
    }
  });
  EXPECT_FALSE(end);
  EXPECT_EQ(figures_.frames, 101);
  EXPECT_EQ(figures_.peer, "127.0.0.1");
  EXPECT_EQ(figures_.repeated + figures_.old + figures_.missed + figures_.malformed + figures_.strangers, 0);
  EXPECT_TRUE(texts.front().starts_with("\n{\"timestamp\":0.00100000010,"));  // one step after the first packet
}

TEST_F(LinkedAutopilot, RepeatedAndOldPacketsAreCountedAndTheFlightGoesOn) {
  const auto end = run_against(20, [](PeerSocket& peer) {
    for (uint32_t count = 0; count <= 20; ++count) {
      peer.send(count);
      if (count == 20) break;
      if (count % 5 == 1) peer.send(count);      // repeated before the answer
      if (count % 5 == 3) peer.send(count - 2);  // old
      peer.receive();
    }
  });
  EXPECT_FALSE(end);
  EXPECT_EQ(figures_.frames, 21);
  EXPECT_EQ(figures_.repeated, 4);
  EXPECT_EQ(figures_.old, 4);
  EXPECT_EQ(figures_.resent, 0);
}

TEST_F(LinkedAutopilot, RepeatIsAnsweredAgainAfterItsTimeAndTheAnswerIsTheSame) {
  config_.resend_s = 0.0;  // a repeat can arrive within a microsecond of the answer
  std::vector<std::string> texts;
  const auto end = run_against(2, [&](PeerSocket& peer) {
    peer.send(0);
    texts.push_back(peer.receive());
    peer.send(0);  // its answer was lost
    texts.push_back(peer.receive());
    peer.send(1);
    texts.push_back(peer.receive());
    peer.send(2);
  });
  EXPECT_FALSE(end);
  EXPECT_EQ(figures_.resent, 1);
  EXPECT_EQ(texts[0], texts[1]);
  EXPECT_NE(texts[1], texts[2]);
}

TEST_F(LinkedAutopilot, MissingPacketsEndTheFlight) {
  const auto end = run_against(10, [](PeerSocket& peer) {
    peer.send(811);
    peer.receive();
    peer.send(816);
  });
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::link_lost);
  EXPECT_EQ(end->cause, "link: packets 812 to 815 are missing");
  EXPECT_EQ(figures_.missed, 4);
}

TEST_F(LinkedAutopilot, RestartEndsTheFlight) {
  const auto end = run_against(10, [](PeerSocket& peer) {
    for (uint32_t count = 0; count < 5; ++count) {
      peer.send(count);
      peer.receive();
    }
    peer.send(0);
  });
  ASSERT_TRUE(end);
  EXPECT_EQ(end->cause, "link: the autopilot restarted at tick 5");
}

TEST_F(LinkedAutopilot, RefusalEndsTheFlight) {
  scenario_.link = config_;
  double now_s = 0.0;
  const std::vector<uint8_t> packet = servo_packet(812, 1500);
  ArduPilotLink link(scenario_, std::make_unique<TimedSource>(std::vector(3, packet), 0.01, now_s));
  const std::optional<LinkEnd> end = run(link, 10);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->cause, "link: it refuses our state (frame 812)");
}

TEST_F(LinkedAutopilot, SilenceEndsTheFlight) {
  config_.silence_s = 0.01;
  const auto end = run_against(10, [](PeerSocket& peer) {
    peer.send(0);
    peer.receive();
  });
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::link_lost);
  EXPECT_EQ(end->cause, "link: no new packet for 0.01 s at tick 1");
}

/// An autopilot that gets no answer repeats its packet each 1.1 s.
TEST_F(LinkedAutopilot, RepeatsWithoutANewPacketAreSilence) {
  config_.silence_s = 30.0;
  config_.resend_s = 3.0;
  scenario_.link = config_;
  double now_s = 0.0;
  const std::vector<uint8_t> packet = servo_packet(0, 1500);
  ArduPilotLink link(scenario_, std::make_unique<TimedSource>(std::vector(100, packet), 1.1, now_s));
  const std::optional<LinkEnd> end = run(link, 10);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->cause, "link: silent at tick 1");
  EXPECT_EQ(now_s, 30.0);
  EXPECT_EQ(link.figures().resent, 9);  // at 3.3, 6.6, ..., 29.7 s
}

TEST_F(LinkedAutopilot, SilenceBeforeTheFlightIsABadInput) {
  config_.start.first_packet_s = 0.01;
  config_.start.instance = 1;
  const auto link = open();
  try {
    link->exchange(input(0));
    FAIL() << "it flew";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "link: no autopilot within 0.01 s; start: arducopter --model JSON:127.0.0.1 -I 1");
  }
}

TEST_F(LinkedAutopilot, WrongMagicBeforeTheFlightIsABadInput) {
  const auto link = open();
  PeerSocket peer(port());
  std::vector<uint8_t> bytes(28);
  bytes[0] = 0xd2;
  bytes[1] = 0x04;
  peer.send_bytes(bytes);
  try {
    link->exchange(input(0));
    FAIL() << "it flew";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "link: 28 bytes with magic 1234; expected 40 with 18458 or 72 with 29569: is the autopilot's model JSON?");
  }
}

TEST_F(LinkedAutopilot, PortInUseIsABadInput) {
  const auto first = open();
  try {
    open();
    FAIL() << "two links share a port";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              fmt::format("link.port: {0} is in use (instance N uses {0} + 10 N)", config_.port));
  }
}

TEST_F(LinkedAutopilot, StateThatIsNotFiniteIsNotSent) {
  const auto link = open();
  PeerSocket peer(port());
  peer.send(0);
  ASSERT_TRUE(std::holds_alternative<OutsideCommand>(link->exchange(input(0))));
  OutsideInput broken = input(1);
  broken.body.p_WB.x() = std::nan("");
  const auto answer = link->exchange(broken);
  EXPECT_EQ(std::get<LinkEnd>(answer).cause, "link: the state is not finite at tick 1");
}

TEST_F(LinkedAutopilot, EngineOffIsAFaultInFlightButNotOnTheStand) {
  scenario_.vehicle = dynamics::helicopter::HelicopterConfig{};  // of constant rotor speed
  config_.helicopter = HelicopterLinkConfig{};                   // the engine is on above 1400 us
  scenario_.link = config_;
  const auto end_with = [this](bool on_stand) -> std::optional<LinkEnd> {
    double now_s = 0.0;
    ArduPilotLink link(scenario_, std::make_unique<TimedSource>(
                                      std::vector{servo_packet(0, 1700), servo_packet(1, 1400)}, 0.001, now_s));
    EXPECT_TRUE(std::holds_alternative<OutsideCommand>(link.exchange(input(0))));
    OutsideInput second = input(1);
    second.on_stand = on_stand;
    const auto answer = link.exchange(second);
    const auto* const end = std::get_if<LinkEnd>(&answer);
    return end ? std::optional(*end) : std::nullopt;
  };
  EXPECT_FALSE(end_with(true));
  const std::optional<LinkEnd> end = end_with(false);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::fault);
  EXPECT_EQ(end->cause, "link: SERVO8 switched the engine off in flight at tick 1");
}

TEST_F(LinkedAutopilot, SecondPeerIsCountedAndIgnored) {
  PeerSocket stranger(port());
  const auto end = run_against(5, [&](PeerSocket& peer) {
    for (uint32_t count = 0; count <= 5; ++count) {
      peer.send(count);
      if (count == 5) break;
      peer.receive();
      stranger.send(count + 1);
      stranger.send_bytes({1, 2, 3});
    }
  });
  EXPECT_FALSE(end);
  EXPECT_EQ(figures_.frames, 6);
  EXPECT_EQ(figures_.strangers, 10);
}

TEST_F(LinkedAutopilot, MalformedDatagramsAreCountedWithoutGrowthOfMemory) {
  constexpr int kSteps = 200, kPerStep = 50;
  size_t before = 0, after = 0;
  const auto end = run_against(kSteps, [&](PeerSocket& peer) {
    for (uint32_t count = 0; count <= kSteps; ++count) {
      peer.send(count);
      if (count == kSteps) break;
      peer.receive();
      if (count == 10) before = mallinfo2().uordblks;
      for (int i = 0; i < kPerStep; ++i) peer.send_bytes(std::vector<uint8_t>(static_cast<size_t>(1 + i), 0x1a));
    }
    after = mallinfo2().uordblks;
  });
  EXPECT_FALSE(end);
  EXPECT_EQ(figures_.frames, kSteps + 1);
  EXPECT_EQ(figures_.malformed, kSteps * kPerStep);
  EXPECT_LT(after, before + 4096);
}

TEST_F(LinkedAutopilot, RecordingFliesAgainWithTheSameCommandsAndCounts) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "linked_autopilot.bin";
  std::vector<Eigen::VectorXd> live, again;
  const auto fly = [](ArduPilotLink& link, std::vector<Eigen::VectorXd>& commands) {
    for (int64_t step = 0;; ++step) {
      const auto answer = link.exchange(input(step));
      if (const auto* const end = std::get_if<LinkEnd>(&answer)) return end->cause;
      commands.emplace_back(std::get<dynamics::multicopter::PerRotor>(std::get<OutsideCommand>(answer).actuators));
    }
  };
  std::string cause;
  LinkFigures recorded;
  {
    auto link = open(file);
    std::thread peer([&] {
      PeerSocket socket(port());
      for (uint32_t count = 0; count < 50; ++count) {
        socket.send(count, static_cast<uint16_t>(1000 + 17 * count));
        if (count % 7 == 3) socket.send(count);
        socket.receive();
      }
      socket.send(0);
    });
    cause = fly(*link, live);
    peer.join();
    recorded = link->figures();
  }
  ArduPilotLink replay(scenario_, std::make_unique<ReplaySource>(file));
  EXPECT_EQ(fly(replay, again), cause);
  EXPECT_EQ(cause, "link: the autopilot restarted at tick 50");
  EXPECT_EQ(live, again);
  EXPECT_EQ(replay.figures().frames, recorded.frames);
  EXPECT_EQ(replay.figures().repeated, recorded.repeated);
  EXPECT_EQ(recorded.repeated, 7);
}

/// A recording has no wall times: repeats that came after a second each must not count as a refusal, which comes at
/// once. At the end of a recording, a refusal and a silence look the same.
TEST_F(LinkedAutopilot, ReplayEndsByRepeatsOnlyAtTheEndOfItsRecording) {
  scenario_.link = config_;
  const TemporaryFolder folder;
  const auto file = folder.path() / "repeats.bin";
  const auto end_of = [&](const std::vector<uint32_t>& counts) {
    {
      RecordingWriter writer(file);
      for (const uint32_t count : counts) writer.add(count + 1, false, servo_packet(count, 1500));
    }
    ArduPilotLink replay(scenario_, std::make_unique<ReplaySource>(file));
    return run(replay, 100)->cause;
  };
  EXPECT_EQ(end_of({0, 1, 1, 1, 1, 2, 3}), "link: the recording ends at tick 4");
  EXPECT_EQ(end_of({0, 1, 1, 1}), "link: the recording ends with repeats of packet 1: refused or unanswered");
}

}  // namespace
}  // namespace hedgehop::sim::link
