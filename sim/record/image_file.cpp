#include "sim/record/image_file.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>

#include "sim/config/whole_file.h"

namespace hedgehop::sim {
namespace {

[[noreturn]] void on_fault(png_structp, png_const_charp why) { throw std::runtime_error(why); }

void append(png_structp png, png_bytep bytes, size_t count) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

struct PngWriter {
  PngWriter() { info = png_create_info_struct(png); }
  PngWriter(const PngWriter&) = delete;
  PngWriter& operator=(const PngWriter&) = delete;
  ~PngWriter() { png_destroy_write_struct(&png, &info); }

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_fault, nullptr);
  png_infop info = nullptr;
};

/// Returns a TIFF with one directory of fields and all rows in one strip.
std::string tiff_of(const cv::Mat& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes = "II";
  const auto put = [&bytes](auto number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof(number)); };
  enum Type : uint16_t { kShort = 3, kLong = 4 };
  struct TiffField {
    uint16_t tag;
    Type type;
    uint32_t value;
  };
  constexpr uint32_t kDirectoryAt = 8, kRowsAt = 136;
  const auto rows = static_cast<uint32_t>(image.rows), cols = static_cast<uint32_t>(image.cols);
  const TiffField fields[] = {
      {256, kLong, cols},             // width
      {257, kLong, rows},             // height
      {258, kShort, 32},              // bits per sample
      {259, kShort, 1},               // no compression
      {262, kShort, 1},               // grey, 0 is black
      {273, kLong, kRowsAt},          // offset of the strip
      {277, kShort, 1},               // samples per pixel
      {278, kLong, rows},             // rows per strip
      {279, kLong, 4 * rows * cols},  // bytes of the strip
      {339, kShort, 3},               // samples are floats
  };
  put(uint16_t{42});
  put(kDirectoryAt);
  put(static_cast<uint16_t>(std::size(fields)));
  for (const TiffField& field : fields) {
    put(field.tag);
    put(static_cast<uint16_t>(field.type));
    put(uint32_t{1});
    put(field.value);
  }
  put(uint32_t{0});  // no further directory
  bytes.resize(kRowsAt);
  for (int row = 0; row < image.rows; ++row) bytes.append(image.ptr<char>(row), 4 * cols);
  return bytes;
}

}  // namespace

void write_tiff(const std::filesystem::path& file, const cv::Mat& image) {
  if (image.type() != CV_32FC1) throw std::invalid_argument(file.string() + ": a TIFF must have one channel of floats");
  write_file_whole(file, tiff_of(image));
}

cv::Mat labels_16bit(const cv::Mat& labels) {
  double max_label = 0.0;
  cv::minMaxLoc(labels, nullptr, &max_label);
  constexpr double kMaxLabel = std::numeric_limits<uint16_t>::max();
  if (max_label > kMaxLabel) {
    throw std::runtime_error(
        fmt::format("the image shows label {:.0f}; maximum of 16 bit: {:.0f}", max_label, kMaxLabel));
  }
  cv::Mat small;
  labels.convertTo(small, CV_16UC1);
  return small;
}

std::string png_of(const cv::Mat& image) {
  if (image.type() != CV_8UC1 && image.type() != CV_16UC1 && image.type() != CV_8UC3 && image.type() != CV_16UC3) {
    throw std::invalid_argument("a PNG must be grey or RGB with 8 or 16 bit");
  }
  std::string bytes;
  const PngWriter writer;
  png_structp png = writer.png;
  png_set_write_fn(png, &bytes, append, nullptr);
  png_set_IHDR(png, writer.info, static_cast<png_uint_32>(image.cols), static_cast<png_uint_32>(image.rows),
               image.depth() == CV_16U ? 16 : 8, image.channels() == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  // Exports write thousands of images. Level 6 takes four times as long; a search for matches other than runs takes
  // twice as long and finds none in the noise of a camera.
  constexpr int kRunLengths = 3;  // Z_RLE of zlib
  png_set_compression_level(png, 1);
  png_set_compression_strategy(png, kRunLengths);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(png, writer.info);
  if (image.depth() == CV_16U) png_set_swap(png);  // a PNG is big endian
  for (int row = 0; row < image.rows; ++row) png_write_row(png, image.ptr(row));
  png_write_end(png, nullptr);
  return bytes;
}

void write_png(const std::filesystem::path& file, const cv::Mat& image) {
  try {
    write_file_whole(file, png_of(image));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(file.string() + ": " + error.what());
  }
}

cv::Mat depth_mm(const cv::Mat& depth_m) {
  cv::Mat depth(depth_m.size(), CV_16UC1, cv::Scalar(0));
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const float mm = 1000.0f * depth_m.at<float>(v, u);
      if (mm < 65535.0f) depth.at<uint16_t>(v, u) = static_cast<uint16_t>(std::lround(mm));
    }
  }
  return depth;
}

std::string jpeg_of(const cv::Mat& rgb, int quality) {
  CV_Assert(rgb.type() == CV_8UC3);
  const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;  // turbojpeg's type
  const int fault = tjCompress2(encoder.get(), rgb.data, rgb.cols, static_cast<int>(rgb.step), rgb.rows, TJPF_RGB,
                                &bytes, &size, TJSAMP_420, quality, 0);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> freed(bytes, tjFree);
  if (fault != 0) throw std::runtime_error(tjGetErrorStr2(encoder.get()));
  return {bytes, bytes + size};
}

}  // namespace hedgehop::sim
