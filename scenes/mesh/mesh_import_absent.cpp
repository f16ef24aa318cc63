#include <stdexcept>

#include "scenes/mesh/mesh_import.h"
#include "scenes/mesh/model.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::mesh {

std::vector<std::string> add_imports(const std::vector<ImportConfig>& imports, const Eigen::Vector3d&, Scene&) {
  if (imports.empty()) return {};
  throw fields::InvalidField("imports",
                             "this build of Hedgehop cannot read meshes (see hedgehop --version --features)");
}

std::string importer_version() { return {}; }

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) { return {mesh}; }

}  // namespace hedgehop::scenes::mesh
