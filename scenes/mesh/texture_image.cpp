#include "scenes/mesh/texture_image.h"

#include <turbojpeg.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "scenes/mesh/mesh_import.h"
#include "scenes/mesh/png_memory.h"

namespace hedgehop::scenes::mesh {
namespace {

cv::Mat decode_png(std::span<const uint8_t> bytes) try {
  PngInMemory file(bytes);
  png_read_info(file.png, file.info);
  const uint32_t width = png_get_image_width(file.png, file.info), height = png_get_image_height(file.png, file.info);
  require_size(width, height);
  png_set_expand(file.png);  // palettes, values of fewer than 8 bits, a transparent color
  png_set_scale_16(file.png);
  png_set_gray_to_rgb(file.png);
  png_set_interlace_handling(file.png);
  png_read_update_info(file.png, file.info);
  const bool has_alpha = png_get_channels(file.png, file.info) == 4;
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), has_alpha ? CV_8UC4 : CV_8UC3);
  std::vector<png_bytep> rows;
  for (int row = 0; row < image.rows; ++row) rows.push_back(image.ptr(row));
  png_read_image(file.png, rows.data());
  return image;
} catch (const ImageTooLarge&) {
  throw;
} catch (const std::invalid_argument&) {
  return {};
}

cv::Mat decode_jpeg(std::span<const uint8_t> bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  const auto size = static_cast<unsigned long>(bytes.size());  // turbojpeg's type
  int width = 0, height = 0, subsampling = 0, color_space = 0;
  if (tjDecompressHeader3(decoder.get(), bytes.data(), size, &width, &height, &subsampling, &color_space) != 0)
    return {};
  require_size(width, height);
  cv::Mat rgb(height, width, CV_8UC3);
  const int fault = tjDecompress2(decoder.get(), bytes.data(), size, rgb.data, width, static_cast<int>(rgb.step),
                                  height, TJPF_RGB, TJFLAG_ACCURATEDCT);
  return fault == 0 || tjGetErrorCode(decoder.get()) == TJERR_WARNING ? rgb : cv::Mat();
}

/// Reads Netpbm's grey and color images (P2, P3, P5, P6) with one byte per value.
class NetpbmReader {
 public:
  explicit NetpbmReader(std::span<const uint8_t> bytes) : rest_(bytes.subspan(2)), kind_(bytes[1]) {}

  cv::Mat read() {
    const int64_t width = number(), height = number(), max_value = number();
    if (width <= 0 || height <= 0 || max_value <= 0 || max_value > 255) return {};
    require_size(width, height);
    const bool is_text = kind_ < '5', is_grey = kind_ == '2' || kind_ == '5';
    if (!is_text && !rest_.empty()) rest_ = rest_.subspan(1);  // the single white space before the data
    cv::Mat image(static_cast<int>(height), static_cast<int>(width), is_grey ? CV_8UC1 : CV_8UC3);
    for (uint8_t& value : std::span(image.data, image.total() * image.elemSize())) {
      const int64_t read = is_text ? number() : byte();
      if (read < 0 || read > max_value) return {};
      value = static_cast<uint8_t>(read * 255 / max_value);
    }
    cv::Mat rgb = image;
    if (is_grey) cv::cvtColor(image, rgb, cv::COLOR_GRAY2RGB);
    return rgb;
  }

 private:
  /// Returns the next byte; -1 at the end.
  int64_t byte() {
    if (rest_.empty()) return -1;
    const uint8_t first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  /// Returns the next number of the text, after white space and comments; -1 at the end or if it exceeds 9 digits.
  int64_t number() {
    while (!rest_.empty() && (std::isspace(rest_.front()) != 0 || rest_.front() == '#')) {
      const bool is_comment = rest_.front() == '#';
      const auto next = is_comment ? std::ranges::find(rest_, '\n') : rest_.begin() + 1;
      rest_ = rest_.subspan(static_cast<size_t>(next - rest_.begin()));
    }
    int64_t value = -1;
    for (int digit = 0; !rest_.empty() && std::isdigit(rest_.front()) != 0; ++digit) {
      if (digit == 9) return -1;
      value = 10 * std::max<int64_t>(value, 0) + (byte() - '0');
    }
    return value;
  }

  std::span<const uint8_t> rest_;
  uint8_t kind_;
};

}  // namespace

void require_size(int64_t width, int64_t height) {
  if (width > kMaxImageSidePx || height > kMaxImageSidePx) throw ImageTooLarge(width, height);
}

std::string image_formats() { return "PNG, JPEG, BMP, TGA, TIFF, WebP, PPM or PGM"; }

cv::Mat decode_texture(std::span<const uint8_t> bytes) {
  using namespace std::string_view_literals;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\x89PNG")) return decode_png(bytes);
  if (text.starts_with("\xff\xd8\xff")) return decode_jpeg(bytes);
  if (text.starts_with("BM")) return decode_bmp(bytes);
  if (text.starts_with("II*\0"sv) || text.starts_with("MM\0*"sv)) return decode_tiff(bytes);
  if (text.starts_with("RIFF") && text.find("WEBP") == 8) return decode_webp(bytes);
  constexpr std::string_view kNetpbm = "2356";
  if (bytes.size() > 2 && bytes[0] == 'P' && kNetpbm.find(text[1]) != std::string_view::npos) {
    return NetpbmReader(bytes).read();
  }
  return decode_tga(bytes);  // has no magic number
}

}  // namespace hedgehop::scenes::mesh
