#pragma once

#include <filesystem>

#include "scenes/map/elevation.h"
#include "scenes/map/osm_objects.h"

namespace hedgehop::scenes::map {

/// Returns the objects of an OpenStreetMap file. @param file  .osm or .osm.pbf.
/// @throws std::invalid_argument with the reason, without the file's name: missing, of another format, unreadable, or
/// this build of Hedgehop cannot read maps.
OsmObjects read_osm(const std::filesystem::path& file);

/// Returns the heights of a digital elevation model. @param bounds  of the wanted heights.
/// @throws std::invalid_argument with the reason, without the file's name, as read_osm().
HeightSamples read_heights(const std::filesystem::path& file, const GeoBounds& bounds);

}  // namespace hedgehop::scenes::map
