#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

/// A material of an MTL file. A coordinate of its image is scale x coordinate of the OBJ + offset, v upward.
struct MtlMaterial {
  Material look;
  Eigen::Vector2f uv_scale = Eigen::Vector2f::Ones(), uv_offset = Eigen::Vector2f::Zero();
};

/// The materials that an OBJ file uses.
struct ObjMaterials {
  std::map<std::string, MtlMaterial, std::less<>> by_name;
  std::set<std::filesystem::path> files;
  std::set<std::string> unrendered;  ///< features that are not rendered
};

/// Returns the materials of an OBJ file. @param text  its contents.
/// Throws std::invalid_argument if a material file is missing, or they lack a material that a face uses.
ObjMaterials obj_materials(const std::filesystem::path& obj, std::string_view text);

/// Returns the text of an OBJ file whose coordinates have a digit before the point: the importer does not count ".5".
std::string with_leading_zeros(std::string_view obj);

/// Returns the text of an OBJ file with a position subtracted from its vertices, in double precision.
std::string subtracted(std::string_view obj, const Eigen::Vector3d& origin);

}  // namespace hedgehop::scenes::mesh
