#include "scenes/terrain/heightmap.h"

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "scenes/mesh/png_memory.h"
#include "sim/fields/file_fault.h"

namespace hedgehop::scenes::terrain {

namespace {

constexpr std::uintmax_t kMaxHeightmapBytes = 64'000'000;

std::vector<uint8_t> bytes_of_file(const std::filesystem::path& file) {
  std::error_code error;
  if (const std::string fault = file_fault(file); !fault.empty()) throw std::invalid_argument(fault);
  if (std::filesystem::file_size(file, error) > kMaxHeightmapBytes) {
    throw std::invalid_argument("it is larger than 64 MB");
  }
  std::ifstream stream(file, std::ios::binary);
  std::vector<uint8_t> bytes(std::filesystem::file_size(file, error));
  stream.read(reinterpret_cast<char*>(bytes.data()), std::ssize(bytes));
  if (!stream) throw std::invalid_argument("it cannot be read");
  return bytes;
}

Heightmap heights_of_png(std::span<const uint8_t> bytes) {
  mesh::PngInMemory file(bytes);
  png_read_info(file.png, file.info);
  const int color = png_get_color_type(file.png, file.info), depth = png_get_bit_depth(file.png, file.info);
  if (color != PNG_COLOR_TYPE_GRAY || depth < 8) {
    throw std::invalid_argument("a heightmap is a grey PNG of 8 or 16 bit without alpha");
  }
  const auto columns = png_get_image_width(file.png, file.info), rows = png_get_image_height(file.png, file.info);
  require_grid(columns, rows);
  if (png_set_interlace_handling(file.png) != 1) throw std::invalid_argument("an interlaced PNG is no heightmap");
  if (depth == 16) png_set_swap(file.png);  // a PNG is big endian
  Heightmap map;
  map.values.create(static_cast<int>(rows), static_cast<int>(columns));
  cv::Mat row(1, map.values.cols, depth == 16 ? CV_16UC1 : CV_8UC1);
  for (int r = 0; r < map.values.rows; ++r) {
    png_read_row(file.png, row.data, nullptr);
    row.convertTo(map.values.row(r), CV_32F, depth == 16 ? 1.0 / 65535.0 : 1.0 / 255.0);
  }
  return map;
}

}  // namespace

void require_grid(int64_t columns, int64_t rows) {
  if (columns >= 2 && rows >= 2 && columns <= kMaxHeightmapSide && rows <= kMaxHeightmapSide) return;
  throw std::invalid_argument("it has " + std::to_string(columns) + " x " + std::to_string(rows) +
                              " samples; valid: 2 x 2 to 512 x 512");
}

Heightmap read_heightmap(const std::filesystem::path& file) {
  const std::vector<uint8_t> bytes = bytes_of_file(file);
  if (bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0) return heights_of_png(bytes);
  return heights_of_tiff(bytes);
}

}  // namespace hedgehop::scenes::terrain
