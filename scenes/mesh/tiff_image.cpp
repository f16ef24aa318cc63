#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <opencv2/imgproc.hpp>

#include "scenes/mesh/texture_image.h"

namespace hedgehop::scenes::mesh {
namespace {

/// A file in memory.
struct MemoryFile {
  std::span<const uint8_t> bytes;
  size_t at = 0;

  static MemoryFile& of(thandle_t handle) { return *static_cast<MemoryFile*>(handle); }
  static tmsize_t read(thandle_t handle, void* out, tmsize_t size) {
    MemoryFile& file = of(handle);
    const size_t count = std::min(static_cast<size_t>(size), file.bytes.size() - std::min(file.at, file.bytes.size()));
    if (count > 0) std::memcpy(out, file.bytes.data() + file.at, count);
    file.at += count;
    return static_cast<tmsize_t>(count);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return 0; }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    MemoryFile& file = of(handle);
    const size_t from = whence == SEEK_CUR ? file.at : (whence == SEEK_END ? file.bytes.size() : 0);
    return file.at = from + offset;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
};

int keep_quiet(TIFF*, void*, const char*, const char*, va_list) { return 1; }

}  // namespace

cv::Mat decode_tiff(std::span<const uint8_t> bytes) {
  MemoryFile file{bytes};
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_quiet, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), keep_quiet, nullptr);
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(
      TIFFClientOpenExt("image", "rm", &file, MemoryFile::read, MemoryFile::write, MemoryFile::seek, MemoryFile::close,
                        MemoryFile::size, nullptr, nullptr, options.get()),
      [](TIFF* open) {
        if (open) TIFFClose(open);
      });
  if (!tiff) return {};
  uint32_t width = 0, height = 0;
  uint16_t samples = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &samples);
  if (width == 0 || height == 0) return {};
  require_size(width, height);
  cv::Mat rgba(static_cast<int>(height), static_cast<int>(width), CV_8UC4);
  if (TIFFReadRGBAImageOriented(tiff.get(), width, height, reinterpret_cast<uint32_t*>(rgba.data), ORIENTATION_TOPLEFT,
                                1) == 0) {
    return {};
  }
  if (samples == 2 || samples == 4) return rgba;
  cv::Mat rgb;
  cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
  return rgb;
}

}  // namespace hedgehop::scenes::mesh
