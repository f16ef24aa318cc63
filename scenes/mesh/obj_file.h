#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/mesh/mtl_file.h"

namespace hedgehop::scenes::mesh {

inline constexpr int32_t kNoIndex = -1;

/// A corner of a face: indices from 0; kNoIndex without image coordinates or without a normal.
struct ObjCorner {
  int32_t position = kNoIndex, uv = kNoIndex, normal = kNoIndex;
  bool operator==(const ObjCorner&) const = default;
};

/// A face. @param material  index into ObjFile::materials.
struct ObjFace {
  uint32_t material, corner_count;
};

/// The contents of an OBJ file.
struct ObjFile {
  std::vector<Eigen::Vector3d> positions;  ///< minus the origin, in units of the file
  std::vector<Eigen::Vector3f> colors;     ///< one per position, NaN without a color; empty without colors
  std::vector<Eigen::Vector2f> uvs;        ///< v upward
  std::vector<Eigen::Vector3f> normals;
  std::vector<ObjCorner> corners;      ///< of the faces, in their order; each index is in range
  std::vector<ObjFace> faces;          ///< of three corners or more
  std::vector<std::string> materials;  ///< names; the first one is empty, for faces without a material
  ObjMaterials library;                ///< the materials of the files that it names
  bool has_points_or_lines = false;
};

/// Returns the contents of an OBJ file. Indices may be negative and may refer to lines below. Weights of positions,
/// smoothing groups, groups, curves, and indices of normals in a file without normals have no effect.
/// @param text  in UTF-8 without a mark. @param folder  of the file, for its material files.
/// @param origin  subtracted from positions in double precision, in the axes of the file.
/// @throws std::invalid_argument with the line or the reason: a word that is no number, an index out of range, a face
/// of more than 1,000 corners, more than kMaxTriangles triangles, more than 3 kMaxTriangles positions, normals or image
/// coordinates; or as read_material_files().
ObjFile read_obj_file(std::string_view text, const std::filesystem::path& folder, const Eigen::Vector3d& origin);

}  // namespace hedgehop::scenes::mesh
