#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// link.bin: every packet that an autopilot sent, in the order of arrival. Per packet, little endian: the physics step
/// on which it acts (u64), its length in bytes (u32; bit 31 is set for bytes of the serial line), its bytes.
namespace hedgehop::sim::link {

struct RecordedPacket {
  int64_t step = 0;
  bool is_serial = false;
  std::vector<uint8_t> bytes;
};

class RecordingWriter {
 public:
  /// Throws std::runtime_error if the file cannot be written.
  explicit RecordingWriter(const std::filesystem::path& file);
  /// Writes the packet to the disk, so that a killed program loses none. Throws std::runtime_error on a full disk.
  void add(int64_t step, bool is_serial, std::span<const uint8_t> bytes);

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

class RecordingReader {
 public:
  /// Throws InputError if the file cannot be read.
  explicit RecordingReader(const std::filesystem::path& file);
  /// Returns the next packet without taking it; null at the end. Throws InputError for a malformed file.
  const RecordedPacket* peek();
  void take() { next_.reset(); }

 private:
  std::filesystem::path file_;
  std::ifstream stream_;
  std::optional<RecordedPacket> next_;
};

}  // namespace hedgehop::sim::link
