#include "sim/logfile/ulog_writer.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace hedgehop::sim {
namespace {

constexpr std::string_view kUlogMagic("ULog\x01\x12\x35\x01", 8);
constexpr size_t kFlagBytes = 40;                 // no flags, no appended data
constexpr size_t kBufferBytes = size_t{1} << 16;  // written at a time

}  // namespace

UlogWriter::UlogWriter(const std::filesystem::path& file, uint64_t start_us) : file_(file) {
  buffer_.append(kUlogMagic);
  append(buffer_, start_us);
  put('B', std::string(kFlagBytes, '\0'));
}

void UlogWriter::add_information(const std::string& key, std::string_view text) {
  std::string content;
  append_with_length<uint8_t>(content, fmt::format("char[{}] {}", text.size(), key));
  put_definition('I', content.append(text));
}

uint16_t UlogWriter::add_topic(const std::string& name, const std::string& fields) {
  put_definition('F', fmt::format("{}:uint64_t timestamp;{}", name, fields));
  topics_.push_back(name);
  return static_cast<uint16_t>(topics_.size() - 1);
}

/// Ends the definitions.
void UlogWriter::subscribe() {
  if (has_data_) return;
  has_data_ = true;
  for (size_t i = 0; i < topics_.size(); ++i) {
    std::string content;
    append(content, uint8_t{0});  // the only instance of its topic
    append(content, static_cast<uint16_t>(i));
    put('A', content.append(topics_[i]));
  }
}

void UlogWriter::write(uint16_t topic, uint64_t t_us, std::string_view fields) {
  subscribe();
  std::string content;
  append(content, topic);
  append(content, t_us);
  put('D', content.append(fields));
}

void UlogWriter::write_text(UlogLevel level, uint64_t t_us, std::string_view text) {
  subscribe();
  std::string content(1, static_cast<char>(level));
  append(content, t_us);
  put('L', content.append(text));
}

void UlogWriter::close() {
  subscribe();
  file_.write(buffer_);
  file_.close();
}

void UlogWriter::put_definition(char type, std::string_view content) {
  if (has_data_) throw std::logic_error("a ULog file has its definitions before its data");
  put(type, content);
}

void UlogWriter::put(char type, std::string_view content) {
  if (content.size() > std::numeric_limits<uint16_t>::max()) throw std::logic_error("too long for a ULog message");
  append(buffer_, static_cast<uint16_t>(content.size()));
  buffer_.push_back(type);
  buffer_.append(content);
  if (buffer_.size() < kBufferBytes) return;
  file_.write(buffer_);
  buffer_.clear();
}

}  // namespace hedgehop::sim
