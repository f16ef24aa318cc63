#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "sim/fields/field.h"
#include "sim/mavlink/checksum.h"

/// Payloads of MAVLink 2 messages. A message is a plain struct with kId and kName, and a function template
/// list_fields(visitor, message) that lists its fields once, in the order of the wire: `v("name", message.field)` for
/// each base field, then `v.extensions()`, then the extension fields. Base fields are sorted by the size of an element,
/// largest first. Source: [Mavlink2024] sec. on serialization.
namespace hedgehop::sim::mavlink {

inline constexpr size_t kMaxPayload = 255;  ///< bytes

static_assert(std::endian::native == std::endian::little, "payloads are copied as they lie in memory");

/// Returns a value as a field of whole numbers: rounded, and limited to the range of the field. @param value  no NaN.
template <class Whole>
Whole rounded(double value) {
  constexpr auto kLow = static_cast<double>(std::numeric_limits<Whole>::min());
  constexpr auto kHigh = static_cast<double>(std::numeric_limits<Whole>::max());
  return static_cast<Whole>(std::clamp(std::round(value), kLow, kHigh));
}

template <class T>
struct IsArray : std::false_type {};
template <class T, size_t Count>
struct IsArray<std::array<T, Count>> : std::true_type {};

/// Returns the name of a scalar type in message definitions.
template <class T>
constexpr std::string_view type_name() {
  if constexpr (std::same_as<T, char>) return "char";
  if constexpr (std::same_as<T, uint8_t>) return "uint8_t";
  if constexpr (std::same_as<T, int8_t>) return "int8_t";
  if constexpr (std::same_as<T, uint16_t>) return "uint16_t";
  if constexpr (std::same_as<T, int16_t>) return "int16_t";
  if constexpr (std::same_as<T, uint32_t>) return "uint32_t";
  if constexpr (std::same_as<T, int32_t>) return "int32_t";
  if constexpr (std::same_as<T, uint64_t>) return "uint64_t";
  if constexpr (std::same_as<T, float>) return "float";
}

/// Computes CRC_EXTRA, the checksum of a message's definition. It keeps peers with different definitions apart.
class DefinitionChecksum {
 public:
  constexpr explicit DefinitionChecksum(std::string_view message) {
    sum_.add(message);
    sum_.add(" ");
  }
  template <class T>
  constexpr void operator()(std::string_view name, const T&) {
    if (extended_) return;
    if constexpr (IsArray<T>::value) {
      add(type_name<typename T::value_type>(), name);
      sum_.add(static_cast<uint8_t>(std::tuple_size_v<T>));
    } else {
      add(type_name<T>(), name);
    }
  }
  constexpr void extensions() { extended_ = true; }
  constexpr uint8_t value() const { return static_cast<uint8_t>((sum_.value() & 0xFF) ^ (sum_.value() >> 8)); }

 private:
  constexpr void add(std::string_view type, std::string_view name) {
    sum_.add(type);
    sum_.add(" ");
    sum_.add(name);
    sum_.add(" ");
  }
  Checksum sum_;
  bool extended_ = false;
};

/// Returns CRC_EXTRA of a message.
template <class Message>
constexpr uint8_t crc_extra() {
  DefinitionChecksum sum(Message::kName);
  const Message message{};
  list_fields(sum, message);
  return sum.value();
}

/// Bytes of a payload.
struct Payload {
  std::array<uint8_t, kMaxPayload> bytes{};
  size_t size = 0;
  std::span<const uint8_t> view() const { return std::span(bytes).first(size); }
};

/// Writes the fields of a message.
class PayloadWriter {
 public:
  template <class T>
  void operator()(std::string_view, const T& value) {
    const auto raw = std::bit_cast<std::array<uint8_t, sizeof(T)>>(value);
    std::ranges::copy(raw, payload_.bytes.begin() + static_cast<ptrdiff_t>(payload_.size));
    payload_.size += sizeof(T);
  }
  void extensions() {}
  const Payload& payload() const { return payload_; }

 private:
  Payload payload_;
};

/// Reads the fields of a message. Bytes that the payload lacks are 0, because senders cut trailing zeros; bytes beyond
/// the last field are ignored, because newer definitions append fields.
class PayloadReader {
 public:
  explicit PayloadReader(std::span<const uint8_t> payload) : rest_(payload) {}
  template <class T>
  void operator()(std::string_view, T& value) {
    std::array<uint8_t, sizeof(T)> raw{};
    const size_t count = std::min(rest_.size(), sizeof(T));
    std::ranges::copy(rest_.first(count), raw.begin());
    rest_ = rest_.subspan(count);
    value = std::bit_cast<T>(raw);
  }
  void extensions() {}

 private:
  std::span<const uint8_t> rest_;
};

/// Returns the payload of a message. Trailing zeros are cut, but not the first byte.
template <class Message>
Payload encode(const Message& message) {
  PayloadWriter writer;
  list_fields(writer, message);
  Payload payload = writer.payload();
  while (payload.size > 1 && payload.bytes[payload.size - 1] == 0) --payload.size;
  return payload;
}

/// Returns the message of a payload of any length.
template <class Message>
Message decode(std::span<const uint8_t> payload) {
  Message message;
  PayloadReader reader(payload);
  list_fields(reader, message);
  return message;
}

}  // namespace hedgehop::sim::mavlink
