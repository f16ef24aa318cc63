#include "scenes/mesh/mesh_files.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "scenes/mesh/mesh_reader.h"

namespace hedgehop::scenes::mesh {

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) {
  std::set<std::filesystem::path> files;
  Assimp::Importer importer;
  const aiScene* model = nullptr;
  try {
    model = &read_mesh(mesh, importer, &files);
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("'" + mesh.string() + "': " + fault.what());
  }
  for (const aiMaterial* material : std::span(model->mMaterials, model->mNumMaterials)) {
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
      aiString name;
      if (material->GetTexture(type, 0, &name) != AI_SUCCESS || model->GetEmbeddedTexture(name.C_Str())) continue;
      files.insert((mesh.parent_path() / name.C_Str()).lexically_normal());
    }
  }
  return files;
}

}  // namespace hedgehop::scenes::mesh
