#pragma once

#include <string_view>

namespace hedgehop {

/// The byte order mark with which Excel, PowerShell and others begin a text in UTF-8.
inline constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";

inline std::string_view without_utf8_mark(std::string_view text) {
  return text.starts_with(kUtf8Mark) ? text.substr(kUtf8Mark.size()) : text;
}

}  // namespace hedgehop
