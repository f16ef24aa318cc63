#include "scenes/mesh/mesh_files.h"

#include "scenes/mesh/mesh_guard.h"

#include <assimp/scene.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <span>
#include <stdexcept>
#include <string>

namespace hedgehop::scenes::mesh {
namespace {

/// Notes which files the importer opens: materials and buffers are named in the files before them.
class NotingFiles : public Assimp::DefaultIOSystem {
 public:
  explicit NotingFiles(std::set<std::filesystem::path>& files) : files_(files) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    if (stream) files_.insert(std::filesystem::path(file).lexically_normal());
    return stream;
  }

 private:
  std::set<std::filesystem::path>& files_;
};

}  // namespace

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) {
  try {
    require_importable(mesh);
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("'" + mesh.string() + "': " + fault.what());
  }
  std::set<std::filesystem::path> files;
  Assimp::Importer importer;
  importer.SetIOHandler(new NotingFiles(files));  // the importer deletes it
  const aiScene* const model = importer.ReadFile(mesh.string(), 0);
  if (!model) throw std::invalid_argument("'" + mesh.string() + "': " + importer.GetErrorString());
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
