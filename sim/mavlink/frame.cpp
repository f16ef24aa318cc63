#include "sim/mavlink/frame.h"

#include <algorithm>
#include <array>

#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/hil_messages.h"
#include "sim/mavlink/perception_messages.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr uint8_t kMagic = 0xFD, kMagic1 = 0xFE;
constexpr size_t kHeader = 10, kChecksum = 2, kSignature = 13;
constexpr size_t kHeader1 = 6;
constexpr uint8_t kSigned = 1;  // the only defined incompatibility flag

struct KnownMessage {
  uint32_t id;
  uint8_t crc_extra;
};

template <class... Messages>
constexpr std::array<KnownMessage, sizeof...(Messages)> known() {
  return {KnownMessage{Messages::kId, crc_extra<Messages>()}...};
}

constexpr auto kKnown =
    known<Heartbeat, Attitude, LocalPositionNed, RcChannelsOverride, CommandLong, CommandAck, SetPositionTargetLocalNed,
          EkfStatusReport, StatusText, ObstacleDistance, DistanceSensor, OpticalFlow, OpticalFlowRad,
          VisionPositionEstimate, Odometry, HilSensor, HilGps, HilStateQuaternion, HilActuatorControls>();

uint16_t frame_checksum(std::span<const uint8_t> after_magic, uint8_t extra) {
  Checksum sum;
  sum.add(after_magic);
  sum.add(extra);
  return sum.value();
}

}  // namespace

std::optional<uint8_t> known_crc_extra(uint32_t id) {
  const auto found = std::ranges::find(kKnown, id, &KnownMessage::id);
  return found == kKnown.end() ? std::nullopt : std::optional(found->crc_extra);
}

void FrameWriter::append(uint32_t id, const Payload& payload, uint8_t crc_extra, std::vector<uint8_t>& bytes) {
  const size_t begin = bytes.size();
  const auto byte_of = [](uint32_t value, int place) { return static_cast<uint8_t>((value >> (8 * place)) & 0xFF); };
  bytes.insert(bytes.end(), {kMagic, static_cast<uint8_t>(payload.size), 0, 0, sequence_++, sender_.system,
                             sender_.component, byte_of(id, 0), byte_of(id, 1), byte_of(id, 2)});
  bytes.insert(bytes.end(), payload.view().begin(), payload.view().end());
  const uint16_t sum = frame_checksum(std::span(bytes).subspan(begin + 1), crc_extra);
  bytes.insert(bytes.end(), {byte_of(sum, 0), byte_of(sum, 1)});
}

std::vector<Frame> FrameDecoder::decode(std::span<const uint8_t> bytes) {
  std::vector<Frame> frames;
  pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  std::span<const uint8_t> rest(pending_);
  while (!rest.empty()) {
    const size_t used = take(rest, frames);
    if (used == 0) break;
    rest = rest.subspan(used);
  }
  pending_.erase(pending_.begin(), pending_.end() - static_cast<ptrdiff_t>(rest.size()));
  return frames;
}

size_t FrameDecoder::take(std::span<const uint8_t> rest, std::vector<Frame>& frames) {
  if (rest[0] == kMagic1 && in_step_) return take_version_1(rest);
  if (rest[0] != kMagic) return refuse_byte();
  if (rest.size() < 3) return 0;
  const size_t payload_size = rest[1], size = kHeader + payload_size + kChecksum;
  if ((rest[2] & ~kSigned) != 0) return refuse_byte();  // unknown flags change the format
  if (rest.size() < kHeader) return 0;
  if ((rest[2] & kSigned) != 0) {
    return in_step_ ? skip(size + kSignature, rest.size(), counts_.signed_frames) : refuse_byte();
  }
  const uint32_t id = rest[7] | static_cast<uint32_t>(rest[8]) << 8 | static_cast<uint32_t>(rest[9]) << 16;
  const std::optional<uint8_t> extra = crc_extra_of_(id);
  if (!extra) return in_step_ ? skip(size, rest.size(), counts_.unknown) : refuse_byte();
  if (rest.size() < size) return 0;
  const auto sum = static_cast<uint16_t>(rest[size - 2] | rest[size - 1] << 8);
  if (sum != frame_checksum(rest.subspan(1, size - 1 - kChecksum), *extra)) return refuse_byte();

  Frame frame{{rest[5], rest[6]}, rest[4], id, {}};
  frame.payload.size = payload_size;
  std::ranges::copy(rest.subspan(kHeader, payload_size), frame.payload.bytes.begin());
  frames.push_back(frame);
  ++counts_.frames;
  in_step_ = true;
  return size;
}

size_t FrameDecoder::take_version_1(std::span<const uint8_t> rest) {
  if (rest.size() < 2) return 0;
  return skip(kHeader1 + rest[1] + kChecksum, rest.size(), counts_.version_1);
}

/// Skips a frame that cannot be verified, once it is complete.
size_t FrameDecoder::skip(size_t size, size_t available, int64_t& count) {
  if (available < size) return 0;
  ++count;
  return size;
}

size_t FrameDecoder::refuse_byte() {
  ++counts_.bad_bytes;
  if (in_step_) ++counts_.malformed;
  in_step_ = false;
  return 1;
}

}  // namespace hedgehop::sim::mavlink
