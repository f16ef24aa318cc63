#include "sim/mavlink/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sim/mavlink/command_messages.h"
#include "sim/mavlink/hil_messages.h"

namespace hedgehop::sim::mavlink {
namespace {

constexpr uint8_t kMagic = 0xFD;

std::vector<uint8_t> heartbeat(uint32_t custom_mode) {
  FrameWriter writer({1, 1});
  std::vector<uint8_t> bytes;
  writer.append(Heartbeat{.custom_mode = custom_mode, .type = 2, .autopilot = 3}, bytes);
  return bytes;
}

/// A frame with an id that the library does not know (GLOBAL_POSITION_INT).
std::vector<uint8_t> unknown_frame(uint8_t fill) {
  FrameWriter writer({1, 1});
  Payload payload;
  payload.bytes.fill(fill);
  payload.size = 28;
  std::vector<uint8_t> bytes;
  writer.append(33, payload, 104, bytes);
  return bytes;
}

std::vector<uint8_t> joined(std::initializer_list<std::vector<uint8_t>> parts) {
  std::vector<uint8_t> all;
  for (const std::vector<uint8_t>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<uint32_t> modes(const std::vector<Frame>& frames) {
  std::vector<uint32_t> found;
  for (const Frame& frame : frames) {
    if (const auto message = frame.as<Heartbeat>()) found.push_back(message->custom_mode);
  }
  return found;
}

TEST(FrameDecoder, FindsFramesCutAnywhere) {
  const std::vector<uint8_t> stream = joined({heartbeat(1), unknown_frame(kMagic), heartbeat(2), heartbeat(3)});
  for (size_t piece = 1; piece <= stream.size(); ++piece) {
    FrameDecoder decoder;
    std::vector<uint32_t> found;
    for (size_t at = 0; at < stream.size(); at += piece) {
      const auto part = std::span(stream).subspan(at, std::min(piece, stream.size() - at));
      std::ranges::copy(modes(decoder.decode(part)), std::back_inserter(found));
    }
    ASSERT_EQ(found, (std::vector<uint32_t>{1, 2, 3})) << "pieces of " << piece;
    ASSERT_EQ(decoder.counts(), (DecoderCounts{.frames = 3, .unknown = 1})) << "pieces of " << piece;
  }
}

TEST(FrameDecoder, ReturnsAFrameWithItsLastByte) {
  const std::vector<uint8_t> bytes = heartbeat(7);
  FrameDecoder decoder;
  EXPECT_TRUE(decoder.decode(std::span(bytes).first(bytes.size() - 1)).empty());
  EXPECT_EQ(modes(decoder.decode(std::span(bytes).last(1))), std::vector<uint32_t>{7});
}

TEST(FrameDecoder, FindsTheNextFrameAfterAnyCorruptedByte) {
  const std::vector<uint8_t> first = heartbeat(1), later = joined({heartbeat(2), heartbeat(3), heartbeat(4)});
  std::vector<uint8_t> padding(300, 0);  // completes a frame whose length was corrupted
  for (size_t at = 0; at < first.size(); ++at) {
    std::vector<uint8_t> corrupted = first;
    corrupted[at] ^= 0x5A;
    FrameDecoder decoder;
    const std::vector<uint32_t> found = modes(decoder.decode(joined({corrupted, later, padding})));
    EXPECT_EQ(std::ranges::count(found, 1u), 0) << at;
    EXPECT_EQ(std::ranges::count(found, 4u), 1) << at;
  }
}

TEST(FrameDecoder, RefusesEveryFlippedBitOfAFrame) {
  const std::vector<uint8_t> frame = heartbeat(1);
  for (size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    std::vector<uint8_t> flipped = frame;
    flipped[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    FrameDecoder decoder;
    EXPECT_TRUE(decoder.decode(flipped).empty()) << bit;
  }
}

TEST(FrameDecoder, RefusesSignedFramesAndCountsThem) {
  std::vector<uint8_t> signed_frame = heartbeat(1);
  signed_frame[2] = 1;  // the flag of a signature of 13 bytes
  signed_frame.insert(signed_frame.end(), 13, kMagic);
  FrameDecoder decoder;
  EXPECT_EQ(modes(decoder.decode(joined({signed_frame, heartbeat(2)}))), std::vector<uint32_t>{2});
  EXPECT_EQ(decoder.counts(), (DecoderCounts{.frames = 1, .signed_frames = 1}));
}

TEST(FrameDecoder, SkipsFramesOfVersionOneAndCountsThem) {
  // HEARTBEAT of MAVLink 1: FE length sequence system component id payload checksum
  const std::vector<uint8_t> old = {0xFE, 9, 0, 1, 1, 0, 0, 0, 0, 0, 2, 3, 0, 4, 3, 0x11, 0x22};
  FrameDecoder decoder;
  EXPECT_EQ(modes(decoder.decode(joined({old, heartbeat(2)}))), std::vector<uint32_t>{2});
  EXPECT_EQ(decoder.counts(), (DecoderCounts{.frames = 1, .version_1 = 1}));
}

/// Fragments of valid frames with random changes, without an end between them.
TEST(FrameDecoder, CountsAMillionMalformedFragmentsAndGoesOn) {
  std::mt19937_64 random(1);
  FrameWriter writer({1, 1});
  FrameDecoder decoder;
  int64_t sent = 0;
  std::vector<uint8_t> bytes;
  for (int i = 0; i < 1'000'000; ++i) {
    bytes.clear();
    writer.append(HilActuatorControls{.time_usec = random(), .flags = 1}, bytes);
    bytes[random() % bytes.size()] ^= static_cast<uint8_t>(1 + random() % 255);
    bytes.resize(random() % (bytes.size() + 1));
    sent += static_cast<int64_t>(bytes.size());
    decoder.decode(bytes);
  }
  const std::vector<Frame> frames = decoder.decode(joined({std::vector<uint8_t>(300, 0), heartbeat(5)}));
  EXPECT_EQ(modes(frames), std::vector<uint32_t>{5});
  EXPECT_LE(decoder.counts().bad_bytes, sent + 300);
  EXPECT_GT(decoder.counts().malformed, 1);
  EXPECT_GT(decoder.counts().bad_bytes, sent / 2);
  EXPECT_LT(decoder.counts().frames, 1000) << "a checksum of 16 bits accepts few random frames";
}

TEST(FrameDecoder, KnowsOnlyMessagesOfItsTable) {
  EXPECT_EQ(known_crc_extra(0), 50);
  EXPECT_EQ(known_crc_extra(33), std::nullopt);
  FrameDecoder decoder([](uint32_t id) { return id == 33 ? std::optional<uint8_t>(104) : std::nullopt; });
  const std::vector<Frame> frames = decoder.decode(unknown_frame(9));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].payload.size, 28u);
}

}  // namespace
}  // namespace hedgehop::sim::mavlink
