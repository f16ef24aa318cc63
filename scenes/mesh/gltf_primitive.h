#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/mesh/gltf_file.h"
#include "scenes/mesh/gltf_material.h"

namespace hedgehop::scenes::mesh {

/// Triangles of one material in the frame of their mesh. Lists of corners have one element per corner.
struct GltfPrimitive {
  size_t material = 0;
  std::vector<Eigen::Vector3d> corners, normals;
  std::vector<Eigen::Vector2f> uvs;
  std::vector<Eigen::Vector3f> colors;  ///< sRGB, 0..1
  std::vector<std::array<uint32_t, 3>> faces;
};

/// The number of corners and faces of a primitive.
struct GltfSize {
  size_t corners = 0, faces = 0;
};

/// Returns the size of the result of read_gltf_primitive(), from the counts of the accessors: without reading them.
/// @throws as read_gltf_primitive().
GltfSize gltf_size(const GltfFile& file, const GltfFile::Json& json);

/// Returns a primitive of a glTF file: a list, strip or fan of triangles. Without normals, its faces are flat.
/// @param json  the element of the list `primitives` of a mesh.
/// @param materials  of the file, and last the default one.
/// @param unrendered  receives features that are not rendered.
/// @return nullopt for points, lines, and a primitive without positions.
/// @throws std::invalid_argument or nlohmann's exceptions for a bad file.
std::optional<GltfPrimitive> read_gltf_primitive(const GltfFile& file, const GltfFile::Json& json,
                                                 const std::vector<GltfMaterial>& materials,
                                                 std::set<std::string>& unrendered);

}  // namespace hedgehop::scenes::mesh
