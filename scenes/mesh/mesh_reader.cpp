#include "scenes/mesh/mesh_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace hedgehop::scenes::mesh {

namespace {

constexpr uintmax_t kMaxBytes = 64'000'000;
constexpr int kMaxNesting = 200;  // the importer's JSON reader recurses
constexpr size_t kMaxNodes = 2'000;
constexpr size_t kMaxFaces = 500'000;

/// Recursion depth that a glTF causes in the importer.
struct JsonNesting {
  int brackets = 0;  ///< nested, outside strings
  size_t nodes = 0;  ///< each may be the parent of the next
};

JsonNesting json_nesting(std::string_view json) {
  JsonNesting found;
  int now = 0;
  size_t text = 0;
  bool in_text = false, in_nodes = false;
  std::string_view key;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
      if (in_text) text = i + 1;
      if (!in_text && now == 1) key = json.substr(text, i - text);
    } else if (!in_text && (c == '[' || c == '{')) {
      found.brackets = std::max(found.brackets, ++now);
      if (now == 2) in_nodes = key == "nodes" || key.find('\\') != std::string_view::npos;
      if (now == 3 && in_nodes) ++found.nodes;
    } else if (!in_text && (c == ']' || c == '}')) {
      --now;
    }
  }
  return found;
}

/// Returns the JSON of a binary glTF: its first chunk, after the file's header of 12 bytes and the chunk's of 8.
std::string_view json_of_glb(std::string_view file) {
  constexpr size_t kHeader = 20;
  if (file.size() < kHeader) return {};
  uint32_t bytes = 0;
  std::copy_n(file.data() + 12, sizeof bytes, reinterpret_cast<char*>(&bytes));
  return file.substr(kHeader, bytes);
}

/// Returns the number of faces: lines that begin with `f`. Their memory in the importer far exceeds their size in the
/// file.
size_t faces(std::string_view obj) {
  size_t count = 0;
  bool at_start = true;
  for (const char c : obj) {
    if (at_start && c == 'f') ++count;
    at_start = c == '\n' || (at_start && (c == ' ' || c == '\t'));
  }
  return count;
}

}  // namespace

bool may_be_read(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMaxBytes;
}

void require_importable(const std::filesystem::path& mesh) {
  std::error_code error;
  if (!std::filesystem::exists(mesh, error)) throw std::invalid_argument("there is no such file");
  if (!std::filesystem::is_regular_file(mesh, error)) throw std::invalid_argument("it is not a regular file");
  if (!may_be_read(mesh)) throw std::invalid_argument("it is larger than 64 MB");
  std::string kind = mesh.extension().string();
  std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (kind != ".obj" && kind != ".gltf" && kind != ".glb") {
    throw std::invalid_argument("its suffix is not .obj, .gltf or .glb");
  }
  std::ifstream stream(mesh, std::ios::binary);
  std::string text(std::filesystem::file_size(mesh, error), '\0');
  stream.read(text.data(), std::ssize(text));
  text.resize(static_cast<size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw std::invalid_argument("it cannot be read");
  if (kind != ".obj") {
    const JsonNesting found = json_nesting(kind == ".glb" ? json_of_glb(text) : text);
    if (found.brackets > kMaxNesting) {
      throw std::invalid_argument("its JSON is nested deeper than " + std::to_string(kMaxNesting));
    }
    if (found.nodes > kMaxNodes)
      throw std::invalid_argument("it has more than " + std::to_string(kMaxNodes) + " nodes");
  }
  if (kind == ".obj" && faces(text) > kMaxFaces) {
    throw std::invalid_argument("it has more than " + std::to_string(kMaxFaces) + " faces");
  }
}

namespace {

constexpr unsigned kMaxFaceCorners = 1000;

/// Opens regular files only. The mesh names its materials and buffers, which could be pipes or devices.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit GuardedFiles(std::set<std::filesystem::path>* opened) : opened_(opened) {}

  bool Exists(const char* file) const override {  // assimp's version opens the file
    std::error_code error;
    return std::filesystem::exists(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (Exists(file) && !may_be_read(file)) {
      throw std::invalid_argument(std::string("its file '") + file + "' is not a regular file of at most 64 MB");
    }
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    if (stream && opened_) opened_->insert(std::filesystem::path(file).lexically_normal());
    return stream;
  }

 private:
  std::set<std::filesystem::path>* opened_;
};

/// Removes all loaders except OBJ and glTF. Otherwise the importer tries some forty untested formats by content.
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

/// Throws if the model has too many triangles. A mesh counts once per node that uses it.
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
