#pragma once

#include <string>
#include <string_view>

namespace hedgehop {

/// Returns a text of at most `max_bytes` bytes for a message; a longer text ends in "...", after a whole UTF-8
/// character.
inline std::string shortened(std::string_view text, size_t max_bytes) {
  if (text.size() <= max_bytes) return std::string(text);
  size_t end = max_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;  // inside a character
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace hedgehop
