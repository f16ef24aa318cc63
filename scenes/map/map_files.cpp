#include "scenes/map/map_files.h"

#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <system_error>

#include "scenes/terrain/heightmap.h"

namespace hedgehop::scenes::map {
namespace {

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw std::invalid_argument("there is no such file");
  if (!std::filesystem::is_regular_file(file, error)) throw std::invalid_argument("it is not a regular file");
}

/// Returns a function of a library, which remains loaded. It is found by the run path of this code.
template <class Function>
[[maybe_unused]] Function* loaded(const char* library, const char* name) {
  void* const handle = ::dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const function = handle != nullptr ? ::dlsym(handle, name) : nullptr;
  if (function == nullptr) throw std::invalid_argument(std::string("this installation cannot read it: ") + ::dlerror());
  return reinterpret_cast<Function*>(function);
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
