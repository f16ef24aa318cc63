#include "sim/link/recording.h"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "sim/config/input_error.h"

namespace hedgehop::sim::link {
namespace {

constexpr size_t kRecordHeaderBytes = 12;
constexpr uint32_t kSerialBit = 1u << 31;
constexpr uint32_t kMaxPacketBytes = 1 << 24;  // far above any packet: a greater length is a malformed file

template <class Number>
void put(std::array<uint8_t, kRecordHeaderBytes>& bytes, size_t at, Number value) {
  for (size_t i = 0; i < sizeof value; ++i) bytes[at + i] = static_cast<uint8_t>(value >> (8 * i));
}

template <class Number>
Number get(const std::array<uint8_t, kRecordHeaderBytes>& bytes, size_t at) {
  Number value = 0;
  for (size_t i = 0; i < sizeof value; ++i) value |= static_cast<Number>(bytes[at + i]) << (8 * i);
  return value;
}

}  // namespace

RecordingWriter::RecordingWriter(const std::filesystem::path& file)
    : file_(file), stream_(file, std::ios::binary | std::ios::trunc) {
  if (!stream_) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

void RecordingWriter::add(int64_t step, bool is_serial, std::span<const uint8_t> bytes) {
  std::array<uint8_t, kRecordHeaderBytes> header{};
  put(header, 0, static_cast<uint64_t>(step));
  put(header, 8, static_cast<uint32_t>(bytes.size()) | (is_serial ? kSerialBit : 0u));
  stream_.write(reinterpret_cast<const char*>(header.data()), header.size());
  stream_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  stream_.flush();
  if (!stream_) throw std::runtime_error(fmt::format("cannot write {}", file_.string()));
}

RecordingReader::RecordingReader(const std::filesystem::path& file) : file_(file), stream_(file, std::ios::binary) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored) || !stream_) {
    throw InputError(fmt::format("{}: cannot be read; expected the link.bin of a linked flight", file.string()));
  }
}

const RecordedPacket* RecordingReader::peek() {
  if (next_) return &*next_;
  std::array<uint8_t, kRecordHeaderBytes> header{};
  const auto offset = static_cast<int64_t>(stream_.tellg());
  stream_.read(reinterpret_cast<char*>(header.data()), header.size());
  if (stream_.gcount() == 0) return nullptr;
  const auto step = get<uint64_t>(header, 0);
  const auto length = get<uint32_t>(header, 8);
  const uint32_t size = length & ~kSerialBit;
  const bool has_header = stream_.gcount() == kRecordHeaderBytes && step < (1ull << 62) && size <= kMaxPacketBytes;
  if (has_header) {
    next_.emplace(RecordedPacket{static_cast<int64_t>(step), (length & kSerialBit) != 0, std::vector<uint8_t>(size)});
    stream_.read(reinterpret_cast<char*>(next_->bytes.data()), size);
  }
  if (!has_header || stream_.gcount() != static_cast<std::streamsize>(size)) {
    throw InputError(fmt::format("{}: byte {}: no packet of a linked flight", file_.string(), offset));
  }
  return &*next_;
}

}  // namespace hedgehop::sim::link
