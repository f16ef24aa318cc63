#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes::mesh {

/// A mesh from an OBJ, glTF (.gltf, .glb), DAE, PLY or STL file, or a world or model in SDFormat (.sdf, .world). The
/// model is placed upright with its front along the heading. If y is up, the front is +z in glTF and -z in other
/// formats; if z is up, as always in SDFormat, it is y.
struct ImportConfig {
  enum class Up { y, z };
  enum class Collide { surface, none };

  std::string file;
  std::string name = "mesh";
  SemanticClass kind = SemanticClass::other;
  double north_m = 0.0, east_m = 0.0, altitude_m = 0.0;
  double heading_rad = 0.0;
  double scale = 1.0;
  std::optional<Eigen::Vector3d> origin_ENU;  ///< of the model's coordinates, in its units; default: the scene's
  Up up = Up::y;
  Collide collide = Collide::surface;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<ImportConfig> auto& c) {
  v("file", c.file,
    {.required = true,
     .meaning = "OBJ, glTF, DAE, PLY, STL or SDFormat file; relative to the folder of the file that names it"});
  v("name", c.name, {.meaning = "name of the obstacle in results; in SDFormat, the models have their own names"});
  v("class", c.kind,
    {.choices = {kSemanticClassNames.begin(), kSemanticClassNames.end()}, .meaning = "class in semantic images"});
  v("north", c.north_m, {.unit = "m", .meaning = "north position of the model's origin"});
  v("east", c.east_m, {.unit = "m", .meaning = "east position of the model's origin"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "altitude of the model's origin"});
  v("heading", c.heading_rad, {.unit = "deg", .meaning = "heading of the model's front, from north to east"});
  v("scale", c.scale, {.above = 0.0, .meaning = "meters per unit of the model"});
  v("origin", c.origin_ENU,
    {.at_least = -1e8,
     .at_most = 1e8,
     .meaning =
         "origin of georeferenced coordinates: east, north and up, in units of the model; default: the scene's"});
  v("up", c.up, {.choices = {"y", "z"}, .meaning = "axis of the model that points up; DAE files state their own"});
  v("collide", c.collide,
    {.choices = {"surface", "none"},
     .meaning = "obstacles: all triangles of the mesh, or the collision shapes of SDFormat; or none"});
}

/// Adds imported meshes to a scene: triangles, one texture per material (its image or its color) and, unless `collide`
/// is `none`, one solid of shape `surface` per part of the file. Textures are resized to the size of the scene's
/// textures. The visual shapes of SDFormat are drawn, and its collision shapes are solids.
/// @param origin_ENU  of the imports without an origin, m.
/// @return one line for each file with its size, and one with features that are not rendered or images that are
/// reduced.
/// @throws std::invalid_argument that begins with the faulty key; for a file it states the reason: missing, unreadable,
/// without triangles, or an image missing.
std::vector<std::string> add_imports(const std::vector<ImportConfig>& imports, const Eigen::Vector3d& origin_ENU,
                                     Scene& scene);

/// Returns all files that an import reads: the mesh, its materials, buffers and images. Images embedded in another file
/// are not listed. @throws std::invalid_argument if the mesh cannot be read.
std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh);

/// Returns the decoded image of a mesh: PNG of any depth, JPEG, BMP, TGA, TIFF, WebP, or PPM and PGM (P2, P3, P5, P6).
/// @return CV_8UC3, RGB, or CV_8UC4 with alpha; empty if the format is another or the data is invalid.
/// @throws std::invalid_argument if it has more than 8192 x 8192 pixels.
cv::Mat decode_texture(std::span<const uint8_t> bytes);

}  // namespace hedgehop::scenes::mesh
