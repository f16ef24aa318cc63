#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// A mesh from a file, OBJ or glTF (.gltf, .glb), as a scene's config lists it. The model stands upright; a model's
/// front (-z where y is up, y where z is up) looks along the heading.
struct ImportConfig {
  enum class Up { y, z };
  enum class Collide { surface, none };

  std::string file;
  std::string name = "mesh";
  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;
  double heading_rad = 0.0;
  double scale = 1.0;
  Up up = Up::y;
  Collide collide = Collide::surface;
};

template <class Visitor>
void describe(Visitor& v, ImportConfig& c) {
  v("file", c.file, {.required = true, .meaning = "OBJ or glTF; seen from the folder of the file that names it"});
  v("name", c.name, {.meaning = "of the obstacle in results"});
  v("north", c.north_m, {.unit = "m", .meaning = "of the model's origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "of the model's origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "of the model's origin"});
  v("heading", c.heading_rad, {.unit = "deg", .meaning = "of the model's front, from north to east"});
  v("scale", c.scale, {.above = 0.0, .meaning = "meters to a unit of the model"});
  v("up", c.up, {.choices = {"y", "z"}, .meaning = "the model's axis that points up"});
  v("collide", c.collide, {.choices = {"surface", "none"}, .meaning = "its triangles can be hit, or nothing of it"});
}

/// Adds imported meshes to a scene: triangles, one image for each material (its image, or its color), and a solid
/// of shape `surface` for each mesh of the file that can be hit. Images are made as large as those that are there.
/// @throws std::invalid_argument that begins with the key at fault; of a file, with the reason: not there, not
/// readable, no triangles, an image missing.
void add_imports(const std::vector<ImportConfig>& imports, Scene& scene);

}  // namespace hedgehop::scenes::mesh
