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

/// The materials of an OBJ file.
struct ObjMaterials {
  std::map<std::string, MtlMaterial, std::less<>> by_name;
  std::set<std::filesystem::path> files;
  std::string names;                 ///< of the files, as the OBJ names them, for messages
  std::set<std::string> unrendered;  ///< features that are not rendered

  /// Returns a material; a grey one for faces without a material, with an empty name, "None" or "(null)".
  /// @throws std::invalid_argument if the files lack it.
  MtlMaterial find(const std::string& name) const;
};

/// Reads the material files that a statement of an OBJ names: one name with spaces, or several.
/// @param folder  of the OBJ.
/// @throws std::invalid_argument if one is missing or is not a regular file of at most 256 MB.
void read_material_files(std::string_view names, const std::filesystem::path& folder, ObjMaterials& found);

}  // namespace hedgehop::scenes::mesh
