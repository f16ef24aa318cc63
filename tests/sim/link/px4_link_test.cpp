#include "sim/link/px4_link.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <filesystem>
#include <limits>
#include <random>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/mavlink/command_messages.h"
#include "tests/sim/link/scripted_px4.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim::link {
namespace {

TEST_F(Px4Lockstep, StatesHaveTheTimesOfTheImuAndEachIsAnsweredOnce) {
  EXPECT_FALSE(fly([](uint64_t time_us, int64_t) { return controls(time_us, 0.5f); }, 500));
  ASSERT_EQ(source_->times_us.size(), 500u);
  for (size_t i = 0; i < 500; ++i) EXPECT_EQ(source_->times_us[i], 4000 * (i + 1));
  const LinkFigures figures = link_->figures();
  EXPECT_EQ(figures.frames, 500);
  EXPECT_EQ(figures.old + figures.repeated + figures.unanswered + figures.malformed, 0);
  EXPECT_EQ(source_->sent_s.back(), source_->sent_s.front()) << "the answer ends its waiting";
  EXPECT_NEAR(static_cast<double>(source_->fixes), 2.0 * 5.0, 1.0) << "5 fixes per second for 2 s, less the latency";
}

TEST_F(Px4Lockstep, ControlsAreSharesOfTheMaximumRotorSpeed) {
  EXPECT_FALSE(fly(
      [](uint64_t time_us, int64_t index) {
        constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();
        return controls(time_us, std::array{0.25f, 1.5f, -1.0f, kNotANumber}[static_cast<size_t>(index)]);
      },
      4));
  const auto after_state = [&](size_t i) { return speeds_[kStepsPerState * i]; };
  EXPECT_EQ(speeds_[0], 0.0);
  EXPECT_DOUBLE_EQ(after_state(1), 0.25 * highest_radps_);
  EXPECT_DOUBLE_EQ(speeds_[kStepsPerState + 1], 0.25 * highest_radps_) << "held until the next state";
  EXPECT_DOUBLE_EQ(after_state(2), highest_radps_);
  EXPECT_EQ(after_state(3), 0.0);
  EXPECT_EQ(after_state(4), 0.0);
}

TEST_F(Px4Lockstep, RunsAtThePaceOfTheWallUntilTheFirstControls) {
  EXPECT_FALSE(fly(
      [](uint64_t time_us, int64_t index) { return index < 200 ? std::vector<uint8_t>{} : controls(time_us, 0.5f); },
      300));
  const double begin_s = source_->sent_s.front();
  EXPECT_NEAR(source_->sent_s[200] - begin_s, 0.8, 1e-9) << "200 states of 4 ms";
  EXPECT_EQ(source_->sent_s[299], source_->sent_s[200]);
  EXPECT_EQ(link_->figures().unanswered, 0);
}

TEST_F(Px4Lockstep, OldAndRepeatedControlsAreCountedAndTheNewestFly) {
  EXPECT_FALSE(fly(
      [](uint64_t time_us, int64_t) {
        std::vector<uint8_t> bytes;
        for (const auto& [time, value] :
             {std::pair(time_us - 1, 0.9f), std::pair(time_us, 0.1f), std::pair(time_us, 0.2f)}) {
          const std::vector<uint8_t> one = controls(time, value);
          bytes.insert(bytes.end(), one.begin(), one.end());
        }
        return bytes;
      },
      10));
  EXPECT_EQ(link_->figures().old, 10);
  EXPECT_EQ(link_->figures().repeated, 10);
  EXPECT_NEAR(speeds_.back(), 0.2 * highest_radps_, 1e-3);
}

TEST_F(Px4Lockstep, UnansweredStatesAreCountedAndTheLastControlsHold) {
  EXPECT_FALSE(fly([](uint64_t time_us,
                      int64_t index) { return index % 10 == 9 ? std::vector<uint8_t>{} : controls(time_us, 0.5f); },
                   100));
  EXPECT_EQ(link_->figures().unanswered, 10);
  EXPECT_EQ(link_->figures().frames, 90);
  EXPECT_DOUBLE_EQ(speeds_.back(), 0.5 * highest_radps_);
  EXPECT_NEAR(source_->now_s() - source_->sent_s.front(), 20.0, 1e-9) << "2 s each";
}

TEST_F(Px4Lockstep, AHundredUnansweredStatesLoseTheLink) {
  const auto end =
      fly([](uint64_t time_us, int64_t index) { return index < 50 ? controls(time_us, 0.5f) : std::vector<uint8_t>{}; },
          1000);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, Outcome::link_lost);
  EXPECT_EQ(end->cause, "link: no controls for 100 states up to tick 300");
}

TEST_F(Px4Lockstep, AClosedConnectionLosesTheLink) {
  const auto end = fly(
      [](uint64_t time_us, int64_t index) { return index < 50 ? controls(time_us, 0.5f) : ScriptedPx4::kEnd; }, 100);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->cause, "link: the autopilot closed its connection at tick 102");
}

