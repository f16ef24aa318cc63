#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sim/config/streamed_file.h"
#include "sim/logfile/little_endian.h"

namespace hedgehop::sim {

/// Levels of a logged text, as syslog's.
enum class UlogLevel : char { error = '3', warning = '4', info = '6' };

/// Writes a ULog file [ULog2024] sec. "ULog File Format". The definitions (information, topics) come first;
/// data and texts follow. Functions throw std::runtime_error with the file; a definition after data throws
/// std::logic_error.
class UlogWriter {
 public:
  /// @param start_us  time of the start, us.
  UlogWriter(const std::filesystem::path& file, uint64_t start_us);

  void add_information(const std::string& key, std::string_view text);
  /// @param fields  after the time stamp, in order: "float[3] p_m;uint8_t valid;". There is no padding.
  /// @return the topic's number.
  uint16_t add_topic(const std::string& name, const std::string& fields);
  /// Writes a message of a topic. @param fields  its bytes after the time stamp, packed.
  void write(uint16_t topic, uint64_t t_us, std::string_view fields);
  void write_text(UlogLevel level, uint64_t t_us, std::string_view text);
  void close();

 private:
  void put(char type, std::string_view content);
  void put_definition(char type, std::string_view content);
  void subscribe();

  StreamedFile file_;
  std::vector<std::string> topics_;
  bool has_data_ = false;
  std::string buffer_;
};

}  // namespace hedgehop::sim
