#include "sim/logfile/protobuf_writer.h"

#include "sim/logfile/little_endian.h"

namespace hedgehop::sim {
namespace {

enum WireType : uint32_t { kVarint = 0, kFixed64 = 1, kLengthDelimited = 2, kFixed32 = 5 };

std::string_view packed_bytes(const auto& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

}  // namespace

ProtobufWriter& ProtobufWriter::add_integer(uint32_t number, uint64_t value) {
  add_key(number, kVarint);
  add_varint(value);
  return *this;
}

ProtobufWriter& ProtobufWriter::add_double(uint32_t number, double value) {
  add_key(number, kFixed64);
  append(bytes_, value);
  return *this;
}

ProtobufWriter& ProtobufWriter::add_fixed32(uint32_t number, uint32_t value) {
  add_key(number, kFixed32);
  append(bytes_, value);
  return *this;
}

ProtobufWriter& ProtobufWriter::add_bytes(uint32_t number, std::string_view bytes) {
  add_key(number, kLengthDelimited);
  add_varint(bytes.size());
  bytes_.append(bytes);
  return *this;
}

ProtobufWriter& ProtobufWriter::add_message(uint32_t number, const ProtobufWriter& message) {
  return add_bytes(number, message.bytes());
}

ProtobufWriter& ProtobufWriter::add_doubles(uint32_t number, std::span<const double> values) {
  return add_bytes(number, packed_bytes(values));
}

ProtobufWriter& ProtobufWriter::add_fixed32s(uint32_t number, std::span<const uint32_t> values) {
  return add_bytes(number, packed_bytes(values));
}

ProtobufWriter& ProtobufWriter::add_numbers(uint32_t number, std::initializer_list<double> values) {
  constexpr size_t kBytesPerNumber = 9;  // key and value
  add_key(number, kLengthDelimited);
  add_varint(kBytesPerNumber * values.size());
  uint32_t field = 0;
  for (const double value : values) add_double(++field, value);
  return *this;
}

void ProtobufWriter::add_key(uint32_t number, uint32_t wire_type) { add_varint(uint64_t{number} << 3 | wire_type); }

void ProtobufWriter::add_varint(uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes_.push_back(static_cast<char>(value | 0x80));
  bytes_.push_back(static_cast<char>(value));
}

}  // namespace hedgehop::sim
