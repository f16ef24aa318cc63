#pragma once

#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Returns text that every XML 1.0 parser accepts: UTF-8 and line breaks stay, control characters become "?", and each
/// byte that is not UTF-8 becomes \xE9, as in utf8_text(). A worker's last line may hold any bytes.
std::string xml_text(std::string_view text);

}  // namespace hedgehop::sim
