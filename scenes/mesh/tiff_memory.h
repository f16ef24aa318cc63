#pragma once

#include <tiffio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

namespace hedgehop::scenes::mesh {

/// A TIFF in memory, open for reading. libtiff's messages are not printed.
class TiffInMemory {
 public:
  /// @param bytes  must outlive this object.
  explicit TiffInMemory(std::span<const uint8_t> bytes) : bytes_(bytes) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                               TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_quiet, nullptr);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
    tiff_ = TIFFClientOpenExt("image", "rm", this, read, write, seek, close, size, nullptr, nullptr, options.get());
  }
  ~TiffInMemory() {
    if (tiff_) TIFFClose(tiff_);
  }
  TiffInMemory(const TiffInMemory&) = delete;
  TiffInMemory& operator=(const TiffInMemory&) = delete;

  /// Null if the bytes are no TIFF.
  TIFF* get() const { return tiff_; }

 private:
  static TiffInMemory& of(thandle_t handle) { return *static_cast<TiffInMemory*>(handle); }
  static tmsize_t read(thandle_t handle, void* out, tmsize_t size) {
    TiffInMemory& file = of(handle);
    const size_t left = file.bytes_.size() - std::min(file.at_, file.bytes_.size());
    const size_t count = std::min(static_cast<size_t>(size), left);
    if (count > 0) std::memcpy(out, file.bytes_.data() + file.at_, count);
    file.at_ += count;
    return static_cast<tmsize_t>(count);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return 0; }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    TiffInMemory& file = of(handle);
    const size_t from = whence == SEEK_CUR ? file.at_ : (whence == SEEK_END ? file.bytes_.size() : 0);
    return file.at_ = from + offset;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes_.size(); }
  static int keep_quiet(TIFF*, void*, const char*, const char*, va_list) { return 1; }

  std::span<const uint8_t> bytes_;
  size_t at_ = 0;
  TIFF* tiff_ = nullptr;
};

}  // namespace hedgehop::scenes::mesh
