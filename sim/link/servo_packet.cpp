#include "sim/link/servo_packet.h"

#include <fmt/format.h>

namespace hedgehop::sim::link {
namespace {

struct ServoLayout {
  uint32_t magic;
  size_t outputs;
};
constexpr ServoLayout kServoLayouts[] = {{18458, 16}, {29569, 32}};
constexpr size_t kServoHeaderBytes = 8;  // magic, rate, count

size_t bytes_of(const ServoLayout& layout) { return kServoHeaderBytes + 2 * layout.outputs; }

/// Reads a little-endian number.
uint32_t unsigned_at(std::span<const uint8_t> bytes, size_t at, size_t size) {
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i) value |= static_cast<uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

}  // namespace

std::optional<ServoPacket> parse_servo_packet(std::span<const uint8_t> datagram) {
  for (const ServoLayout& layout : kServoLayouts) {
    if (datagram.size() != bytes_of(layout) || unsigned_at(datagram, 0, 2) != layout.magic) continue;
    ServoPacket packet{.rate_hz = static_cast<uint16_t>(unsigned_at(datagram, 2, 2)),
                       .count = unsigned_at(datagram, 4, 4),
                       .pulse_us = {},
                       .outputs = layout.outputs};
    for (size_t i = 0; i < layout.outputs; ++i) {
      packet.pulse_us[i] = static_cast<uint16_t>(unsigned_at(datagram, kServoHeaderBytes + 2 * i, 2));
    }
    return packet;
  }
  return std::nullopt;
}

std::string wrong_packet_words(std::span<const uint8_t> datagram) {
  const std::string magic = datagram.size() < 2 ? "no magic" : fmt::format("magic {}", unsigned_at(datagram, 0, 2));
  return fmt::format("{} bytes with {}; expected {} with {} or {} with {}", datagram.size(), magic,
                     bytes_of(kServoLayouts[0]), kServoLayouts[0].magic, bytes_of(kServoLayouts[1]),
                     kServoLayouts[1].magic);
}

}  // namespace hedgehop::sim::link
