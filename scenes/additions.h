#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/mesh/mesh_import.h"
#include "scenes/scene.h"
#include "sim/fields/field.h"

namespace hedgehop::scenes {

/// A box on the ground.
struct BoxConfig {
  std::string name = "box";
  double north_m = 0.0, east_m = 0.0;  ///< of the center
  double length_m = 10.0;              ///< along the heading
  double width_m = 5.0;                ///< across the heading
  double height_m = 20.0;
  double heading_rad = 0.0;  ///< of the long axis, from north to east

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
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "height of the top above the ground"});
  v("heading", c.heading_rad,
    {.unit = "deg", .at_least = -360.0, .at_most = 360.0, .meaning = "heading of the long axis, from north to east"});
}

/// Adds brick boxes and their texture to a scene. The texture has the size of the scene's other textures.
/// @param seed  of the random stream of the boxes.
/// @throws std::invalid_argument with the field, its value and the valid values.
void add_boxes(const std::vector<BoxConfig>& boxes, uint64_t seed, Scene& scene);

/// A moving obstacle. The origin of M is the obstacle's foot.
struct MoverConfig {
  enum class Shape { balloon, pole, box, tree };

  std::string name = "mover";
  Shape shape = Shape::balloon;
  double radius_m = 0.6;
  double height_m = 6.0;
  Motion motion;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<MoverConfig> auto& c) {
  v("name", c.name, {.meaning = "name of the obstacle in results"});
  v("shape", c.shape,
    {.choices = {"balloon", "pole", "box", "tree"},
     .meaning = "a balloon on a thin pole, an upright cylinder, a square pillar, a tree"});
  v("radius", c.radius_m,
    {.unit = "m", .above = 0.0, .meaning = "radius of the balloon, pole or crown; half the width of a box"});
  v("height", c.height_m,
    {.unit = "m", .above = 0.0, .meaning = "height of the top, or of the balloon's center, above the foot"});
  v("motion", c.motion, {.meaning = "motion of the foot"});
}

/// Adds movers and their textures to a scene. The textures have the size of the scene's other textures.
/// @param seed  of the random stream of the movers.
/// @throws std::invalid_argument with the field, its value and the valid values.
void add_movers(const std::vector<MoverConfig>& movers, uint64_t seed, Scene& scene);

/// Objects that can be added to every generated scene.
struct SceneAdditions {
  std::vector<BoxConfig> boxes;
  std::vector<MoverConfig> movers;
  std::vector<mesh::ImportConfig> imports;
};

template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SceneAdditions> auto& c) {
  v("boxes", c.boxes, {.meaning = "boxes on the ground, rotated about the vertical"});
  v("movers", c.movers, {.meaning = "moving obstacles"});
  v("imports", c.imports, {.meaning = "meshes from files, as scenery and obstacles"});
}

}  // namespace hedgehop::scenes
