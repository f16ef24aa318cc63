#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::mesh {

/// A mesh from an OBJ or glTF file (.gltf, .glb). The model is placed upright with its front along the heading. The
/// front is -z if y is up, and y if z is up.
struct ImportConfig {
  enum class Up { y, z };
  enum class Collide { surface, none };

  std::string file;
  std::string name = "mesh";
  SemanticClass kind = SemanticClass::other;
  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;
  double heading_rad = 0.0;
  double scale = 1.0;
  Up up = Up::y;
  Collide collide = Collide::surface;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImportConfig> auto& c) {
  v("file", c.file,
    {.required = true, .meaning = "OBJ or glTF file; relative to the folder of the file that names it"});
  v("name", c.name, {.meaning = "name of the obstacle in results"});
  v("class", c.kind,
    {.choices = {kSemanticClassNames.begin(), kSemanticClassNames.end()}, .meaning = "class in semantic images"});
  v("north", c.north_m, {.unit = "m", .meaning = "north position of the model's origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "east position of the model's origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "altitude of the model's origin"});
  v("heading", c.heading_rad, {.unit = "deg", .meaning = "heading of the model's front, from north to east"});
  v("scale", c.scale, {.above = 0.0, .meaning = "meters per unit of the model"});
  v("up", c.up, {.choices = {"y", "z"}, .meaning = "the model's axis that points up"});
  v("collide", c.collide, {.choices = {"surface", "none"}, .meaning = "obstacles: all triangles of the mesh, or none"});
}

/// Adds imported meshes to a scene: triangles, one texture per material (its image or its color) and, unless `collide`
/// is `none`, one solid of shape `surface` per mesh in the file. Textures are resized to the size of the scene's
/// textures.
/// @throws std::invalid_argument that begins with the faulty key; for a file it states the reason: missing, unreadable,
/// without triangles, or an image missing.
void add_imports(const std::vector<ImportConfig>& imports, Scene& scene);

/// Returns all files that an import reads: the mesh, its materials, buffers and images. Images embedded in another file
/// are not listed. @throws std::invalid_argument if the mesh cannot be read.
std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh);

/// Returns the decoded texture of a mesh: PNG of any depth, JPEG, or PPM and PGM (P2, P3, P5, P6), without
/// transparency.
/// @return CV_8UC3, RGB; empty if the format is another, the data is invalid, or it has more than 64 million pixels.
cv::Mat decode_texture(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
