#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/link/hil_sensors.h"
#include "sim/link/hil_source.h"
#include "sim/link/recording.h"
#include "sim/loop/message_channel.h"
#include "sim/loop/outside_autopilot.h"
#include "sim/mavlink/autopilot_state.h"
#include "sim/mavlink/frame.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim::link {

/// PX4 as the autopilot of a flight. We lead: each reading of the IMU (HIL_SENSOR) sets its clock, and the controls
/// with that time are the answer. Before its first answer, PX4 boots in wall time, and so does the simulation.
class Px4Link : public OutsideAutopilot {
 public:
  /// @param scenario  with a link of this kind; validated. @param channel  messages over UDP, or null.
  /// @param recording  file of all bytes received; empty: none.
  Px4Link(const Scenario& scenario, std::unique_ptr<HilSource> source, std::unique_ptr<MessageChannel> channel,
          std::filesystem::path recording = {});

  void prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) override;
  /// Throws InputError if PX4 does not connect, speaks another protocol, or never answers.
  std::variant<OutsideCommand, LinkEnd> exchange(const OutsideInput& input) override;
  void on_start(int64_t step) override { figures_.start_tick = step; }
  LinkFigures figures() const override;

  /// States in a row without an answer that end the flight.
  static constexpr int64_t kMaxUnanswered = 100;

 private:
  std::optional<LinkEnd> exchange_messages(const OutsideInput& input);
  std::optional<LinkEnd> send_state(const OutsideInput& input);
  std::optional<LinkEnd> wait_for_controls(const OutsideInput& input);
  std::optional<LinkEnd> miss_answer(int64_t step);
  bool take_stream(const HilSource::Chunk& chunk, int64_t step);
  void take_controls(const mavlink::Frame& frame, int64_t step);
  void require_protocol() const;
  void record(int64_t step, const HilSource::Chunk& chunk);

  const Px4LinkConfig config_;
  std::unique_ptr<HilSource> source_;
  std::unique_ptr<MessageChannel> channel_;
  std::filesystem::path recording_file_;
  std::optional<RecordingWriter> recording_;
  HilSensors sensors_;
  std::vector<size_t> arm_of_motor_;
  double highest_radps_ = 0.0;

  mavlink::FrameDecoder decoder_;
  mavlink::FrameWriter writer_;
  mavlink::AutopilotState autopilot_;
  OutsideCommand command_;  ///< the last controls
  bool in_lockstep_ = false, is_answered_ = false;
  int64_t unanswered_in_row_ = 0;
  double next_state_s_ = 0.0;  ///< wall time, before the first answer
  std::vector<uint8_t> messages_in_, messages_out_, state_out_;
  LinkFigures figures_;
};

}  // namespace hedgehop::sim::link
