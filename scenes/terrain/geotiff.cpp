#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scenes/mesh/tiff_memory.h"
#include "scenes/terrain/heightmap.h"

namespace hedgehop::scenes::terrain {

namespace {

// Tags and keys of [GeoTIFF11], and GDAL's tag of the value without data.
constexpr uint32_t kPixelScale = 33550, kTiepoints = 33922, kTransformation = 34264, kGeoKeys = 34735, kNoData = 42113;
constexpr uint16_t kModelTypeKey = 1024, kRasterTypeKey = 1025, kLinearUnitsKey = 3076, kVerticalUnitsKey = 4099;
constexpr uint16_t kGeographic = 2, kPixelIsPoint = 2;

/// The type of the values of a tag in the file [GeoTIFF11].
template <class T>
constexpr TIFFDataType kDataType = std::is_same_v<T, double>     ? TIFF_DOUBLE
                                   : std::is_same_v<T, uint16_t> ? TIFF_SHORT
                                                                 : TIFF_ASCII;

std::string tag_name(uint32_t tag) {
  for (const auto& [number, name] : {std::pair{kPixelScale, "ModelPixelScale"},
                                     {kTiepoints, "ModelTiepoint"},
                                     {kTransformation, "ModelTransformation"},
                                     {kGeoKeys, "GeoKeyDirectory"},
                                     {kNoData, "GDAL_NODATA"}}) {
    if (number == tag) return name;
  }
  return std::to_string(tag);
}

/// @param type  of a file, so it can be beyond TIFFDataType.
std::string type_name(unsigned type) {
  for (const auto& [one, name] : {std::pair{TIFF_DOUBLE, "64-bit floats"},
                                  {TIFF_FLOAT, "32-bit floats"},
                                  {TIFF_LONG, "32-bit integers"},
                                  {TIFF_SHORT, "16-bit integers"},
                                  {TIFF_BYTE, "8-bit integers"},
                                  {TIFF_ASCII, "text"}}) {
    if (one == type) return name;
  }
  return "values of the type " + std::to_string(type);
}

/// Returns the values of a tag that libtiff itself does not know. Their form depends on whether another library of the
/// process has declared it.
template <class T>
std::vector<T> tag_values(TIFF* tiff, uint32_t tag) {
  const TIFFField* const field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (!field) return {};
  const unsigned type = TIFFFieldDataType(field);
  if (type != kDataType<T>) {  // the values would be read past their end
    throw std::invalid_argument("its tag " + tag_name(tag) + " has " + type_name(type) +
                                "; valid: " + type_name(kDataType<T>));
  }
  T* values = nullptr;
  if (TIFFFieldPassCount(field) == 0) {  // text
    if (TIFFGetField(tiff, tag, &values) == 0 || !values) return {};
    size_t length = 0;
    while (values[length] != T{}) ++length;
    return {values, values + length};
  }
  uint32_t count = 0;
  uint16_t short_count = 0;
  const bool is_long = TIFFFieldReadCount(field) == TIFF_VARIABLE2;
  const int found = is_long ? TIFFGetField(tiff, tag, &count, &values) : TIFFGetField(tiff, tag, &short_count, &values);
  if (found == 0 || !values) return {};
  return {values, values + (is_long ? count : short_count)};
}

/// Returns the value of a geo key, or 0.
uint16_t geo_key(const std::vector<uint16_t>& directory, uint16_t key) {
  for (size_t at = 4; at + 4 <= directory.size(); at += 4) {
    if (directory[at] == key && directory[at + 1] == 0) return directory[at + 3];
  }
  return 0;
}

/// Returns the length of a unit in meters; 1 without the key. @param quantities  for the message, such as "heights".
double unit_m(const std::vector<uint16_t>& directory, uint16_t key, const char* quantities) {
  constexpr uint16_t kMeter = 9001, kFoot = 9002, kUsSurveyFoot = 9003;
  const uint16_t unit = geo_key(directory, key);
  if (unit == 0 || unit == kMeter) return 1.0;
  if (unit == kFoot) return 0.3048;
  if (unit == kUsSurveyFoot) return 1200.0 / 3937.0;
  throw std::invalid_argument(std::string("its ") + quantities + " have the unit " + std::to_string(unit) +
                              "; valid: 9001 (m), 9002 (ft), 9003 (US survey ft)");
}

void read_georeference(TIFF* tiff, const std::vector<uint16_t>& keys, Heightmap& map) {
  if (geo_key(keys, kModelTypeKey) == kGeographic) {
    throw std::invalid_argument("its coordinates are degrees; valid: a projection in meters, such as UTM");
  }
  if (!tag_values<double>(tiff, kTransformation).empty()) {
    throw std::invalid_argument("its grid has a ModelTransformation; valid: a grid along east and north");
  }
  const std::vector<double> scale = tag_values<double>(tiff, kPixelScale), tie = tag_values<double>(tiff, kTiepoints);
  if (scale.size() < 2) return;
  const auto is_valid = [](double spacing) { return std::isfinite(spacing) && spacing > 0.0; };
  if (!is_valid(scale[0]) || !is_valid(scale[1])) {
    throw std::invalid_argument("its pixel scale is " + std::to_string(scale[0]) + " x " + std::to_string(scale[1]) +
                                "; valid: finite and above 0");
  }
  const double horizontal_m = unit_m(keys, kLinearUnitsKey, "coordinates");
  map.spacing_EN_m = horizontal_m * Eigen::Vector2d(scale[0], scale[1]);
  if (tie.size() < 6) return;
  const double to_middle = geo_key(keys, kRasterTypeKey) == kPixelIsPoint ? 0.0 : 0.5;
  map.northwest_EN_m = horizontal_m * Eigen::Vector2d(tie[3] + (to_middle - tie[0]) * scale[0],
                                                      tie[4] - (to_middle - tie[1]) * scale[1]);
  if (!map.northwest_EN_m->allFinite()) throw std::invalid_argument("its tiepoint is not finite");
}

/// Returns the OpenCV type of the samples.
int sample_type(TIFF* tiff) {
  uint16_t bits = 1, format = SAMPLEFORMAT_UINT, bands = 1;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &bands);
  if (bands == 1) {
    if (format == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64)) return bits == 32 ? CV_32F : CV_64F;
    if (format == SAMPLEFORMAT_INT && (bits == 16 || bits == 32)) return bits == 16 ? CV_16S : CV_32S;
    if (format == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16)) return bits == 8 ? CV_8U : CV_16U;
  }
  const char* const kind = format == SAMPLEFORMAT_IEEEFP ? "floating point"
                           : format == SAMPLEFORMAT_INT  ? "signed"
                                                         : "unsigned";
  throw std::invalid_argument("it has " + std::to_string(bands) + " band(s) of " + std::to_string(bits) + " bit, " +
                              kind +
                              "; valid: one band of 8 or 16 bit, unsigned; 16 or 32 bit, signed; or 32 or 64 bit, "
                              "floating point");
}

