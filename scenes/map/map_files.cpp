#include "scenes/map/map_files.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>

#include "scenes/terrain/heightmap.h"
#include "sim/fields/file_fault.h"
#include "sim/fields/own_library.h"

namespace hedgehop::scenes::map {
namespace {

void require_file(const std::filesystem::path& file) {
  if (const std::string fault = file_fault(file); !fault.empty()) throw std::invalid_argument(fault);
}

template <class Function>
[[maybe_unused]] Function* loaded(const char* library, const char* name) {
  return own_library_function<Function>(library, name, "this installation cannot read it: ");
}

/// Calls a function of a library, with its errors as those of this library.
template <class Call>
[[maybe_unused]] void guarded(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& fault) {
    std::string line = fault.what();
    std::ranges::replace(line, '\n', ' ');
    throw std::invalid_argument(line);
  }
}

}  // namespace

OsmObjects read_osm(const std::filesystem::path& file) {
  require_file(file);
  const std::string name = file.filename().string();
  if (!name.ends_with(".osm") && !name.ends_with(".osm.pbf"))
    throw std::invalid_argument("its name ends with neither .osm nor .osm.pbf");
  OsmObjects objects;
#ifdef HEDGEHOP_OSMIUM
  guarded([&] { loaded<ReadOsm>(kOsmLibrary, kReadOsm)(file, objects); });
  return objects;
#else
  throw std::invalid_argument("this build reads no maps: install libosmium2-dev and build again");
#endif
}

HeightSamples read_heights(const std::filesystem::path& file, const GeoBounds& bounds) {
  require_file(file);
  HeightSamples samples;
#ifdef HEDGEHOP_GDAL
  guarded([&] {
    loaded<ReadElevations>(kElevationLibrary, kReadElevations)(file, bounds, terrain::kMaxHeightmapSide, samples);
  });
  return samples;
#else
  (void)bounds;
  throw std::invalid_argument("this build reads no elevation models: install libgdal-dev and build again");
#endif
}

}  // namespace hedgehop::scenes::map
