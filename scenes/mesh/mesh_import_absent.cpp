#include <stdexcept>

#include "scenes/mesh/mesh_import.h"

namespace hedgehop::scenes::mesh {

void add_imports(const std::vector<ImportConfig>& imports, Scene&) {
  if (imports.empty()) return;
  throw std::invalid_argument("imports: this build of Hedgehop cannot read meshes (see hedgehop --version --features)");
}

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) { return {mesh}; }

}  // namespace hedgehop::scenes::mesh
