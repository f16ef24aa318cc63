#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "scenes/map/osm_objects.h"

namespace hedgehop::scenes::map {

/// A rectangle of the ellipsoid, degrees.
struct GeoBounds {
  GeoPoint southwest, northeast;
};

/// A height of the ground. NaN if the file has no data there.
struct HeightSample {
  GeoPoint place;
  double height_m = 0.0;
};

/// The samples of a digital elevation model, row by row.
struct HeightSamples {
  int rows = 0, columns = 0;
  std::vector<HeightSample> samples;
  int stride = 1;                ///< in samples of the file, if it has more than the maximum
  double skipped_error_m = 0.0;  ///< maximum distance of a skipped sample from the triangles between the others
  int64_t absurd_count = 0;      ///< samples, also skipped ones, with heights that do not exist on Earth, thus unknown
};

/// The function of libhedgehop_elevation.so, which is loaded for the first map with terrain.
/// @param bounds  of the wanted samples. @param max_side  maximum number of rows and of columns.
/// @param[out] read  the samples within the bounds, and one around them.
/// Throws std::runtime_error with the reason if the file cannot be read or does not overlap the bounds.
using ReadElevations = void(const std::filesystem::path& file, const GeoBounds& bounds, int max_side,
                            HeightSamples& read);
constexpr const char* kElevationLibrary = "libhedgehop_elevation.so";
constexpr const char* kReadElevations = "hedgehop_read_elevations";

}  // namespace hedgehop::scenes::map
