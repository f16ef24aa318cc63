#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hedgehop::sim::mavlink {

/// The checksum of MAVLink frames and message definitions: CRC-16/MCRF4XX (polynomial 0x1021 reflected, initial value
/// 0xFFFF, no final inversion). Source: [Mavlink2024] sec. on serialization.
class Checksum {
 public:
  constexpr void add(uint8_t byte) {
    uint8_t mixed = byte ^ static_cast<uint8_t>(value_ & 0xFF);
    mixed = static_cast<uint8_t>(mixed ^ (mixed << 4));
    value_ = static_cast<uint16_t>((value_ >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
  }
  constexpr void add(std::span<const uint8_t> bytes) {
    for (const uint8_t byte : bytes) add(byte);
  }
  constexpr void add(std::string_view text) {
    for (const char letter : text) add(static_cast<uint8_t>(letter));
  }
  constexpr uint16_t value() const { return value_; }

 private:
  uint16_t value_ = 0xFFFF;
};

}  // namespace hedgehop::sim::mavlink
