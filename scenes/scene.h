#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scenes/motion.h"
#include "scenes/solid.h"

namespace hedgehop::scenes {

/// Corner of a triangle, in W.
struct Vertex {
  Eigen::Vector3f p_W = Eigen::Vector3f::Zero();    ///< m
  Eigen::Vector3f n_W = -Eigen::Vector3f::UnitZ();  ///< unit outward normal
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();     ///< 1 = one repeat; row 0 of the image at v = 0, v grows downwards
  uint32_t texture = 0;                             ///< index into Scene::textures
};

/// Those of a chunk's triangles that are enough from far away. Movers are drawn whole from anywhere.
struct FarDetail {
  uint32_t first_index = 0;  ///< into Mesh::far_indices
  uint32_t index_count = 0;  ///< a multiple of 3; 0: the chunk is drawn whole from anywhere
  float lost_m = 0.0f;       ///< what is left out is no wider
};

/// Triangles that are culled as one: a box of a building, a whole tree, a tile of ground; all of them near each other.
/// A chunk has at least one triangle.
struct Chunk {
  Eigen::AlignedBox3f box_W;  ///< bounds of the chunk, m
  uint32_t first_index = 0;   ///< into Mesh::indices
  uint32_t index_count = 0;   ///< a multiple of 3
  /// The box is opaque, and so is all below it down to the ground: may hide what lies behind.
  bool fills_box_to_ground = false;
  FarDetail far;
};

/// All geometry of one material: drawn with one call. Triangles are counter-clockwise seen from outside.
struct Mesh {
  std::string material;  ///< "opaque" for everything so far
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<Chunk> chunks;          ///< cover all indices, in order
  std::vector<uint32_t> far_indices;  ///< of the chunks' far details
};

/// What moves through the scene, without turning: its frame M travels, the axes stay those of W, and so does its light.
struct Mover {
  std::string name;
  Mesh mesh;                  ///< as other meshes, but in M where those are in W; textures are the scene's
  std::vector<Solid> solids;  ///< what can be hit, in M where others are in W: X_WS holds X_MS
  Motion motion;
};

/// Ambient light plus one sun, without color, so that a grey image equals the mean of the color image's channels.
struct Lights {
  float ambient = 0.55f;  ///< share of albedo, 0..1
  float sun = 0.45f;      ///< share of albedo at normal incidence, 0..1
  Eigen::Vector3f to_sun_W = Eigen::Vector3f(0.5f, -0.3f, -0.8f).normalized();
};

/// Color above the horizon: a vertical gradient, RGB 0..1. A closed room has no sky to see, yet needs no special case.
struct Sky {
  Eigen::Vector3f horizon = {0.80f, 0.86f, 0.92f};
  Eigen::Vector3f zenith = {0.45f, 0.62f, 0.85f};
  /// Meteorological optical range [WMO8] ch. 9, m, > 0: contrast with the horizon's color has fallen to 5 % there.
  double visibility_m = std::numeric_limits<double>::infinity();
};

/// What the world is. A value: equal inputs to a generator give equal scenes, bit for bit.
struct Scene {
  std::string name;
  std::vector<Mesh> meshes;       ///< one per material
  std::vector<cv::Mat> textures;  ///< CV_8UC3 RGB, all of one square power-of-two size, tileable
  Lights lights;
  Sky sky;
  std::vector<Solid> solids;  ///< what can be hit and stands still, besides the ground
  std::vector<Mover> movers;
  /// Corners that a map of the scene should hold, m; empty where the generator does not list them.
  std::vector<Eigen::Vector3d> corners_W;
  double shortest_edge_m = std::numeric_limits<double>::infinity();  ///< between two of them on one building
  bool has_ground = true;                                            ///< the plane z = 0 of W can be hit
  Eigen::AlignedBox2d bounds_NE_m;  ///< extent of the plan (north, east) that flights care about
};

/// Returns the number of solids, those of the movers included.
size_t solid_count(const Scene& scene);

/// Returns a solid of the scene or, counted on from there, of its movers in order.
/// @param index  < solid_count().
const Solid& solid_at(const Scene& scene, size_t index);

}  // namespace hedgehop::scenes
