#include "sim/batch/xml_text.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hedgehop::sim {
namespace {

/// Bits of the first byte, and the smallest character that needs this number of bytes.
struct Utf8Form {
  unsigned mask, lead;
  uint32_t smallest;
};
constexpr Utf8Form kForms[] = {{0x80, 0x00, 0}, {0xe0, 0xc0, 0x80}, {0xf0, 0xe0, 0x800}, {0xf8, 0xf0, 0x10000}};

bool is_xml(uint32_t character) {
  if (character == '\n') return true;
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  const bool control = character < 0x20 || (character >= 0x7f && character < 0xa0);
  return !control && !surrogate && character != 0xfffe && character != 0xffff;
}

/// Returns the number of bytes of the first character, and the character; 0 bytes if it is not UTF-8.
std::pair<size_t, uint32_t> first_character(std::string_view text) {
  if (text.empty()) return {0, 0};
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  for (size_t length = 1; length <= std::min<size_t>(4, text.size()); ++length) {
    const Utf8Form& form = kForms[length - 1];
    if ((byte(0) & form.mask) != form.lead) continue;
    uint32_t character = byte(0) & ~form.mask;
    for (size_t i = 1; i < length; ++i) {
      if ((byte(i) & 0xc0u) != 0x80u) return {0, 0};
      character = character << 6 | (byte(i) & 0x3fu);
    }
    const bool valid = character >= form.smallest && character <= 0x10ffff;
    return valid && (character < 0xd800 || character > 0xdfff) ? std::pair{length, character}
                                                               : std::pair{size_t{0}, 0u};
  }
  return {0, 0};
}

}  // namespace

size_t utf8_length(std::string_view text) { return first_character(text).first; }

std::string xml_text(std::string_view text) {
  constexpr std::string_view kUnknown = "\xef\xbf\xbd";  // U+FFFD
  std::string out;
  while (!text.empty()) {
    const auto [length, character] = first_character(text);
    if (length == 0) {
      out += kUnknown;
    } else if (is_xml(character)) {
      out += text.substr(0, length);
    } else {
      out += '?';
    }
    text.remove_prefix(std::max<size_t>(1, length));
  }
  return out;
}

}  // namespace hedgehop::sim
