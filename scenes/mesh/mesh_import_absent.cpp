#include <stdexcept>

#include "scenes/mesh/mesh_import.h"

namespace hedgehop::scenes::mesh {

void add_imports(const std::vector<ImportConfig>& imports, Scene&) {
  if (imports.empty()) return;
  throw std::invalid_argument("imports: this build of Hedgehop reads no meshes (hedgehop --version --features)");
}

}  // namespace hedgehop::scenes::mesh
