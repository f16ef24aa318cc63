#include "sim/link/px4_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/config/input_error.h"
#include "sim/scenario/motor_frames.h"

namespace hedgehop::sim::link {
namespace {

constexpr mavlink::Sender kSimulator{1, 200};
constexpr double kImuPeriodS = 1.0 / static_cast<double>(HilSensors::kImuRateHz);

}  // namespace

Px4Link::Px4Link(const Scenario& scenario, std::unique_ptr<HilSource> source, std::unique_ptr<MessageChannel> channel,
                 std::filesystem::path recording)
    : config_(std::get<Px4LinkConfig>(scenario.link.value())),
      source_(std::move(source)),
      channel_(std::move(channel)),
      recording_file_(std::move(recording)),
      sensors_(scenario.physics_rate_hz.value(), scenario.seed),
      writer_(kSimulator),
      autopilot_(mavlink::AutopilotMake::px4) {
  const auto& vehicle = std::get<dynamics::multicopter::MulticopterConfig>(scenario.vehicle);
  MotorMatch match = match_motors(vehicle, config_.frame_class, config_.frame_type, "link");
  if (!match.errors.empty()) throw InputError(std::move(match.errors));
  arm_of_motor_ = std::move(match.arm_of_motor);
  highest_radps_ = vehicle.rotor.highest_radps;
  const auto rotors = static_cast<Eigen::Index>(arm_of_motor_.size());
  command_.actuators = dynamics::multicopter::PerRotor(dynamics::multicopter::PerRotor::Zero(rotors));
  figures_.kind = Px4LinkConfig::kName;
}

void Px4Link::prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) {
  if (channel_) channel_->prepare(needs, setup);
}

std::variant<OutsideCommand, LinkEnd> Px4Link::exchange(const OutsideInput& input) {
  sensors_.observe(input);
  if (input.step == 0) {
    if (!source_->connect(source_->now_s() + config_.start.first_packet_s))
      throw InputError("link: " + source_->absence());
    next_state_s_ = source_->now_s();
    return command_;
  }
  if (input.step % sensors_.period() != 0) {
    if (channel_) channel_->receive(input, {});  // the module's images may come between two states
    return command_;
  }
  if (std::optional<LinkEnd> end = exchange_messages(input)) return *std::move(end);
  if (std::optional<LinkEnd> end = send_state(input)) return *std::move(end);
  if (std::optional<LinkEnd> end = wait_for_controls(input)) return *std::move(end);
  return command_;
}

LinkFigures Px4Link::figures() const {
  LinkFigures figures = figures_;
  figures.peer = source_->peer();
  figures.strangers = source_->strangers();
  figures.waited_s = source_->waited_s();
  figures.malformed = decoder_.counts().malformed + decoder_.counts().signed_frames;
  if (channel_) figures.malformed += channel_->malformed();
  return figures;
}

std::optional<LinkEnd> Px4Link::exchange_messages(const OutsideInput& input) {
  messages_in_.clear();
  while (const std::optional<HilSource::Chunk> chunk = source_->message(input.step)) {
    record(input.step, *chunk);
    messages_in_.insert(messages_in_.end(), chunk->bytes.begin(), chunk->bytes.end());
  }
  if (!channel_) return std::nullopt;
  channel_->receive(input, messages_in_);
  messages_out_.clear();
  try {
    channel_->send(input, messages_out_);
  } catch (const std::invalid_argument& error) {
    return LinkEnd{Outcome::fault, error.what()};
  }
  source_->send_message(messages_out_);
  return std::nullopt;
}

std::optional<LinkEnd> Px4Link::send_state(const OutsideInput& input) {
  const bool is_finite = input.body.p_WB.allFinite() && input.body.q_WB.coeffs().allFinite() &&
                         input.body.v_WB_B.allFinite() && input.specific_force_B.allFinite();
  if (!is_finite) return link_lost(fmt::format("the state is not finite at tick {}", input.step));
  state_out_.clear();
  writer_.append(sensors_.sensor(input), state_out_);
  writer_.append(sensors_.state(input), state_out_);
  if (const std::optional<mavlink::HilGps> fix = sensors_.gps(input.step)) writer_.append(*fix, state_out_);
  if (source_->send(state_out_)) return std::nullopt;
  return link_lost(fmt::format("the autopilot does not read its stream at tick {}", input.step));
}

