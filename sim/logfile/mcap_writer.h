#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sim/config/streamed_file.h"
#include "sim/logfile/chunk_compressor.h"

namespace hedgehop::sim {

struct McapOptions {
  std::string profile;  ///< "" or "ros2"
  std::string library;  ///< name and version of the writing program
  ChunkCompression compression = ChunkCompression::zstd;
  size_t chunk_bytes = size_t{1} << 20;  ///< a chunk ends with the first message past this size
};

using McapTexts = std::map<std::string, std::string>;

/// Writes an MCAP file [MCAP2024] sec. "File Structure" record by record: messages in chunks with their indexes,
/// attachments and metadata between the chunks, the summary at the end, CRCs everywhere. It holds one chunk and 30
/// bytes per message of that chunk in memory, and for the rest of the file only the index of chunks. Functions throw
/// std::runtime_error with the file.
class McapWriter {
 public:
  McapWriter(const std::filesystem::path& file, McapOptions options);

  /// @param encoding  of `data`: "protobuf" or "ros2msg". @return the schema's number, from 1.
  uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& data);
  /// @param encoding  of the messages: "protobuf" or "cdr". @return the channel's number, from 0.
  uint16_t add_channel(const std::string& topic, uint16_t schema, const std::string& encoding,
                       const McapTexts& metadata = {});
  /// @param t_ns  both times of the message, ns.
  void write(uint16_t channel, uint64_t t_ns, std::string_view message);
  void attach(const std::string& name, const std::string& media_type, uint64_t t_ns, std::string_view data);
  void add_metadata(const std::string& name, const McapTexts& texts);
  /// Ends the file; no call may follow.
  void close();

  uint64_t message_count(uint16_t channel) const { return channels_.at(channel).messages; }

 private:
  struct IndexEntry {
    uint64_t t_ns = 0, offset = 0;  ///< in the uncompressed chunk
  };
  struct Channel {
    std::string record;
    uint16_t schema = 0;
    bool written = false;
    uint64_t messages = 0;
    std::vector<IndexEntry> index;  ///< of the open chunk
  };
  struct Schema {
    std::string record;
    bool written = false;
  };

  void put(std::string_view bytes);
  void declare(Channel& channel);
  void flush_chunk();
  void write_summary();
  std::string statistics() const;

  StreamedFile file_;
  McapOptions options_;
  ChunkCompressor compressor_;
  uint64_t position_ = 0;
  uint32_t crc_ = 0;  ///< of the file so far
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::string chunk_;
  uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0, chunk_messages_ = 0;
  uint64_t start_ns_ = 0, end_ns_ = 0, messages_ = 0;
  std::vector<std::string> chunk_indexes_, attachment_indexes_, metadata_indexes_;  ///< records of the summary
};

}  // namespace hedgehop::sim
