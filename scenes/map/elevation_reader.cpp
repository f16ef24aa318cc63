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

[[noreturn]] void refuse_by_gdal() {
  const std::string why = CPLGetLastErrorMsg();
  refuse(why.empty() ? "GDAL does not know its format" : why);
}

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
    refuse_by_gdal();
}

/// Reads rows of heights, m; NaN for samples without data.
class HeightRows {
 public:
  HeightRows(GDALRasterBandH band, const Window& window)
      : band_(band),
        mask_(GDALGetMaskBand(band)),
        unit_m_(meters_per_unit(band)),
        scale_(GDALGetRasterScale(band, nullptr)),
        offset_(GDALGetRasterOffset(band, nullptr)),
        window_(window),
        known_(static_cast<size_t>(window.right - window.left)) {}

  /// @param y  from the top of the window. @param[out] absurd_count  increased by the heights that do not exist.
  std::vector<double> read(int y, int64_t& absurd_count) {
    constexpr double kLowestM = -12e3, kHighestM = 10e3;  // of the sea floor and of mountains
    std::vector<double> heights_m(known_.size());
    read_row(band_, window_.left, window_.top + y, GDT_Float64, heights_m);
    read_row(mask_, window_.left, window_.top + y, GDT_Byte, known_);
    for (size_t x = 0; x < heights_m.size(); ++x) {
      double& height_m = heights_m[x];
      height_m = unit_m_ * (offset_ + scale_ * height_m);
      if (known_[x] != 0 && height_m >= kLowestM && height_m <= kHighestM) continue;
      absurd_count += known_[x] != 0 && !std::isnan(height_m) ? 1 : 0;
      height_m = std::numeric_limits<double>::quiet_NaN();
    }
    return heights_m;
  }

 private:
  GDALRasterBandH band_, mask_;
  double unit_m_, scale_, offset_;
  Window window_;
  std::vector<uint8_t> known_;
};

/// Returns the maximum distance of the samples between two kept rows from the triangles between kept samples.
/// @param rows  stride + 1 rows, the first and the last one kept.
double skipped_error_m(const std::vector<std::vector<double>>& rows, int stride) {
  double error_m = 0.0;
  const auto step = static_cast<size_t>(stride);
  for (size_t left = 0; left + step < rows.front().size(); left += step) {
    const double northwest = rows[0][left], northeast = rows[0][left + step], southwest = rows[step][left],
                 southeast = rows[step][left + step];
    for (size_t i = 0; i <= step; ++i) {
      for (size_t k = 0; k <= step; ++k) {
        const double south = static_cast<double>(i) / stride, east = static_cast<double>(k) / stride;
        const double on_surface =
            south + east <= 1.0
                ? northwest + south * (southwest - northwest) + east * (northeast - northwest)
                : southeast + (1.0 - south) * (northeast - southeast) + (1.0 - east) * (southwest - southeast);
        const double off_m = std::abs(rows[i][left + k] - on_surface);
        if (off_m > error_m) error_m = off_m;  // false for unknown heights
      }
    }
  }
  return error_m;
}

/// Refuses files that are no elevation models of the size that a map can have.
void require_elevations(GDALDatasetH file) {
  if (GDALGetRasterCount(file) < 1) refuse("it has no raster band");
  const GDALColorInterp color = GDALGetRasterColorInterpretation(GDALGetRasterBand(file, 1));
  if (color == GCI_RedBand || color == GCI_PaletteIndex) refuse("it is an image, not an elevation model");
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
  if (!file) refuse_by_gdal();
  require_elevations(file.get());
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
  constexpr int kMaxSide = 100'000;
  if (std::max(width, height) > kMaxSide)
    refuse("it has " + std::to_string(width) + " x " + std::to_string(height) +
           " samples across the map; valid: at most " + std::to_string(kMaxSide) + " along each side");

  HeightRows heights(GDALGetRasterBand(file.get(), 1), all);
  read.stride = (std::max(width, height) + max_side - 1) / max_side;
  read.rows = (height - 1) / read.stride + 1;
  read.columns = (width - 1) / read.stride + 1;
  std::vector<std::vector<double>> rows;
  for (int y = 0; y <= (read.rows - 1) * read.stride; ++y) {
    rows.push_back(heights.read(y, read.absurd_count));
    if (y % read.stride != 0) continue;
    for (int column = 0; column < read.columns; ++column) {
      const int x = column * read.stride;
      read.samples.push_back({projection.place(applied(to_file, all.left + x + 0.5, all.top + y + 0.5)),
                              rows.back()[static_cast<size_t>(x)]});
    }
    if (y > 0 && read.stride > 1)
      read.skipped_error_m = std::max(read.skipped_error_m, skipped_error_m(rows, read.stride));
    rows.erase(rows.begin(), rows.end() - 1);
  }
}
