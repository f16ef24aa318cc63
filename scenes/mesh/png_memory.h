#pragma once

#include <png.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace hedgehop::scenes::mesh {

/// A PNG in memory, open for reading. The simplified interface of libpng would convert 16-bit values, and those of
/// files with gAMA, as if they were linear light. libpng's functions throw std::invalid_argument; its
/// warnings are not printed.
struct PngInMemory {
  /// @param all  must outlive this object.
  explicit PngInMemory(std::span<const uint8_t> all) : bytes(all) {
    info = png_create_info_struct(png);
    png_set_read_fn(png, this, [](png_structp reader, png_bytep out, size_t count) {
      auto& file = *static_cast<PngInMemory*>(png_get_io_ptr(reader));
      if (count > file.bytes.size()) png_error(reader, "it is truncated");
      std::copy_n(file.bytes.begin(), count, out);
      file.bytes = file.bytes.subspan(count);
    });
  }
  ~PngInMemory() { png_destroy_read_struct(&png, &info, nullptr); }
  PngInMemory(const PngInMemory&) = delete;
  PngInMemory& operator=(const PngInMemory&) = delete;

  [[noreturn]] static void on_fault(png_structp, png_const_charp why) {
    throw std::invalid_argument(std::string("it is not a valid PNG: ") + why);
  }

  std::span<const uint8_t> bytes;  ///< the rest
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, on_fault, [](png_structp, png_const_charp) {});
  png_infop info = nullptr;
};

}  // namespace hedgehop::scenes::mesh
