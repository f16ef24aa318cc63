#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "sim/link/px4_link.h"
#include "sim/mavlink/command_messages.h"

namespace hedgehop::sim::link {

inline constexpr int64_t kLockstepHz = 500, kStepsPerState = 2;  // two physics steps per reading of the IMU

/// A PX4 without sockets: a function answers each state. Its clock moves only if someone waits.
class ScriptedPx4 : public HilSource {
 public:
  using Answer = std::function<std::vector<uint8_t>(uint64_t time_us, int64_t index)>;
  explicit ScriptedPx4(Answer answer) : answer_(std::move(answer)) {}

  bool connects = true;
  std::vector<uint64_t> times_us;
  std::vector<double> sent_s;  ///< wall time of each state
  int64_t fixes = 0;
  size_t piece = std::numeric_limits<size_t>::max();  ///< bytes per call of stream()
  int64_t pieces = 0;

  bool connect(double deadline_s) override {
    if (!connects) now_s_ = deadline_s;
    return connects;
  }
  std::optional<Chunk> message(int64_t) override { return std::nullopt; }
  std::optional<Chunk> stream(int64_t, double deadline_s) override {
    if (pending_.empty()) {
      now_s_ = std::max(now_s_, deadline_s);
      return std::nullopt;
    }
    const auto end = pending_.begin() + static_cast<ptrdiff_t>(std::min(piece, pending_.size()));
    bytes_.assign(pending_.begin(), end);
    pending_.erase(pending_.begin(), end);
    ++pieces;
    if (bytes_ == kEnd) bytes_.clear();
    return Chunk{false, bytes_};
  }
  bool send(std::span<const uint8_t> bytes) override {
    for (const mavlink::Frame& frame : decoder_.decode(bytes)) {
      fixes += frame.id == mavlink::HilGps::kId ? 1 : 0;
      const auto sensor = frame.as<mavlink::HilSensor>();
      if (!sensor) continue;
      times_us.push_back(sensor->time_usec);
      sent_s.push_back(now_s_);
      const std::vector<uint8_t> answer = answer_(sensor->time_usec, static_cast<int64_t>(times_us.size()) - 1);
      pending_.insert(pending_.end(), answer.begin(), answer.end());
    }
    return true;
  }
  void send_message(std::span<const uint8_t>) override {}
  double now_s() const override { return now_s_; }
  double waited_s() const override { return now_s_; }
  int64_t strangers() const override { return 0; }
  std::string peer() const override { return "scripted"; }
  std::string absence() const override { return "no autopilot within 60 s; start: make px4_sitl none_iris"; }

  inline static const std::vector<uint8_t> kEnd = {'e', 'n', 'd'};

 private:
  Answer answer_;
  mavlink::FrameDecoder decoder_;
  std::vector<uint8_t> pending_, bytes_;
  double now_s_ = 100.0;
};

/// Returns HIL_ACTUATOR_CONTROLS with a value for the first four outputs.
inline std::vector<uint8_t> controls(uint64_t time_us, float value) {
  static mavlink::FrameWriter writer({1, 1});
  mavlink::HilActuatorControls message{.time_usec = time_us, .flags = 1, .mode = 129};
  std::fill_n(message.controls.begin(), 4, value);
  std::vector<uint8_t> bytes;
  writer.append(message, bytes);
  return bytes;
}

class Px4Lockstep : public testing::Test {
 protected:
  Px4Lockstep() {
    scenario_.vehicle = dynamics::multicopter::MulticopterConfig{};
    scenario_.physics_rate_hz = kLockstepHz;
    Px4LinkConfig config;
    config.frame_type = 0;
    scenario_.link = config;
    highest_radps_ = std::get<dynamics::multicopter::MulticopterConfig>(scenario_.vehicle).rotor.highest_radps;
  }

  /// Flies `states` readings of the IMU. @return the end of the link, if it ends.
  std::optional<LinkEnd> fly(ScriptedPx4::Answer answer, int64_t states, const std::filesystem::path& recording = {}) {
    auto source = std::make_unique<ScriptedPx4>(std::move(answer));
    source_ = source.get();
    return fly(std::move(source), states, recording);
  }
  std::optional<LinkEnd> fly(std::unique_ptr<HilSource> source, int64_t states,
                             const std::filesystem::path& recording = {}) {
    link_.emplace(scenario_, std::move(source), nullptr, recording);
    speeds_.clear();
    for (int64_t step = 0; step <= kStepsPerState * states; ++step) {
      OutsideInput input{.step = step};
      input.specific_force_B = {0.0, 0.0, -9.81};
      const auto answered = link_->exchange(input);
      if (const auto* const end = std::get_if<LinkEnd>(&answered)) return *end;
      const auto& command = std::get<OutsideCommand>(answered);
      speeds_.push_back(std::get<dynamics::multicopter::PerRotor>(command.actuators)[0]);
    }
    return std::nullopt;
  }

  Scenario scenario_;
  double highest_radps_ = 0.0;
  ScriptedPx4* source_ = nullptr;
  std::optional<Px4Link> link_;
  std::vector<double> speeds_;  ///< of rotor 0, per physics step
};

}  // namespace hedgehop::sim::link
