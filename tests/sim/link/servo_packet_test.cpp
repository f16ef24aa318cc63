#include "sim/link/servo_packet.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <vector>

namespace hedgehop::sim::link {
namespace {

/// The first packet of a copter, byte by byte: magic 18458, rate 1200, count 0, sixteen pulses of 1000.
std::vector<uint8_t> first_packet() {
  std::vector<uint8_t> bytes = {0x1a, 0x48, 0xb0, 0x04, 0, 0, 0, 0};
  for (int i = 0; i < 16; ++i) bytes.insert(bytes.end(), {0xe8, 0x03});
  return bytes;
}

TEST(ServoPacket, FirstPacketOfACopterIsRead) {
  const std::optional<ServoPacket> packet = parse_servo_packet(first_packet());
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->rate_hz, 1200);
  EXPECT_EQ(packet->count, 0u);
  EXPECT_EQ(packet->outputs, 16u);
  for (size_t i = 0; i < 16; ++i) EXPECT_EQ(packet->pulse_us[i], 1000);
}

TEST(ServoPacket, ThirtyTwoOutputsHaveAnotherMagicAndCountsAreLittleEndian) {
  std::vector<uint8_t> bytes = {0x81, 0x73, 0x90, 0x01, 0x78, 0x56, 0x34, 0x12};
  for (uint8_t i = 0; i < 32; ++i) bytes.insert(bytes.end(), {i, 0x05});
  const std::optional<ServoPacket> packet = parse_servo_packet(bytes);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->rate_hz, 400);
  EXPECT_EQ(packet->count, 0x12345678u);
  EXPECT_EQ(packet->outputs, 32u);
  EXPECT_EQ(packet->pulse_us[31], 0x051f);
}

TEST(ServoPacket, WrongLengthOrMagicIsRefusedWithTheValidOnes) {
  std::vector<uint8_t> bytes(28);
  bytes[0] = 0xd2;
  bytes[1] = 0x04;
  EXPECT_FALSE(parse_servo_packet(bytes));
  EXPECT_EQ(wrong_packet_words(bytes), "28 bytes with magic 1234; expected 40 with 18458 or 72 with 29569");
  EXPECT_EQ(wrong_packet_words({}), "0 bytes with no magic; expected 40 with 18458 or 72 with 29569");
  std::vector<uint8_t> long_by_one = first_packet();
  long_by_one.push_back(0);
  EXPECT_FALSE(parse_servo_packet(long_by_one));
  EXPECT_FALSE(parse_servo_packet(std::span(long_by_one).first(39)));
  std::vector<uint8_t> magic_of_the_other = first_packet();
  magic_of_the_other[0] = 0x81;
  magic_of_the_other[1] = 0x73;
  EXPECT_FALSE(parse_servo_packet(magic_of_the_other));
}

TEST(ServoPacket, AMillionMalformedDatagramsAreRefused) {
  std::mt19937 random(1);
  std::vector<uint8_t> bytes(128);
  for (int i = 0; i < 1'000'000; ++i) {
    for (size_t k = 0; k < bytes.size(); k += 4) {
      const auto four = static_cast<uint32_t>(random());
      std::memcpy(&bytes[k], &four, 4);
    }
    if (i % 4 == 0) {  // half a valid packet
      bytes[0] = 0x1a;
      bytes[1] = 0x48;
    }
    const size_t length = random() % bytes.size();
    const bool could_be_valid = (length == 40 && bytes[0] == 0x1a && bytes[1] == 0x48) ||
                                (length == 72 && bytes[0] == 0x81 && bytes[1] == 0x73);
    ASSERT_EQ(parse_servo_packet(std::span(bytes).first(length)).has_value(), could_be_valid);
  }
}

}  // namespace
}  // namespace hedgehop::sim::link
