// Reads digital elevation models with GDAL. It loads more than a hundred libraries, so the code is a library of its
// own.
#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "scenes/map/elevation.h"

namespace hedgehop::scenes::map {
namespace {

/// Keeps GDAL from printing. The last message remains available.
struct QuietErrors {
  QuietErrors() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~QuietErrors() { CPLPopErrorHandler(); }
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
};

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

struct Release {
  void operator()(GDALDatasetH file) const { GDALClose(file); }
};
using File = std::unique_ptr<void, Release>;

/// Coordinates of the file's system and degrees, both with east first.
class Projection {
 public:
  explicit Projection(OGRSpatialReferenceH of_file)
      : file_(OSRClone(of_file), OSRDestroySpatialReference),
        degrees_(OSRNewSpatialReference(nullptr), OSRDestroySpatialReference) {
    OSRImportFromEPSG(degrees_.get(), 4326);
    for (const auto& system : {file_.get(), degrees_.get()})
      OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
    to_file_ = {OCTNewCoordinateTransformation(degrees_.get(), file_.get()), OCTDestroyCoordinateTransformation};
    to_degrees_ = {OCTNewCoordinateTransformation(file_.get(), degrees_.get()), OCTDestroyCoordinateTransformation};
    if (!to_file_ || !to_degrees_) refuse(std::string("its coordinate system is unknown: ") + CPLGetLastErrorMsg());
  }

  std::array<double, 2> of_file(const GeoPoint& place) const {
    return moved(to_file_.get(), {place.longitude_deg, place.latitude_deg});
  }
  GeoPoint place(const std::array<double, 2>& of_file) const {
    const auto [longitude, latitude] = moved(to_degrees_.get(), of_file);
    return {latitude, longitude};
  }

 private:
  static std::array<double, 2> moved(OGRCoordinateTransformationH map, std::array<double, 2> p) {
    if (!OCTTransform(map, 1, p.data(), p.data() + 1, nullptr)) refuse("its coordinates do not fit its system");
    return p;
  }

  std::unique_ptr<void, decltype(&OSRDestroySpatialReference)> file_, degrees_;
  std::unique_ptr<void, decltype(&OCTDestroyCoordinateTransformation)> to_file_{nullptr, nullptr},
      to_degrees_{nullptr, nullptr};
};

using GeoTransform = std::array<double, 6>;

std::array<double, 2> applied(const GeoTransform& g, double x, double y) {
  return {g[0] + x * g[1] + y * g[2], g[3] + x * g[4] + y * g[5]};
}

/// Samples [first, end) along each axis.
struct Window {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Returns the samples around the bounds.
Window window(const GeoBounds& bounds, const Projection& projection, const GeoTransform& to_pixel, int columns,
              int rows) {
  constexpr int kSteps = 8;  // the sides of the bounds are curves in the file's system
  std::array<double, 2> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (int i = 0; i <= kSteps; ++i) {
    for (int k = 0; k <= kSteps; ++k) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(k) / kSteps;
      const auto [x, y] =
          projection.of_file({std::lerp(bounds.southwest.latitude_deg, bounds.northeast.latitude_deg, a),
                              std::lerp(bounds.southwest.longitude_deg, bounds.northeast.longitude_deg, b)});
      const std::array<double, 2> pixel = applied(to_pixel, x, y);
      for (size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], pixel[axis]);
        high[axis] = std::max(high[axis], pixel[axis]);
      }
    }
  }
  const auto clipped = [](double x, int count) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(count)));
  };
  return {clipped(std::floor(low[0]) - 1.0, columns), clipped(std::floor(low[1]) - 1.0, rows),
          clipped(std::ceil(high[0]) + 1.0, columns), clipped(std::ceil(high[1]) + 1.0, rows)};
}

/// Returns meters per unit of the band's heights.
double meters_per_unit(GDALRasterBandH band) {
  const std::string unit = GDALGetRasterUnitType(band);
  if (unit.empty() || unit == "m" || unit == "metre" || unit == "meter") return 1.0;
  if (unit == "ft" || unit == "foot" || unit == "feet") return 0.3048;
  if (unit == "US survey foot") return 1200.0 / 3937.0;
  refuse("its heights have the unit '" + unit + "'; valid: m, ft, US survey foot");
}

/// Reads a row of a band from `left` on.
template <class T>
void read_row(GDALRasterBandH band, int left, int row, GDALDataType type, std::vector<T>& values) {
  const int count = static_cast<int>(values.size());
  if (GDALRasterIO(band, GF_Read, left, row, count, 1, values.data(), count, 1, type, 0, 0) != CE_None)
    refuse(CPLGetLastErrorMsg());
}

}  // namespace
}  // namespace hedgehop::scenes::map

/// @see hedgehop::scenes::map::ReadElevations
extern "C" void hedgehop_read_elevations(const std::filesystem::path& path,
                                         const hedgehop::scenes::map::GeoBounds& bounds, int max_side,
                                         hedgehop::scenes::map::HeightSamples& read) {
  using namespace hedgehop::scenes::map;
  GDALAllRegister();
  const QuietErrors quiet;
  const File file(GDALOpenEx(path.c_str(), GDAL_OF_RASTER, nullptr, nullptr, nullptr));
  if (!file) refuse(CPLGetLastErrorMsg());
  GeoTransform to_file, to_pixel;
  if (GDALGetGeoTransform(file.get(), to_file.data()) != CE_None ||
      !GDALInvGeoTransform(to_file.data(), to_pixel.data()))
    refuse("it has no georeference");
  const OGRSpatialReferenceH system = GDALGetSpatialRef(file.get());
  if (system == nullptr) refuse("it names no coordinate system");
  const Projection projection(system);
  const Window all =
      window(bounds, projection, to_pixel, GDALGetRasterXSize(file.get()), GDALGetRasterYSize(file.get()));
  const int width = all.right - all.left, height = all.bottom - all.top;
  if (width < 2 || height < 2) refuse("it does not cover the map");

  const GDALRasterBandH band = GDALGetRasterBand(file.get(), 1), mask = GDALGetMaskBand(band);
  const double unit_m = meters_per_unit(band), scale = GDALGetRasterScale(band, nullptr),
               offset = GDALGetRasterOffset(band, nullptr);
  read.stride = (std::max(width, height) + max_side - 1) / max_side;
  read.rows = (height - 1) / read.stride + 1;
  read.columns = (width - 1) / read.stride + 1;
  std::vector<double> values(static_cast<size_t>(width));
  std::vector<uint8_t> known(static_cast<size_t>(width));
  for (int row = 0; row < read.rows; ++row) {
    const int y = all.top + row * read.stride;
    read_row(band, all.left, y, GDT_Float64, values);
    read_row(mask, all.left, y, GDT_Byte, known);
    for (int column = 0; column < read.columns; ++column) {
      const int x = column * read.stride;
      const auto at = static_cast<size_t>(x);
      const double height_m =
          known[at] != 0 ? unit_m * (offset + scale * values[at]) : std::numeric_limits<double>::quiet_NaN();
      read.samples.push_back({projection.place(applied(to_file, all.left + x + 0.5, y + 0.5)), height_m});
    }
  }
}
