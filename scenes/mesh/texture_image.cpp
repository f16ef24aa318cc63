#include "scenes/mesh/texture_image.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <opencv2/imgproc.hpp>

namespace hedgehop::scenes::mesh {
namespace {

constexpr int64_t kMostPixels = 64'000'000;

cv::Mat decode_png(std::span<const uint8_t> bytes) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed(&header, png_image_free);
  if (!png_image_begin_read_from_memory(&header, bytes.data(), bytes.size())) return {};
  if (int64_t{header.width} * header.height > kMostPixels) return {};
  header.format = PNG_FORMAT_RGBA;  // without alpha, libpng would blend it with a background
  cv::Mat rgba(static_cast<int>(header.height), static_cast<int>(header.width), CV_8UC4);
  if (!png_image_finish_read(&header, nullptr, rgba.data, static_cast<int>(rgba.step), nullptr)) return {};
  cv::Mat rgb;
  cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
  return rgb;
}

cv::Mat decode_jpeg(std::span<const uint8_t> bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  const auto size = static_cast<unsigned long>(bytes.size());  // NOLINT(google-runtime-int): turbojpeg's type
  int width = 0, height = 0, subsampling = 0, color_space = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), size, &width, &height, &subsampling, &color_space) != 0 ||
      int64_t{width} * height > kMostPixels) {
    return {};
  }
  cv::Mat rgb(height, width, CV_8UC3);
  const int fault = tjDecompress2(decoder.get(), bytes.data(), size, rgb.data, width, static_cast<int>(rgb.step),
                                  height, TJPF_RGB, TJFLAG_ACCURATEDCT);
  return fault == 0 || tjGetErrorCode(decoder.get()) == TJERR_WARNING ? rgb : cv::Mat();
}

}  // namespace

cv::Mat decode_texture(std::span<const uint8_t> bytes) {
  constexpr std::array<uint8_t, 4> kPng{0x89, 'P', 'N', 'G'};
  constexpr std::array<uint8_t, 3> kJpeg{0xff, 0xd8, 0xff};
  const auto starts = [&](const auto& magic) {
    return bytes.size() >= magic.size() && std::ranges::equal(bytes.first(magic.size()), magic);
  };
  if (starts(kPng)) return decode_png(bytes);
  if (starts(kJpeg)) return decode_jpeg(bytes);
  return {};
}

}  // namespace hedgehop::scenes::mesh
