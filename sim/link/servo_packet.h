#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

/// ArduPilot's packets to its JSON physics backend.
namespace hedgehop::sim::link {

/// One packet: the pulses of all servo outputs. Source: ArduPilot, libraries/SITL/examples/JSON/readme.md, sec. on the
/// output data.
struct ServoPacket {
  uint16_t rate_hz = 0;
  uint32_t count = 0;
  std::array<uint16_t, 32> pulse_us{};  ///< of SERVO1, 2, ...; 0: no pulse
  size_t outputs = 0;                   ///< 16 or 32
};

/// Returns the packet of a datagram; nullopt for another length or magic number.
std::optional<ServoPacket> parse_servo_packet(std::span<const uint8_t> datagram);

/// Returns "28 bytes with magic 1234; expected 40 with 18458 or 72 with 29569".
std::string wrong_packet_words(std::span<const uint8_t> datagram);

}  // namespace hedgehop::sim::link
