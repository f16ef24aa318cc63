#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "scenes/instance.h"
#include "scenes/mesh/polyhedron.h"
#include "scenes/motion.h"
#include "scenes/texture_list.h"

namespace hedgehop::scenes {

/// A body for collision detection, in its own frame S.
struct Solid {
  enum class Shape {
    box,       ///< faces at +-half_extents_m along the axes
    cylinder,  ///< upright, axis z: half extents (radius, radius, half height)
    sphere,    ///< half extents (radius, radius, radius)
    hull,      ///< `polyhedron`, closed and convex
    surface,   ///< the triangles of `polyhedron`, in any arrangement, without an interior
  };

  std::string name;
  Eigen::Isometry3d X_WS = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_extents_m = Eigen::Vector3d::Ones();  ///< > 0; unused by hulls and surfaces
  Shape shape = Shape::box;
  mesh::Polyhedron polyhedron = {};  ///< in S; hulls and surfaces only
};

/// Returns the axis-aligned bounding box of a solid in W. For a tilted cylinder it is the bound of its box.
Eigen::AlignedBox3d bounds_W(const Solid& solid);

/// Corner of a triangle, in W.
struct Vertex {
  Eigen::Vector3f p_W = Eigen::Vector3f::Zero();    ///< m
  Eigen::Vector3f n_W = -Eigen::Vector3f::UnitZ();  ///< unit outward normal
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();     ///< 1 = one repeat; row 0 of the image at v = 0, v grows downwards
  uint32_t texture = 0;                             ///< index into Scene::textures
  uint32_t instance = 0;                            ///< index into Mesh::instances; equal at all corners of a triangle
};

/// The triangles that suffice at a distance: some of the chunk's, or coarser ones. Movers are always drawn completely.
struct FarDetail {
  uint32_t first_index = 0;  ///< into Mesh::far_indices
  uint32_t index_count = 0;  ///< a multiple of 3; 0: the chunk is always drawn completely
  float lost_m = 0.0f;       ///< maximum width of the omitted parts, or twice the displacement of coarser surfaces
};

/// Triangles that are culled together, such as a box of a building, a tree or a tile of ground. The triangles are close
/// together, and there is at least one.
struct Chunk {
  Eigen::AlignedBox3f box_W;  ///< bounds of the chunk, m
  uint32_t first_index = 0;   ///< into Mesh::indices
  uint32_t index_count = 0;   ///< a multiple of 3
  /// The box and the space below it, down to the ground, are opaque: the chunk can occlude others.
  bool fills_box_to_ground = false;
  FarDetail far;
  /// A box inside the chunk that is opaque, with the space below it down to the ground: it can occlude others. Empty if
  /// there is none.
  Eigen::AlignedBox3f core_W;
};

/// All geometry of one material, drawn with one call. Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::string material;  ///< always "opaque" so far
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<Chunk> chunks;                                   ///< cover all indices, in order
  std::vector<uint32_t> far_indices;                           ///< of the chunks' far details
  std::vector<Instance> instances = std::vector<Instance>(1);  ///< at least one
};

/// A moving obstacle. It moves with its frame M, whose axes remain parallel to those of W except in a TableMotion.
struct Mover {
  std::string name;
  Mesh mesh;                  ///< like other meshes, but in M instead of W; one instance; uses the scene's textures
  std::vector<Solid> solids;  ///< in M instead of W: X_WS holds X_MS
  Motion motion;
};

/// Ambient light and one sun, both colorless, so that a grey image equals the mean of the color image's channels.
struct Lights {
  float ambient = 0.55f;  ///< share of albedo, 0..1
  float sun = 0.45f;      ///< share of albedo at normal incidence, 0..1
  Eigen::Vector3f to_sun_W = Eigen::Vector3f(0.5f, -0.3f, -0.8f).normalized();
};

/// Color above the horizon: a vertical gradient, RGB 0..1. Closed rooms also have one, although it is not visible.
struct Sky {
  Eigen::Vector3f horizon = {0.80f, 0.86f, 0.92f};
  Eigen::Vector3f zenith = {0.45f, 0.62f, 0.85f};
  /// Meteorological optical range [WMO8] ch. 9, m, > 0: the distance at which contrast with the horizon falls to 5 %.
  double visibility_m = std::numeric_limits<double>::infinity();
};

/// A world, as a plain value. Equal inputs to a generator give scenes that are equal bit for bit.
struct Scene {
  std::string name;
  std::vector<Mesh> meshes;  ///< one per material
  TextureList textures;
  Lights lights;
  Sky sky;
  std::vector<Solid> solids;  ///< fixed obstacles, without the ground
  std::vector<Mover> movers;
  /// Corners that a map of the scene should contain, m; empty if the generator does not list them.
  std::vector<Eigen::Vector3d> corners_W;
  double shortest_edge_m = std::numeric_limits<double>::infinity();  ///< between two of those corners on one building
  bool has_ground = true;                                            ///< the plane z = 0 of W is an obstacle
  Eigen::AlignedBox2d bounds_NE_m;                                   ///< flight area in the plan (north, east), m
};

/// Returns the number of solids, including those of the movers.
size_t solid_count(const Scene& scene);

/// Returns a solid of the scene; indices past its own solids refer to those of its movers, in order.
/// @param index  < solid_count().
const Solid& solid_at(const Scene& scene, size_t index);

/// Returns the maximum distance of the solids of a mover from M's origin, m.
double reach_m(const Mover& mover);

/// Returns the instances of all meshes in order, then one for each mover. The label of element i in images is 1 + i.
std::vector<Instance> instances(const Scene& scene);

/// Returns the label of the first mover.
int first_mover_label(const Scene& scene);

}  // namespace hedgehop::scenes
