#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/mesh/mesh_import.h"
#include "scenes/scene.h"
#include "scenes/terrain/terrain.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes {

/// A box on the ground, or above it and tilted.
struct BoxConfig {
  std::string name = "box";
  double north_m = 0.0, east_m = 0.0;  ///< of the center
  double length_m = 10.0;              ///< along the heading
  double width_m = 5.0;                ///< across the heading
  double height_m = 20.0;
  double heading_rad = 0.0;  ///< of the long axis, from north to east
  double altitude_m = 0.0;   ///< of the bottom, before a tilt
  /// Rotation about the center, instead of the heading: w, x, y, z about the axes of W. Empty: none.
  std::vector<double> quaternion;

  /// Returns the corners in the plan (north, east), m, in order around the box.
  std::vector<Eigen::Vector2d> corners_NE_m() const;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<BoxConfig> auto& c) {
  v("name", c.name, {.meaning = "name of the obstacle in results"});
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "center of the box, north of the scene's origin"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "center of the box, east of the scene's origin"});
  v("length", c.length_m, {.unit = "m", .above = 0.0, .meaning = "length along the heading"});
  v("width", c.width_m, {.unit = "m", .above = 0.0, .meaning = "width across the heading"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "height of the box"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "heading of the long axis, from north to east"});
  v("altitude", c.altitude_m, {.unit = "m", .meaning = "altitude of the bottom, before a rotation by the quaternion"});
  v("quaternion", c.quaternion,
    {.meaning = "rotation about the center, instead of the heading: w, x, y, z about north, east and down"});
}

/// Adds brick boxes and their texture to a scene. The texture has the size of the scene's other textures.
/// @param seed  of the random stream of the boxes.
/// @throws std::invalid_argument with the field, its value and the valid values.
void add_boxes(const std::vector<BoxConfig>& boxes, uint64_t seed, Scene& scene);

/// A moving obstacle. The origin of M is the obstacle's foot, or the center of a cuboid.
struct MoverConfig {
  enum class Shape { balloon, pole, box, tree, cuboid };

  std::string name = "mover";
  Shape shape = Shape::balloon;
  double radius_m = 0.6;
  double height_m = 6.0;
  Eigen::Vector3d size_m = Eigen::Vector3d::Ones();  ///< of a cuboid, along the axes of M
  Motion motion;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MoverConfig> auto& c) {
  v("name", c.name, {.meaning = "name of the obstacle in results"});
  v("shape", c.shape,
    {.choices = {"balloon", "pole", "box", "tree", "cuboid"},
     .meaning = "a balloon on a thin pole, an upright cylinder, a square pillar, a tree; a box around the point that "
                "moves, which has a size and neither radius nor height"});
  v("radius", c.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "radius of the balloon, pole or crown; half the width of a box"});
  v("height", c.height_m,
    {.unit = "m", .above = 0.0, .meaning = "height of the top, or of the balloon's center, above the foot"});
  v("size", c.size_m,
    {.unit = "m",
     .above = 0.0,
     .meaning = "size of a cuboid along its axes; these point north, east and down if it is not rotated"});
  v("motion", c.motion, {.meaning = "motion of the foot, or of the center of a cuboid"});
}

/// Adds movers and their textures to a scene. The textures have the size of the scene's other textures.
/// @param seed  of the random stream of the movers.
/// @throws std::invalid_argument with the field, its value and the valid values.
void add_movers(const std::vector<MoverConfig>& movers, uint64_t seed, Scene& scene);

/// Objects that can be added to every generated scene, and its ground.
struct SceneAdditions {
  enum class Ground { plane, none };

  std::vector<BoxConfig> boxes;
  std::vector<MoverConfig> movers;
  std::vector<mesh::ImportConfig> imports;
  Ground ground = Ground::plane;
  std::optional<terrain::TerrainConfig> terrain;
  Eigen::Vector3d origin_ENU = Eigen::Vector3d::Zero();  ///< of georeferenced coordinates, m

  bool has_plane() const { return ground == Ground::plane && !terrain; }
};

/// Lists the objects; worlds with a ground of their own list only these.
template <class Visitor>
void describe_objects(Visitor& v, fields::ConfigOf<SceneAdditions> auto& c) {
  v("boxes", c.boxes, {.meaning = "boxes on the ground, rotated about the vertical"});
  v("movers", c.movers, {.meaning = "moving obstacles"});
  v("imports", c.imports, {.meaning = "meshes from files, as scenery and obstacles"});
}

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SceneAdditions> auto& c) {
  describe_objects(v, c);
  v("ground", c.ground, {.choices = {"plane", "none"}, .meaning = "the ground of the world at altitude 0, or none"});
  v("terrain", c.terrain, {.meaning = "a terrain from a heightmap, instead of the ground at altitude 0"});
  v("origin", c.origin_ENU,
    {.unit = "m",
     .at_least = -1e8,
     .at_most = 1e8,
     .meaning = "origin of the georeferenced coordinates of imports and terrain: east, north and up"});
}

/// Adds the contents of files to a scene: imports and terrain; removes the ground if the world has none.
/// @param seed  of the random stream of the terrain's texture.
/// @return one line for each file with features that are not rendered.
/// @throws std::invalid_argument that begins with the faulty key.
std::vector<std::string> add_files(const SceneAdditions& added, uint64_t seed, Scene& scene);

}  // namespace hedgehop::scenes