/// Waits for controls that are as new as the state: at the pace of the wall before the first ones, then for a limited
/// time.
std::optional<LinkEnd> Px4Link::wait_for_controls(const OutsideInput& input) {
  is_answered_ = false;
  next_state_s_ += kImuPeriodS;
  const double patient_until_s = source_->now_s() + config_.unanswered_s;
  while (!is_answered_) {
    const double deadline_s = in_lockstep_ ? patient_until_s : next_state_s_;
    const std::optional<HilSource::Chunk> chunk = source_->stream(input.step, deadline_s);
    if (chunk && !take_stream(*chunk, input.step)) {
      if (!in_lockstep_) throw InputError("link: the autopilot closed its connection before its first controls");
      return link_lost(fmt::format("the autopilot closed its connection at tick {}", input.step));
    }
    const bool is_late = !chunk || source_->now_s() >= deadline_s;
    if (!is_answered_ && is_late) return miss_answer(input.step);
  }
  unanswered_in_row_ = 0;
  ++figures_.frames;
  return std::nullopt;
}

std::optional<LinkEnd> Px4Link::miss_answer(int64_t step) {
  if (!in_lockstep_) {
    const double waited_s = 1e-6 * static_cast<double>(sensors_.time_us(step));
    if (waited_s < config_.start.first_packet_s) return std::nullopt;
    throw InputError(fmt::format("link: no HIL_ACTUATOR_CONTROLS within {:g} s; see the output of PX4's start-up",
                                 config_.start.first_packet_s));
  }
  ++figures_.unanswered;
  if (++unanswered_in_row_ < kMaxUnanswered) return std::nullopt;
  return link_lost(fmt::format("no controls for {} states up to tick {}", kMaxUnanswered, step));
}

/// Reads bytes of the stream. @return false at its end.
bool Px4Link::take_stream(const HilSource::Chunk& chunk, int64_t step) {
  record(step, chunk);
  if (chunk.bytes.empty()) return false;
  for (const mavlink::Frame& frame : decoder_.decode(chunk.bytes)) {
    autopilot_.take(frame);
    take_controls(frame, step);
  }
  if (!in_lockstep_ || !autopilot_.fault().empty()) require_protocol();
  return true;
}

/// Takes the newest controls; older ones than the state are counted.
void Px4Link::take_controls(const mavlink::Frame& frame, int64_t step) {
  const auto message = frame.as<mavlink::HilActuatorControls>();
  if (!message) return;
  in_lockstep_ = true;
  if (message->time_usec < sensors_.time_us(step)) {
    ++figures_.old;
    return;
  }
  figures_.repeated += is_answered_ ? 1 : 0;
  is_answered_ = true;
  auto& speeds_radps = std::get<dynamics::multicopter::PerRotor>(command_.actuators);
  for (size_t motor = 0; motor < arm_of_motor_.size(); ++motor) {
    const auto control = static_cast<double>(message->controls[motor]);
    speeds_radps[static_cast<Eigen::Index>(arm_of_motor_[motor])] =
        control > 0.0 ? highest_radps_ * std::min(control, 1.0) : 0.0;  // NaN: an output without a function
  }
}

void Px4Link::require_protocol() const {
  if (!autopilot_.fault().empty()) throw InputError("link: " + autopilot_.fault());
  const mavlink::DecoderCounts& counts = decoder_.counts();
  if (counts.frames == 0 && counts.version_1 > 0) throw InputError("link: MAVLink 1; valid: MAVLink 2");
}

void Px4Link::record(int64_t step, const HilSource::Chunk& chunk) {
  if (recording_file_.empty()) return;
  if (!recording_) recording_.emplace(recording_file_);
  recording_->add(step, chunk.is_message, chunk.bytes);
}

}  // namespace hedgehop::sim::link
