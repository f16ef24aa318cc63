#pragma once

#include <bit>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>

namespace hedgehop::sim {

static_assert(std::endian::native == std::endian::little);

/// Appends the bytes of a number, little endian.
template <class Number>
requires std::is_arithmetic_v<Number>
void append(std::string& bytes, Number number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof(number)); }

/// Appends a text or bytes after their length.
template <std::unsigned_integral Length>
void append_with_length(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<Length>(text.size()));
  bytes.append(text);
}

}  // namespace hedgehop::sim