/// Returns the line of the error that ends the link before the flight.
template <class Call>
std::string refused_line(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Px4Lockstep, AbsenceAndSilenceBeforeTheFlightAreRefused) {
  auto absent = std::make_unique<ScriptedPx4>([](uint64_t, int64_t) { return std::vector<uint8_t>{}; });
  absent->connects = false;
  EXPECT_EQ(refused_line([&] { fly(std::move(absent), 1); }),
            "link: no autopilot within 60 s; start: make px4_sitl none_iris");
  EXPECT_EQ(refused_line([&] { fly([](uint64_t, int64_t) { return std::vector<uint8_t>{}; }, 20'000); }),
            "link: no HIL_ACTUATOR_CONTROLS within 60 s; see the output of PX4's start-up");
  EXPECT_EQ(refused_line([&] { fly([](uint64_t, int64_t) { return ScriptedPx4::kEnd; }, 1); }),
            "link: the autopilot closed its connection before its first controls");
}

TEST_F(Px4Lockstep, OtherProtocolVersionsAreRefused) {
  const auto heartbeat = [](uint64_t, int64_t) {
    std::vector<uint8_t> bytes;
    mavlink::FrameWriter({1, 1}).append(mavlink::Heartbeat{.autopilot = 12, .mavlink_version = 4}, bytes);
    return bytes;
  };
  EXPECT_EQ(refused_line([&] { fly(heartbeat, 2); }), "link: protocol version 4 in HEARTBEAT; valid: 3");
  const auto version_1 = [](uint64_t, int64_t) {
    return std::vector<uint8_t>{0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 2, 12, 0, 4, 3, 0x11, 0x22};
  };
  EXPECT_EQ(refused_line([&] { fly(version_1, 2); }), "link: MAVLink 1; valid: MAVLink 2");
}

TEST_F(Px4Lockstep, ARecordingFliesTheSameControlsAgain) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "link.bin";
  std::mt19937 random(1);
  EXPECT_FALSE(fly(
      [&random](uint64_t time_us, int64_t index) {
        if (index < 20 || random() % 7 == 0) return std::vector<uint8_t>{};
        std::vector<uint8_t> bytes =
            controls(time_us - (random() % 5 == 0 ? 1 : 0), static_cast<float>(random() % 100) / 100.0f);
        if (random() % 3 == 0) bytes.insert(bytes.begin(), 3, 0xFD);
        return bytes;
      },
      300, file));
  const std::vector<double> flown = speeds_;
  const LinkFigures figures = link_->figures();
  EXPECT_FALSE(fly(std::make_unique<HilReplay>(file), 300));
  EXPECT_EQ(speeds_, flown);
  EXPECT_EQ(link_->figures().unanswered, figures.unanswered);
  EXPECT_EQ(link_->figures().malformed, figures.malformed);
  EXPECT_GT(figures.unanswered, 10);
  EXPECT_GT(figures.malformed, 10);
}

TEST_F(Px4Lockstep, AMillionMalformedFragmentsAreCountedInConstantMemory) {
  constexpr int64_t kStates = 10'000;
  constexpr size_t kFragment = 20, kFragments = 100, kMaxGrowthBytes = 1 << 20;
  std::mt19937_64 random(1);
  auto source = std::make_unique<ScriptedPx4>([&random](uint64_t time_us, int64_t) {
    std::vector<uint8_t> bytes(kFragment * kFragments);
    for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random() % 4 == 0 ? 0xFD : random());
    bytes.insert(bytes.end(), 300, 0);  // ends a frame that the noise begins
    const std::vector<uint8_t> answer = controls(time_us, 0.5f);
    bytes.insert(bytes.end(), answer.begin(), answer.end());
    return bytes;
  });
  source->piece = kFragment;
  source_ = source.get();
  const size_t before = ::mallinfo2().uordblks;
  EXPECT_FALSE(fly(std::move(source), kStates));
  EXPECT_GE(source_->pieces, 1'000'000);
  EXPECT_EQ(link_->figures().frames, kStates);
  EXPECT_EQ(link_->figures().unanswered, 0);
  EXPECT_GE(link_->figures().malformed, kStates);
  EXPECT_LT(::mallinfo2().uordblks, before + kMaxGrowthBytes);
}

TEST_F(Px4Lockstep, AStateThatIsNotFiniteLosesTheLink) {
  link_.emplace(scenario_,
                std::make_unique<ScriptedPx4>([](uint64_t time_us, int64_t) { return controls(time_us, 0.5f); }),
                nullptr);
  OutsideInput input{.step = 0};
  link_->exchange(input);
  input.step = kStepsPerState;
  input.body.p_WB.x() = std::numeric_limits<double>::quiet_NaN();
  const auto answered = link_->exchange(input);
  const auto* const end = std::get_if<LinkEnd>(&answered);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->cause, "link: the state is not finite at tick 2");
}

}  // namespace
}  // namespace hedgehop::sim::link
