#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Returns text that every XML 1.0 parser accepts: UTF-8 and line breaks stay, control characters become "?", and each
/// byte that is not UTF-8 becomes U+FFFD. A worker's last line may hold any bytes.
std::string xml_text(std::string_view text);

/// Returns the number of bytes, 1 to 4, of the UTF-8 character at the start of a text; 0 if there is none.
size_t utf8_length(std::string_view text);

}  // namespace hedgehop::sim
