#include "sim/logfile/cdr_writer.h"

namespace hedgehop::sim {
namespace {

constexpr std::string_view kHead("\x00\x01\x00\x00", 4);  // plain CDR, little endian, no options

}  // namespace

void CdrWriter::clear() { bytes_.assign(kHead); }

CdrWriter& CdrWriter::put(std::string_view text) {
  put_length(text.size() + 1);
  bytes_.append(text).push_back('\0');
  return *this;
}

CdrWriter& CdrWriter::put_bytes(std::string_view bytes) {
  put_length(bytes.size());
  bytes_.append(bytes);
  return *this;
}

void CdrWriter::align(size_t bytes) {
  const size_t past = (bytes_.size() - kHead.size()) % bytes;
  if (past != 0) bytes_.append(bytes - past, '\0');
}

}  // namespace hedgehop::sim
