#include "scenes/mesh/mesh_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "scenes/mesh/mesh_guard.h"

namespace hedgehop::scenes::mesh {
namespace {

constexpr unsigned kMaxFaceCorners = 1000;

/// Opens what may be read: materials and buffers are named in the files before them, and may be pipes or devices.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit GuardedFiles(std::set<std::filesystem::path>* opened) : opened_(opened) {}

  bool Exists(const char* file) const override {  // assimp's opens it to see
    std::error_code error;
    return std::filesystem::exists(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (Exists(file) && !may_be_read(file)) {
      throw std::invalid_argument(std::string("its file '") + file + "' is no regular one, or larger than 64 MB");
    }
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    if (stream && opened_) opened_->insert(std::filesystem::path(file).lexically_normal());
    return stream;
  }

 private:
  std::set<std::filesystem::path>* opened_;
};

/// What is none of ours is otherwise read by whatever it looks like, forty formats that nobody has tried.
void forget_other_formats(Assimp::Importer& importer) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const loader = importer.GetImporter(i);
    const std::string_view endings = loader->GetInfo()->mFileExtensions;
    if (endings == "obj" || endings == "gltf glb") continue;
    importer.UnregisterLoader(loader);
    delete loader;
  }
}

size_t triangles_of(const aiMesh& mesh) {
  size_t triangles = 0;
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices > kMaxFaceCorners) {
      throw std::invalid_argument("it has a face of more than " + std::to_string(kMaxFaceCorners) + " corners");
    }
    triangles += face.mNumIndices > 2 ? face.mNumIndices - 2 : 0;
  }
  return triangles;
}

/// A mesh counts as often as nodes hold it.
void require_bounded(const aiScene& model) {
  std::vector<size_t> triangles;
  for (const aiMesh* mesh : std::span(model.mMeshes, model.mNumMeshes)) triangles.push_back(triangles_of(*mesh));
  size_t all = 0;
  std::vector<const aiNode*> open = {model.mRootNode};
  while (!open.empty()) {
    const aiNode& node = *open.back();
    open.pop_back();
    for (const unsigned mesh : std::span(node.mMeshes, node.mNumMeshes)) all += triangles.at(mesh);
    open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
    if (all > kMaxTriangles) {
      throw std::invalid_argument("it has more than " + std::to_string(kMaxTriangles) + " triangles");
    }
  }
}

}  // namespace

const aiScene& read_mesh(const std::filesystem::path& mesh, Assimp::Importer& importer,
                         std::set<std::filesystem::path>* opened) {
  require_importable(mesh);
  forget_other_formats(importer);
  importer.SetIOHandler(new GuardedFiles(opened));  // the importer deletes it
  const aiScene* const model = importer.ReadFile(mesh.string(), aiProcess_ValidateDataStructure);
  if (!model || !model->mRootNode || (model->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    throw std::invalid_argument(importer.GetErrorString());
  }
  require_bounded(*model);
  return *model;
}

}  // namespace hedgehop::scenes::mesh
