#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/mavlink/message_fields.h"

/// MAVLink 2 frames: `FD length incompat compat sequence system component id(3) payload checksum(2)`.
/// Source: [Mavlink2024] sec. on serialization.
namespace hedgehop::sim::mavlink {

/// Identity of the sender of a frame.
struct Sender {
  uint8_t system = 1, component = 0;
};

struct Frame {
  Sender sender;
  uint8_t sequence = 0;
  uint32_t id = 0;
  Payload payload;

  /// Returns the message if this frame contains one of this type.
  template <class Message>
  std::optional<Message> as() const {
    if (id != Message::kId) return {};
    return decode<Message>(payload.view());
  }
};

/// Appends frames of one sender to a stream.
class FrameWriter {
 public:
  explicit FrameWriter(Sender sender) : sender_(sender) {}

  template <class Message>
  void append(const Message& message, std::vector<uint8_t>& bytes) {
    append(Message::kId, encode(message), crc_extra<Message>(), bytes);
  }
  /// @param crc_extra  of the message with this id.
  void append(uint32_t id, const Payload& payload, uint8_t crc_extra, std::vector<uint8_t>& bytes);

 private:
  Sender sender_;
  uint8_t sequence_ = 0;
};

/// Returns CRC_EXTRA of a message by its id; empty for messages that the receiver does not know.
using CrcExtraOf = std::function<std::optional<uint8_t>(uint32_t id)>;
/// Knows the messages of this library.
std::optional<uint8_t> known_crc_extra(uint32_t id);

/// Numbers of accepted and refused frames.
struct DecoderCounts {
  int64_t frames = 0;         ///< accepted
  int64_t unknown = 0;        ///< frames with an unknown id, skipped
  int64_t version_1 = 0;      ///< frames of MAVLink 1, skipped
  int64_t signed_frames = 0;  ///< refused: this decoder has no key
  int64_t malformed = 0;      ///< places at which bytes were refused: no frame, or one with a wrong checksum
  int64_t bad_bytes = 0;      ///< refused bytes

  bool operator==(const DecoderCounts&) const = default;
};

/// Finds the frames in a stream that is received in pieces. After a corrupted frame it accepts only frames with a known
/// id and a right checksum until one was found. It keeps at most one incomplete frame.
class FrameDecoder {
 public:
  explicit FrameDecoder(CrcExtraOf crc_extra_of = known_crc_extra) : crc_extra_of_(std::move(crc_extra_of)) {}

  /// Returns the frames that these bytes complete.
  std::vector<Frame> decode(std::span<const uint8_t> bytes);
  const DecoderCounts& counts() const { return counts_; }

 private:
  /// Returns the bytes that the first frame of `rest` uses, 0 if it is incomplete.
  size_t take(std::span<const uint8_t> rest, std::vector<Frame>& frames);
  size_t take_version_1(std::span<const uint8_t> rest);
  size_t skip(size_t size, size_t available, int64_t& count);
  size_t refuse_byte();

  CrcExtraOf crc_extra_of_;
  std::vector<uint8_t> pending_;
  bool in_step_ = true;  ///< no byte was refused since the last frame
  DecoderCounts counts_;
};

}  // namespace hedgehop::sim::mavlink
