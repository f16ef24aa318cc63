#include "sim/batch/xml_text.h"

#include <algorithm>
#include <cstdint>

#include "sim/config/utf8.h"

namespace hedgehop::sim {
namespace {

bool is_xml(uint32_t character) {
  if (character == '\n') return true;
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  const bool control = character < 0x20 || (character >= 0x7f && character < 0xa0);
  return !control && !surrogate && character != 0xfffe && character != 0xffff;
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto [length, character] = first_character(text);
    if (length == 0) {
      out += utf8_text(text.substr(0, 1));
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
