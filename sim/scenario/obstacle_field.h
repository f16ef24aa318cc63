#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "scenes/worlds/open.h"

namespace hedgehop::sim {

/// Obstacle fields in the formats of other programs.
enum class FieldFormat {
  aerialist,   ///< test of Aerialist, YAML: `simulation.obstacles`, boxes; x is north, y east, r from north to east
  sdf,         ///< world of SDFormat; x is east, y north
  flightmare,  ///< CSV of static boxes and YAML of boxes that move by CSV; x is north, y west, z up
};
inline constexpr std::string_view kFieldFormatNames[] = {"aerialist", "sdf", "flightmare"};

/// Reads a field into an open scene. Obstacles that move get the paths of their tables, absolute.
/// - aerialist: the obstacles of [UavTestingCompetition2025] sec. on test cases. Their z is that of the bottom.
/// - flightmare: the prefab `rpg_box01` is a cube with an edge of 1 m times its scale. Rows are "prefab, x, y, z, qw,
/// qx,
///   qy, qz, sx, sy, sz". In a YAML file, `csvtraj: NAME` is `csvtrajs/NAME.csv` next to the file. Its boxes go back
///   and forth, as in Flightmare's simulator, or restart if `loop` is true.
/// @param scale  meters per unit of an SDF file.
/// @throws InputError with file, line and the valid values.
scenes::worlds::OpenConfig read_obstacle_field(FieldFormat format, std::span<const std::filesystem::path> files,
                                               double scale);

/// Returns the scene as YAML for `scene: {use: FILE}`. @param folder  of the file; paths are relative to it.
std::string scene_yaml(scenes::worlds::OpenConfig scene, const std::filesystem::path& folder);

}  // namespace hedgehop::sim