/// Reads the blocks of a TIFF: its tiles, or its strips as tiles of full width.
cv::Mat read_blocks(TIFF* tiff, int columns, int rows, int type) {
  const bool tiled = TIFFIsTiled(tiff) != 0;
  uint32_t width = static_cast<uint32_t>(columns), height = static_cast<uint32_t>(rows);
  if (tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &height);
    height = std::min(height, static_cast<uint32_t>(rows));
  }
  constexpr uint32_t kMaxBlockSide = 4096;
  if (width == 0 || height == 0 || width > kMaxBlockSide || height > kMaxBlockSide) {
    throw std::invalid_argument("its blocks are larger than 4096 x 4096 samples");
  }
  cv::Mat all(rows, columns, type), block(static_cast<int>(height), static_cast<int>(width), type);
  const auto bytes = static_cast<tmsize_t>(block.total() * block.elemSize());
  for (int top = 0; top < rows; top += block.rows) {
    for (int left = 0; left < columns; left += block.cols) {
      const auto x = static_cast<uint32_t>(left), y = static_cast<uint32_t>(top);
      const uint32_t index = tiled ? TIFFComputeTile(tiff, x, y, 0, 0) : TIFFComputeStrip(tiff, y, 0);
      const tmsize_t got = tiled ? TIFFReadEncodedTile(tiff, index, block.data, bytes)
                                 : TIFFReadEncodedStrip(tiff, index, block.data, bytes);
      const cv::Rect part(left, top, std::min(block.cols, columns - left), std::min(block.rows, rows - top));
      const auto needed = static_cast<tmsize_t>(block.elemSize()) * (tiled ? block.cols : part.width) * part.height;
      if (got < needed) throw std::invalid_argument("it cannot be decoded as TIFF");
      block(cv::Rect(0, 0, part.width, part.height)).copyTo(all(part));
    }
  }
  return all;
}

}  // namespace

Heightmap heights_of_tiff(std::span<const uint8_t> bytes) {
  const mesh::TiffInMemory opened(bytes);
  TIFF* const tiff = opened.get();
  if (!tiff) throw std::invalid_argument("it is no PNG and no TIFF");
  uint32_t columns = 0, rows = 0;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &columns);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &rows);
  require_grid(columns, rows);
  Heightmap map;
  map.in_meters = true;
  const cv::Mat samples = read_blocks(tiff, static_cast<int>(columns), static_cast<int>(rows), sample_type(tiff));
  samples.convertTo(map.values, CV_32F);
  const std::vector<uint16_t> keys = tag_values<uint16_t>(tiff, kGeoKeys);
  read_georeference(tiff, keys, map);
  if (const std::vector<char> text = tag_values<char>(tiff, kNoData); !text.empty()) {
    const auto none = static_cast<float>(std::strtod(std::string(text.begin(), text.end()).c_str(), nullptr));
    for (float& value : map.values) {
      if (value == none) value = std::numeric_limits<float>::quiet_NaN();
    }
  }
  if (const double vertical_m = unit_m(keys, kVerticalUnitsKey, "heights"); vertical_m != 1.0) map.values *= vertical_m;
  return map;
}

}  // namespace hedgehop::scenes::terrain
