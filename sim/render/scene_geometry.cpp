#include "sim/render/scene_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "sim/render/visible_chunks.h"

namespace hedgehop::sim {

namespace {

void require(bool holds, const std::string& fault) {
  if (!holds) throw std::invalid_argument(fault);
}

void check(const scenes::Mesh& mesh, size_t texture_count) {
  require(mesh.material == "opaque", fmt::format("unknown material '{}'; valid: opaque", mesh.material));
  const auto is_known = [&](uint32_t index) { return index < mesh.vertices.size(); };
  require(std::ranges::all_of(mesh.indices, is_known) && std::ranges::all_of(mesh.far_indices, is_known),
          fmt::format("a mesh of {} vertices has an index out of range", mesh.vertices.size()));
  for (const scenes::Vertex& vertex : mesh.vertices) {
    require(vertex.p_W.allFinite() && vertex.n_W.allFinite() && vertex.uv.allFinite(), "a vertex is not finite");
    require(vertex.texture < texture_count,
            fmt::format("a vertex uses texture {}; the scene has {}", vertex.texture, texture_count));
    require(vertex.instance < mesh.instances.size(),
            fmt::format("a vertex belongs to instance {}; its mesh has {}", vertex.instance, mesh.instances.size()));
  }
  size_t covered = 0;
  for (const scenes::Chunk& chunk : mesh.chunks) {
    require(chunk.first_index == covered && chunk.index_count % 3 == 0,
            "chunks must cover the triangles of a mesh in order, without gaps");
    require(!chunk.box_W.isEmpty(), "the box of a chunk is empty");
    const scenes::FarDetail& far = chunk.far;
    require(size_t{far.first_index} + far.index_count <= mesh.far_indices.size() && far.index_count % 3 == 0,
            "a far detail is outside the far indices of its mesh");
    require(far.index_count == 0 || far.lost_m > 0.0f, "a far detail must have lost_m > 0");
    covered += chunk.index_count;
  }
  require(covered == mesh.indices.size(), "chunks must cover all indices of a mesh");
}

void check(const scenes::Scene& scene) {
  for (const scenes::Mesh& mesh : scene.meshes) check(mesh, scene.textures.size());
  for (const scenes::Mover& mover : scene.movers) {
    check(mover.mesh, scene.textures.size());
    require(mover.mesh.instances.size() == 1, fmt::format("mover '{}' is not one instance", mover.name));
  }
}

float brightness(const scenes::Lights& lights, const Eigen::Vector3f& n_W) {
  return lights.ambient + lights.sun * std::max(0.0f, n_W.dot(lights.to_sun_W));
}

/// Cuts a flat chunk into pairs of triangles, because buildings usually hide most of the ground.
void cut_into_tiles(const scenes::Chunk& chunk, const std::vector<DrawnVertex>& vertices,
                    const std::vector<uint32_t>& indices, std::vector<scenes::Chunk>& tiles) {
  constexpr uint32_t kTwoTriangles = 6;
  const uint32_t end = chunk.first_index + chunk.index_count;
  for (uint32_t first = chunk.first_index; first < end; first += kTwoTriangles) {
    scenes::Chunk& tile = tiles.emplace_back();
    tile.first_index = first;
    tile.index_count = std::min(kTwoTriangles, end - first);
    for (uint32_t i = 0; i < tile.index_count; ++i) {
      const std::array<float, 3>& p_W = vertices[indices[first + i]].p_W;
      tile.box_W.extend(Eigen::Vector3f(p_W[0], p_W[1], p_W[2]));
    }
  }
}

/// Appends a mesh and returns its chunks with indices into the shared list. @param R_WM  attitude in which the mesh is
/// lit. @param label  of its first instance; set to that of the next mesh.
std::vector<scenes::Chunk> append(const scenes::Mesh& mesh, const Eigen::Matrix3f& R_WM, const scenes::Lights& lights,
                                  size_t& label, SceneGeometry& geometry) {
  const auto first_vertex = static_cast<uint32_t>(geometry.vertices.size());
  for (const scenes::Vertex& v : mesh.vertices) {
    geometry.vertices.push_back({{v.p_W.x(), v.p_W.y(), v.p_W.z()},
                                 {v.uv.x(), v.uv.y()},
                                 brightness(lights, R_WM * v.n_W),
                                 static_cast<float>(v.texture),
                                 static_cast<float>(label + v.instance)});
  }
  label += mesh.instances.size();
  const auto append_stretch = [&](const std::vector<uint32_t>& indices, uint32_t& first, uint32_t count) {
    const auto moved_to = static_cast<uint32_t>(geometry.indices.size());
    for (uint32_t i = first; i < first + count; ++i) geometry.indices.push_back(first_vertex + indices[i]);
    first = moved_to;
  };
  std::vector<scenes::Chunk> chunks = mesh.chunks;
  for (scenes::Chunk& chunk : chunks) {
    append_stretch(mesh.indices, chunk.first_index, chunk.index_count);
    append_stretch(mesh.far_indices, chunk.far.first_index, chunk.far.index_count);
  }
  return chunks;
}

}  // namespace

SceneGeometry make_geometry(const scenes::Scene& scene) {
  check(scene);
  SceneGeometry geometry;
  size_t label = 1;
  for (const scenes::Mesh& mesh : scene.meshes) {
    for (const scenes::Chunk& chunk : append(mesh, Eigen::Matrix3f::Identity(), scene.lights, label, geometry)) {
      geometry.chunks.push_back(chunk);
      if (lies_flat(chunk)) cut_into_tiles(chunk, geometry.vertices, geometry.indices, geometry.tiles);
    }
  }
  for (const scenes::Mover& mover : scene.movers) {
    // A mover that turns keeps the light of its first attitude.
    const Eigen::Matrix3f R_WM = scenes::X_WM(mover.motion, 0.0).linear().cast<float>();
    geometry.mover_chunks.push_back(append(mover.mesh, R_WM, scene.lights, label, geometry));
  }
  return geometry;
}

}  // namespace hedgehop::sim
