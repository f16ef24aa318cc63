#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <span>

namespace hedgehop::scenes::terrain {

/// Heights on a grid. Rows run from north to south, columns from west to east.
struct Heightmap {
  cv::Mat_<float> values;                         ///< NaN: no data
  bool in_meters = false;                         ///< as in a TIFF; else 0..1 from black to white, as in a PNG
  std::optional<Eigen::Vector2d> spacing_EN_m;    ///< between columns and rows, > 0
  std::optional<Eigen::Vector2d> northwest_EN_m;  ///< georeferenced position of the first sample
};

inline constexpr int kMaxHeightmapSide = 512;

/// Reads a PNG of 8 or 16 bit, or a TIFF of one band: integers, or floats of 32 or 64 bit, with the georeference of
/// [GeoTIFF11] if it has one. Feet become meters. Throws std::invalid_argument with the reason, without the file's
/// name: missing, unreadable, more than 512 x 512 samples, coordinates in degrees, another unit, a rotated grid, or a
/// pixel scale or tiepoint that is not valid.
Heightmap read_heightmap(const std::filesystem::path& file);

/// Returns the heights of a TIFF. Throws as read_heightmap() does.
Heightmap heights_of_tiff(std::span<const uint8_t> bytes);

/// Throws std::invalid_argument unless the grid has 2 x 2 to 512 x 512 samples.
void require_grid(int64_t columns, int64_t rows);

}  // namespace hedgehop::scenes::terrain
