#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <type_traits>
#include <variant>

#include "scenes/scene.h"

namespace hedgehop::scenes {

template <class Box>
bool same_box(const Box& a, const Box& b) {
  return a.min() == b.min() && a.max() == b.max();
}

inline bool identical(const Chunk& p, const Chunk& q) {
  return same_box(p.box_W, q.box_W) && same_box(p.core_W, q.core_W) && p.first_index == q.first_index &&
         p.index_count == q.index_count && p.fills_box_to_ground == q.fills_box_to_ground &&
         p.far.first_index == q.far.first_index && p.far.index_count == q.far.index_count &&
         p.far.lost_m == q.far.lost_m;
}

inline bool identical(const Mesh& p, const Mesh& q) {
  return p.material == q.material && p.indices == q.indices && p.far_indices == q.far_indices &&
         std::ranges::equal(p.vertices, q.vertices,
                            [](const Vertex& v, const Vertex& w) {
                              return v.p_W == w.p_W && v.n_W == w.n_W && v.uv == w.uv && v.texture == w.texture &&
                                     v.instance == w.instance;
                            }) &&
         std::ranges::equal(p.chunks, q.chunks, [](const Chunk& a, const Chunk& b) { return identical(a, b); }) &&
         std::ranges::equal(p.instances, q.instances,
                            [](const Instance& a, const Instance& b) { return a.name == b.name && a.kind == b.kind; });
}

inline bool identical(const std::vector<Solid>& a, const std::vector<Solid>& b) {
  return std::ranges::equal(a, b, [](const Solid& p, const Solid& q) {
    return p.name == q.name && p.shape == q.shape && p.half_extents_m == q.half_extents_m &&
           p.X_WS.matrix() == q.X_WS.matrix() && p.polyhedron.corners == q.polyhedron.corners &&
           p.polyhedron.faces == q.polyhedron.faces;
  });
}

inline bool identical(const WaypointMotion& a, const WaypointMotion& b) {
  return a.speed_mps == b.speed_mps && a.repeat == b.repeat && a.start_s == b.start_s &&
         std::ranges::equal(a.points, b.points, {}, &Waypoint::p_W, &Waypoint::p_W);
}
inline bool identical(const OrbitMotion& a, const OrbitMotion& b) {
  return a.north_m == b.north_m && a.east_m == b.east_m && a.altitude_m == b.altitude_m && a.radius_m == b.radius_m &&
         a.speed_mps == b.speed_mps && a.bearing_rad == b.bearing_rad && a.start_s == b.start_s;
}
/// Compares the names of the files, not their contents.
inline bool identical(const TableMotion& a, const TableMotion& b) {
  return a.file == b.file && a.repeat == b.repeat && a.start_s == b.start_s;
}
inline bool identical(const Mover& a, const Mover& b) {
  const auto same_motion = [&](const auto& motion) {
    const auto* other = std::get_if<std::decay_t<decltype(motion)>>(&b.motion);
    return other && identical(motion, *other);
  };
  return a.name == b.name && identical(a.mesh, b.mesh) && identical(a.solids, b.solids) &&
         std::visit(same_motion, a.motion);
}

inline bool identical(const TextureList& a, const TextureList& b) {
  return std::ranges::equal(a.images(), b.images(), [](const cv::Mat& p, const cv::Mat& q) {
    return p.size() == q.size() && p.type() == q.type() && cv::norm(p, q, cv::NORM_INF) == 0.0;
  });
}

/// Compares all data of two scenes exactly.
inline bool identical(const Scene& a, const Scene& b) {
  return a.name == b.name && a.corners_W == b.corners_W && a.shortest_edge_m == b.shortest_edge_m &&
         a.has_ground == b.has_ground && same_box(a.bounds_NE_m, b.bounds_NE_m) &&
         a.lights.ambient == b.lights.ambient && a.lights.sun == b.lights.sun &&
         a.lights.to_sun_W == b.lights.to_sun_W && a.sky.horizon == b.sky.horizon && a.sky.zenith == b.sky.zenith &&
         a.sky.visibility_m == b.sky.visibility_m && identical(a.solids, b.solids) &&
         std::ranges::equal(a.meshes, b.meshes, [](const Mesh& p, const Mesh& q) { return identical(p, q); }) &&
         std::ranges::equal(a.movers, b.movers, [](const Mover& p, const Mover& q) { return identical(p, q); }) &&
         identical(a.textures, b.textures);
}

inline Eigen::AlignedBox3d box_of(const Solid& solid) {
  return {solid.X_WS.translation() - solid.half_extents_m, solid.X_WS.translation() + solid.half_extents_m};
}

}  // namespace hedgehop::scenes
