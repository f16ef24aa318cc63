#pragma once

#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace hedgehop::sim::mavlink {

/// Returns the bytes of a text such as "fd09 00*7": pairs of hexadecimal digits, `xx*n` for n equal ones.
inline std::vector<uint8_t> bytes_of(const std::string& text) {
  std::vector<uint8_t> bytes;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t star = word.find('*');
    const std::string digits = word.substr(0, star);
    const int count = star == std::string::npos ? 1 : std::atoi(word.c_str() + star + 1);
    for (int i = 0; i < count; ++i) {
      for (size_t at = 0; at < digits.size(); at += 2) {
        bytes.push_back(static_cast<uint8_t>(std::strtoul(digits.substr(at, 2).c_str(), nullptr, 16)));
      }
    }
  }
  return bytes;
}

}  // namespace hedgehop::sim::mavlink
