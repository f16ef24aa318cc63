#include <opencv2/imgproc.hpp>

#include "scenes/mesh/texture_image.h"
#include "scenes/mesh/tiff_memory.h"

namespace hedgehop::scenes::mesh {

cv::Mat decode_tiff(std::span<const uint8_t> bytes) {
  const TiffInMemory tiff(bytes);
  if (!tiff.get()) return {};
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
