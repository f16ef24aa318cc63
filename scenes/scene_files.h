#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/generators.h"
#include "scenes/scene.h"

namespace hedgehop::scenes {

inline constexpr int kFixedTexturePx = 64;  ///< side of the textures of worlds without the key `texture_size`

/// The contents of the files that a scene names: imports and terrain. They take long to read, so the validation of a
/// scenario passes them on to its flight.
struct SceneFiles {
  Scene contents;                    ///< their meshes, textures, solids, and whether the world's ground remains
  std::vector<std::string> remarks;  ///< one line for each file with features that are not rendered
};

/// Reads the files of a scene. @param seed  of the scene, as for make_scene().
/// @throws std::invalid_argument that begins with the faulty key.
SceneFiles read_scene_files(const SceneConfig& config, uint64_t seed);

/// Moves the contents of files into the scene of a world, and removes its ground if they replace it.
void add_scene_files(SceneFiles files, Scene& scene);

/// As make_scene(), with files that have been read. @param files  of the same config and seed.
Scene make_scene(const SceneConfig& config, uint64_t seed, SceneFiles files);

}  // namespace hedgehop::scenes
