#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Writes the fields of one message in the wire format of protocol buffers [ProtobufEncoding2024] sec. "Message
/// Structure". Fields may be written in any order; zeros are written, too. @param number  of the field, 1 to 2^29 - 1.
class ProtobufWriter {
 public:
  ProtobufWriter& add_integer(uint32_t number, uint64_t value);
  ProtobufWriter& add_double(uint32_t number, double value);
  ProtobufWriter& add_fixed32(uint32_t number, uint32_t value);
  /// Adds a text, bytes or an inner message.
  ProtobufWriter& add_bytes(uint32_t number, std::string_view bytes);
  ProtobufWriter& add_message(uint32_t number, const ProtobufWriter& message);
  /// Adds repeated numbers in one packed field.
  ProtobufWriter& add_doubles(uint32_t number, std::span<const double> values);
  ProtobufWriter& add_fixed32s(uint32_t number, std::span<const uint32_t> values);
  /// Adds an inner message of doubles, of fields 1, 2, ...
  ProtobufWriter& add_numbers(uint32_t number, std::initializer_list<double> values);

  const std::string& bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  void add_key(uint32_t number, uint32_t wire_type);
  void add_varint(uint64_t value);

  std::string bytes_;
};

}  // namespace hedgehop::sim
