#include "sim/logfile/mcap_writer.h"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "sim/logfile/little_endian.h"

namespace hedgehop::sim {
namespace {

enum class Opcode : uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

uint32_t crc32_of(uint32_t start, std::string_view bytes) {
  return static_cast<uint32_t>(crc32_z(start, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append_head(std::string& bytes, Opcode opcode, uint64_t length) {
  append(bytes, static_cast<uint8_t>(opcode));
  append(bytes, length);
}

std::string record_of(Opcode opcode, std::string_view content) {
  std::string bytes;
  append_head(bytes, opcode, content.size());
  bytes.append(content);
  return bytes;
}

void append_text(std::string& bytes, std::string_view text) { append_with_length<uint32_t>(bytes, text); }

void append_texts(std::string& bytes, const McapTexts& texts) {
  std::string content;
  for (const auto& [key, value] : texts) {
    append_text(content, key);
    append_text(content, value);
  }
  append_text(bytes, content);
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& file, McapOptions options)
    : file_(file), options_(std::move(options)), compressor_(options_.compression) {
  put(kMagic);
  std::string header;
  append_text(header, options_.profile);
  append_text(header, options_.library);
  put(record_of(Opcode::header, header));
}

uint16_t McapWriter::add_schema(const std::string& name, const std::string& encoding, const std::string& data) {
  const auto number = static_cast<uint16_t>(schemas_.size() + 1);
  std::string content;
  append(content, number);
  append_text(content, name);
  append_text(content, encoding);
  append_text(content, data);
  schemas_.push_back({record_of(Opcode::schema, content)});
  return number;
}

uint16_t McapWriter::add_channel(const std::string& topic, uint16_t schema, const std::string& encoding,
                                 const McapTexts& metadata) {
  if (schema < 1 || schema > schemas_.size()) throw std::invalid_argument(topic + ": its schema was not added");
  const auto number = static_cast<uint16_t>(channels_.size());
  std::string content;
  append(content, number);
  append(content, schema);
  append_text(content, topic);
  append_text(content, encoding);
  append_texts(content, metadata);
  channels_.push_back({record_of(Opcode::channel, content), schema});
  return number;
}

/// Adds the channel and its schema to the chunk before the channel's first message.
void McapWriter::declare(Channel& channel) {
  if (channel.written) return;
  Schema& schema = schemas_[channel.schema - size_t{1}];
  if (!std::exchange(schema.written, true)) chunk_ += schema.record;
  chunk_ += channel.record;
  channel.written = true;
}

void McapWriter::write(uint16_t channel_number, uint64_t t_ns, std::string_view message) {
  Channel& channel = channels_.at(channel_number);
  declare(channel);
  channel.index.push_back({t_ns, chunk_.size()});
  append_head(chunk_, Opcode::message, 22 + message.size());
  append(chunk_, channel_number);
  append(chunk_, static_cast<uint32_t>(channel.messages));
  append(chunk_, t_ns);
  append(chunk_, t_ns);
  chunk_.append(message);
  chunk_start_ns_ = chunk_messages_ == 0 ? t_ns : std::min(chunk_start_ns_, t_ns);
  chunk_end_ns_ = chunk_messages_ == 0 ? t_ns : std::max(chunk_end_ns_, t_ns);
  start_ns_ = messages_ == 0 ? t_ns : std::min(start_ns_, t_ns);
  end_ns_ = messages_ == 0 ? t_ns : std::max(end_ns_, t_ns);
  ++channel.messages;
  ++chunk_messages_;
  ++messages_;
  if (chunk_.size() >= options_.chunk_bytes) flush_chunk();
}

void McapWriter::flush_chunk() {
  if (chunk_messages_ == 0) return;
  const std::string_view records = compressor_.compress(chunk_);
  std::string head;
  append(head, chunk_start_ns_);
  append(head, chunk_end_ns_);
  append(head, uint64_t{chunk_.size()});
  append(head, crc32_of(0, chunk_));
  append_text(head, to_string(compressor_.kind()));
  append(head, uint64_t{records.size()});
  const uint64_t chunk_at = position_;
  std::string frame;
  append_head(frame, Opcode::chunk, head.size() + records.size());
  put(frame + head);
  put(records);
  const uint64_t chunk_length = position_ - chunk_at, indexes_at = position_;

  std::string offsets;
  for (size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].index.empty()) continue;
    append(offsets, static_cast<uint16_t>(i));
    append(offsets, position_);
    std::string content, entries;
    append(content, static_cast<uint16_t>(i));
    for (const IndexEntry& entry : channels_[i].index) {
      append(entries, entry.t_ns);
      append(entries, entry.offset);
    }
    append_text(content, entries);
    put(record_of(Opcode::message_index, content));
    channels_[i].index.clear();
  }

  std::string index;
  append(index, chunk_start_ns_);
  append(index, chunk_end_ns_);
  append(index, chunk_at);
  append(index, chunk_length);
  append_text(index, offsets);
  append(index, position_ - indexes_at);
  append_text(index, to_string(compressor_.kind()));
  append(index, uint64_t{records.size()});
  append(index, uint64_t{chunk_.size()});
  chunk_indexes_.push_back(record_of(Opcode::chunk_index, index));
  chunk_.clear();
  chunk_messages_ = 0;
}

void McapWriter::attach(const std::string& name, const std::string& media_type, uint64_t t_ns, std::string_view data) {
  flush_chunk();
  std::string content;
  append(content, t_ns);
  append(content, t_ns);
  append_text(content, name);
  append_text(content, media_type);
  append_with_length<uint64_t>(content, data);
  append(content, crc32_of(0, content));
  const uint64_t at = position_;
  put(record_of(Opcode::attachment, content));
  std::string index;
  append(index, at);
  append(index, position_ - at);
  append(index, t_ns);
  append(index, t_ns);
  append(index, uint64_t{data.size()});
  append_text(index, name);
  append_text(index, media_type);
  attachment_indexes_.push_back(record_of(Opcode::attachment_index, index));
}

void McapWriter::add_metadata(const std::string& name, const McapTexts& texts) {
  flush_chunk();
  std::string content;
  append_text(content, name);
  append_texts(content, texts);
  const uint64_t at = position_;
  put(record_of(Opcode::metadata, content));
  std::string index;
  append(index, at);
  append(index, position_ - at);
  append_text(index, name);
  metadata_indexes_.push_back(record_of(Opcode::metadata_index, index));
}

void McapWriter::close() {
  flush_chunk();
  std::string end;
  append(end, crc_);
  put(record_of(Opcode::data_end, end));
  write_summary();
  file_.close();
}

std::string McapWriter::statistics() const {
  std::string content, counts;
  append(content, messages_);
  append(content, static_cast<uint16_t>(std::ranges::count(schemas_, true, &Schema::written)));
  append(content, static_cast<uint32_t>(std::ranges::count(channels_, true, &Channel::written)));
  append(content, static_cast<uint32_t>(attachment_indexes_.size()));
  append(content, static_cast<uint32_t>(metadata_indexes_.size()));
  append(content, static_cast<uint32_t>(chunk_indexes_.size()));
  append(content, start_ns_);
  append(content, end_ns_);
  for (size_t i = 0; i < channels_.size(); ++i) {
    if (!channels_[i].written) continue;
    append(counts, static_cast<uint16_t>(i));
    append(counts, channels_[i].messages);
  }
  append_text(content, counts);
  return record_of(Opcode::statistics, content);
}

/// Writes the summary, grouped by kind of record, its offsets and the footer. Channels without messages are left out; a
/// file without content has no summary.
void McapWriter::write_summary() {
  const uint64_t summary_at = position_;
  crc_ = 0;  // from here on, of the summary
  std::string offsets;
  const auto put_group = [&](Opcode opcode, const std::vector<std::string>& records) {
    if (records.empty()) return;
    const uint64_t at = position_;
    for (const std::string& record : records) put(record);
    std::string offset;
    append(offset, static_cast<uint8_t>(opcode));
    append(offset, at);
    append(offset, position_ - at);
    offsets += record_of(Opcode::summary_offset, offset);
  };
  std::vector<std::string> schemas, channels;
  for (const Schema& schema : schemas_) {
    if (schema.written) schemas.push_back(schema.record);
  }
  for (const Channel& channel : channels_) {
    if (channel.written) channels.push_back(channel.record);
  }
  const bool empty = channels.empty() && attachment_indexes_.empty() && metadata_indexes_.empty();
  put_group(Opcode::schema, schemas);
  put_group(Opcode::channel, channels);
  if (!empty) put_group(Opcode::statistics, {statistics()});
  put_group(Opcode::chunk_index, chunk_indexes_);
  put_group(Opcode::attachment_index, attachment_indexes_);
  put_group(Opcode::metadata_index, metadata_indexes_);
  const uint64_t offsets_at = position_;
  put(offsets);
  std::string footer;
  append_head(footer, Opcode::footer, 20);
  append(footer, empty ? uint64_t{0} : summary_at);
  append(footer, empty ? uint64_t{0} : offsets_at);
  put(footer);
  std::string end;
  append(end, crc_);
  put(end.append(kMagic));
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes);
  crc_ = crc32_of(crc_, bytes);
  position_ += bytes.size();
}

}  // namespace hedgehop::sim
