#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

/// Texts that may hold bytes that are not UTF-8: names of files, and output of other programs. JSON, XML, tables and
/// pages are UTF-8; in them, such a byte is written \xE9, with its two hexadecimal digits.
namespace hedgehop::sim {

/// Returns the number of bytes of the first character, 1 to 4, and the character; 0 bytes if it is not UTF-8.
std::pair<size_t, uint32_t> first_character(std::string_view text);

/// Returns a text in which each byte that is not UTF-8 is written \xE9.
std::string utf8_text(std::string_view bytes);

/// Returns the name of a file as utf8_text(), and a backslash before x as \x5C, so that raw_name() returns the name.
std::string name_text(std::string_view name);
std::string raw_name(std::string_view text);

/// Returns JSON as text, with utf8_text() for strings that are not UTF-8. @param indent  as for Json::dump().
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

}  // namespace hedgehop::sim
