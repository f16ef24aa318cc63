#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "sim/logfile/little_endian.h"

namespace hedgehop::sim {

/// Writes one message in the Common Data Representation of ROS 2, little endian [DdsXtypes2020] sec. 7.4.1: a number of
/// n bytes starts at a multiple of n bytes from the end of the header.
class CdrWriter {
 public:
  CdrWriter() { clear(); }
  /// Starts a new message.
  void clear();
  const std::string& bytes() const { return bytes_; }

  template <class Number>
  requires std::is_arithmetic_v<Number> CdrWriter& put(Number number) {
    align(sizeof(Number));
    append(bytes_, number);
    return *this;
  }
  /// Adds a text as a string: its length with the final zero, the text, a zero.
  CdrWriter& put(std::string_view text);
  CdrWriter& put(const std::string& text) { return put(std::string_view(text)); }
  CdrWriter& put(const char* text) { return put(std::string_view(text)); }
  /// Adds the length of a sequence, whose elements follow.
  CdrWriter& put_length(size_t elements) { return put(static_cast<uint32_t>(elements)); }
  /// Adds a sequence of bytes with its length.
  CdrWriter& put_bytes(std::string_view bytes);
  /// Adds numbers without a length: an array of fixed length, or the elements after put_length().
  template <class Number>
  CdrWriter& put_array(std::span<const Number> numbers) {
    if (numbers.empty()) return *this;
    align(sizeof(Number));
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    return *this;
  }

 private:
  void align(size_t bytes);

  std::string bytes_;
};

}  // namespace hedgehop::sim
