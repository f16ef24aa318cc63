#include "sim/link/ardupilot_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/link/state_text.h"

namespace hedgehop::sim::link {
namespace {

constexpr double kRangeRateHz = 50.0;  // of the range finders, above the rates at which autopilots read them

bool keeps_rotor_speed(const dynamics::VehicleConfig& vehicle) {
  const auto* const helicopter = std::get_if<dynamics::helicopter::HelicopterConfig>(&vehicle);
  return helicopter && std::holds_alternative<dynamics::helicopter::ConstantSpeedConfig>(helicopter->rotor_speed);
}

}  // namespace

ArduPilotLink::ArduPilotLink(const Scenario& scenario, std::unique_ptr<PacketSource> source, MessageChannel* channel,
                             std::filesystem::path recording)
    : config_(std::get<ArduPilotLinkConfig>(scenario.link.value())),
      physics_rate_hz_(static_cast<double>(scenario.physics_rate_hz.value())),
      range_period_(std::max<int64_t>(1, static_cast<int64_t>(physics_rate_hz_ / kRangeRateHz))),
      keeps_rotor_speed_(keeps_rotor_speed(scenario.vehicle)),
      source_(std::move(source)),
      channel_(channel),
      recording_file_(std::move(recording)),
      mixing_(config_, scenario.vehicle) {
  figures_.kind = ArduPilotLinkConfig::kName;
}

void ArduPilotLink::prepare(const avoidance::Needs& needs, const avoidance::Setup& setup) {
  if (channel_) channel_->prepare(needs, setup);
}

std::variant<OutsideCommand, LinkEnd> ArduPilotLink::exchange(const OutsideInput& input) {
  if (std::optional<LinkEnd> end = take_arrived(input.step)) return *std::move(end);
  if (std::optional<LinkEnd> end = exchange_messages(input)) return *std::move(end);
  if (order_.last()) {
    if (std::optional<LinkEnd> end = answer(input)) return *std::move(end);
  }
  return wait_for_next(input);
}

LinkFigures ArduPilotLink::figures() const {
  LinkFigures figures = figures_;
  figures.peer = source_->peer();
  figures.strangers = source_->strangers();
  figures.waited_s = source_->waited_s();
  if (channel_) figures.malformed += channel_->malformed();
  return figures;
}

/// Empties the sockets before an answer: a packet that the autopilot repeated while we computed must not be answered
/// twice.
std::optional<LinkEnd> ArduPilotLink::take_arrived(int64_t step) {
  if (!order_.last()) return std::nullopt;
  while (const std::optional<PacketSource::Packet> packet = source_->arrived(step)) {
    Taken taken = take(*packet, step, step);
    if (taken) return std::get<LinkEnd>(*std::move(taken));
  }
  return std::nullopt;
}

std::optional<LinkEnd> ArduPilotLink::exchange_messages(const OutsideInput& input) {
  if (!channel_) {
    serial_in_.clear();
    return std::nullopt;
  }
  channel_->receive(input, serial_in_);
  serial_in_.clear();
  serial_out_.clear();
  try {
    channel_->send(input, serial_out_);
  } catch (const std::invalid_argument& error) {
    return LinkEnd{Outcome::fault, error.what()};
  }
  if (!source_->send_serial(serial_out_)) {
    return link_lost(fmt::format("the autopilot does not read its serial line at tick {}", input.step));
  }
  return std::nullopt;
}

std::optional<LinkEnd> ArduPilotLink::answer(const OutsideInput& input) {
  if (input.step % range_period_ == 0 || range_m_.empty()) measure_ranges(input);
  const PhysicsState state{.step = input.step,
                           .time_s = static_cast<double>(input.step) / physics_rate_hz_,
                           .body = input.body,
                           .specific_force_B = input.specific_force_B,
                           .wind_W = input.wind_W,
                           .range_m = range_m_};
  if (!write_state(state, state_text_)) return link_lost(fmt::format("the state is not finite at tick {}", input.step));
  source_->answer(state_text_);
  order_.answered();
  answered_s_ = waiting_since_s_ = source_->now_s();
  return std::nullopt;
}

std::variant<OutsideCommand, LinkEnd> ArduPilotLink::wait_for_next(const OutsideInput& input) {
  if (!order_.last()) waiting_since_s_ = source_->now_s();
  for (;;) {
    const double patience_s = order_.last() ? config_.silence_s : config_.start.first_packet_s;
    const auto found = source_->next(input.step, waiting_since_s_ + patience_s);
    if (const auto* const absence = std::get_if<PacketSource::Absence>(&found)) {
      if (!order_.last()) throw InputError("link: " + absence->words);
      return link_lost(fmt::format("{} at tick {}", absence->words, input.step));
    }
    Taken taken = take(std::get<PacketSource::Packet>(found), input.step, input.step + 1);
    if (!taken) continue;
    if (auto* const end = std::get_if<LinkEnd>(&*taken)) return std::move(*end);
    auto& command = std::get<OutsideCommand>(*taken);
    if (keeps_rotor_speed_ && !command.engine_on && !input.on_stand) {
      return LinkEnd{Outcome::fault,
                     fmt::format("link: SERVO8 switched the engine off in flight at tick {}", input.step)};
    }
    ++figures_.frames;
    return std::move(command);
  }
}

/// @param serial_step  on which serial bytes act.
ArduPilotLink::Taken ArduPilotLink::take(const PacketSource::Packet& packet, int64_t step, int64_t serial_step) {
  if (packet.is_serial) {
    record(serial_step, packet);
    if (channel_) serial_in_.insert(serial_in_.end(), packet.bytes.begin(), packet.bytes.end());
    return std::nullopt;
  }
  const std::optional<ServoPacket> servos = parse_servo_packet(packet.bytes);
  if (!servos) {
    if (!order_.last()) {
      throw InputError(fmt::format("link: {}: is the autopilot's model JSON?", wrong_packet_words(packet.bytes)));
    }
    ++figures_.malformed;
    return std::nullopt;
  }
  record(step, packet);
  const double now_s = source_->now_s();
  const std::optional<uint32_t> last = order_.last();
  switch (order_.judge(servos->count, now_s - answered_s_)) {
    case PacketOrder::Judgment::next:
      return mixing_.command(*servos);
    case PacketOrder::Judgment::refused:
      if (const std::optional<std::string> reason = source_->end_by_repeats(servos->count)) return link_lost(*reason);
      [[fallthrough]];
    case PacketOrder::Judgment::repeated:
      ++figures_.repeated;
      if (now_s - answered_s_ >= config_.resend_s && !state_text_.empty() && order_.is_answered()) {
        source_->answer(state_text_);
        answered_s_ = now_s;
        ++figures_.resent;
      }
      return std::nullopt;
    case PacketOrder::Judgment::old:
      ++figures_.old;
      return std::nullopt;
    case PacketOrder::Judgment::gap:
      figures_.missed += servos->count - *last - 1;
      return link_lost(fmt::format("packets {} to {} are missing", *last + 1, servos->count - 1));
    case PacketOrder::Judgment::restart:
      return link_lost(fmt::format("the autopilot restarted at tick {}", step));
    case PacketOrder::Judgment::early:
      break;
  }
  return link_lost(fmt::format("packet {} came before the answer to packet {}", servos->count, *last));
}

/// Range finders read at kRangeRateHz and keep their reading in between.
void ArduPilotLink::measure_ranges(const OutsideInput& input) {
  range_m_.clear();
  for (const LinkRangeFinderConfig& finder : config_.range_finders) {
    const Eigen::Vector3d p_W = input.body.p_WB + input.body.q_WB * finder.p_BI_m;
    const Eigen::Vector3d direction_W = input.body.q_WB * finder.direction_B.normalized();
    range_m_.push_back(input.beam_distance(p_W, direction_W, finder.max_m));
  }
}

void ArduPilotLink::record(int64_t step, const PacketSource::Packet& packet) {
  if (recording_file_.empty()) return;
  if (!recording_) recording_.emplace(recording_file_);
  recording_->add(step, packet.is_serial, packet.bytes);
}

}  // namespace hedgehop::sim::link
