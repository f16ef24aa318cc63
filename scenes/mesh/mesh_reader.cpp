#include "scenes/mesh/mesh_reader.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "scenes/mesh/dae_check.h"
#include "scenes/mesh/ply_check.h"
#include "sim/fields/file_fault.h"
#include "sim/fields/utf8_mark.h"

namespace hedgehop::scenes::mesh {

namespace {

constexpr uintmax_t kMaxBytes = 256'000'000;
constexpr std::array<std::string_view, 6> kSuffixes{".obj", ".gltf", ".glb", ".dae", ".ply", ".stl"};

/// Returns the depth of nested brackets outside strings.
int json_nesting(std::string_view json) {
  int now = 0, deepest = 0;
  bool in_text = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_text && c == '\\') {
      ++i;
    } else if (c == '"') {
      in_text = !in_text;
    } else if (!in_text && (c == '[' || c == '{')) {
      deepest = std::max(deepest, ++now);
    } else if (!in_text && (c == ']' || c == '}')) {
      --now;
    }
  }
  return deepest;
}

uint32_t number_at(std::string_view file, size_t at) {
  uint32_t number = 0;
  std::copy_n(file.data() + at, sizeof number, reinterpret_cast<char*>(&number));
  return number;
}

/// Returns the JSON of a binary glTF: its first chunk, after the file's header of 12 bytes and the chunk's of 8.
std::string_view json_of_glb(std::string_view file) {
  constexpr size_t kHeader = 20;
  if (file.size() < kHeader) return {};
  return file.substr(kHeader, number_at(file, 12));
}

bool is_old_binary(std::string_view glb) {
  return glb.starts_with("glTF") && glb.size() >= 8 && number_at(glb, 4) == 1;  // the version is the second word
}

/// Returns whether a binary glTF has the bytes that it announces: a header of 12 bytes, then chunks, each with a length
/// and a type before its bytes.
bool has_chunks(std::string_view glb) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  if (!glb.starts_with("glTF") || glb.size() < kHeader + kChunkHeader) return false;
  if (number_at(glb, 8) > glb.size()) return false;
  for (size_t at = kHeader; at < number_at(glb, 8);) {
    if (glb.size() - at < kChunkHeader || number_at(glb, at) > glb.size() - at - kChunkHeader) return false;
    at += kChunkHeader + number_at(glb, at);
  }
  return true;
}

}  // namespace

bool may_be_read(const std::filesystem::path& file) {
  std::error_code error;
  return std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMaxBytes;
}

std::string suffix_of(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::ranges::transform(suffix, suffix.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

std::string require_importable(const std::filesystem::path& mesh) {
  const auto refuse_if = [](bool fault, const std::string& why) {
    if (fault) throw std::invalid_argument(why);
  };
  std::error_code error;
  const std::string fault = file_fault(mesh);
  refuse_if(!fault.empty(), fault);
  refuse_if(!may_be_read(mesh), "it is larger than 256 MB");
  const std::string suffix = suffix_of(mesh);
  refuse_if(
      std::ranges::find(kSuffixes, suffix) == kSuffixes.end(),
      "its suffix '" + suffix + "' is unknown; valid: .obj, .gltf, .glb, .dae, .ply, .stl; of a world: .sdf, .world");
  std::ifstream stream(mesh, std::ios::binary);
  std::string text(std::filesystem::file_size(mesh, error), '\0');
  stream.read(text.data(), std::ssize(text));
  text.resize(static_cast<size_t>(stream.gcount()));
  refuse_if(!stream.is_open() || stream.bad(), "it cannot be read");
  const bool is_gltf = suffix == ".gltf" || suffix == ".glb";
  const bool is_utf16 = text.starts_with("\xfe\xff") || text.starts_with("\xff\xfe");
  refuse_if((suffix == ".obj" || is_gltf) && is_utf16, "it is text in UTF-16; valid: UTF-8");
  refuse_if(is_gltf && is_old_binary(text), "it is a binary glTF of version 1; valid: version 2");
  refuse_if(suffix == ".glb" && !has_chunks(text), "it is no binary glTF 2, or is shorter than its chunks");
  if (is_gltf) {
    const bool is_binary = text.starts_with("glTF");
    refuse_if(json_nesting(is_binary ? json_of_glb(text) : text) > kMaxNesting,
              "its JSON is nested deeper than " + std::to_string(kMaxNesting));
  }
  const std::string dae_fault = suffix == ".dae" ? fault_of_dae(text) : "";
  refuse_if(!dae_fault.empty(), dae_fault);
  const std::string ply_fault = suffix == ".ply" ? fault_of_ply(text) : "";
  refuse_if(!ply_fault.empty(), ply_fault);
  return suffix == ".obj" ? std::string(without_utf8_mark(text)) : text;
}

namespace {

/// Opens regular files only. The mesh names its materials and buffers, which could be pipes or devices.
class GuardedFiles : public Assimp::DefaultIOSystem {
 public:
  GuardedFiles(std::string mesh, const std::string& text, std::set<std::filesystem::path>* opened)
      : mesh_(std::move(mesh)), text_(text), opened_(opened) {}

  bool Exists(const char* file) const override {  // assimp's version opens the file
    std::error_code error;
    return std::filesystem::exists(file, error);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (Exists(file) && !may_be_read(file)) {
      throw std::invalid_argument(std::string("its file '") + file + "' is not a regular file of at most 256 MB");
    }
    const auto* const bytes = reinterpret_cast<const uint8_t*>(text_.data());
    Assimp::IOStream* const stream =
        file == mesh_ ? new Assimp::MemoryIOStream(bytes, text_.size()) : DefaultIOSystem::Open(file, mode);
    if (stream && opened_) opened_->insert(std::filesystem::path(file).lexically_normal());
    return stream;
  }

 private:
  std::string mesh_;  ///< its contents are `text_`
  const std::string& text_;
  std::set<std::filesystem::path>* opened_;
};

/// Removes all loaders except those of the file's suffix. Otherwise the importer tries some forty by content.
void forget_other_formats(Assimp::Importer& importer, const std::string& suffix) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    Assimp::BaseImporter* const loader = importer.GetImporter(i);
    std::istringstream endings(loader->GetInfo()->mFileExtensions);
    const std::set<std::string> all{std::istream_iterator<std::string>(endings), {}};
    if (all.contains(suffix.substr(1))) continue;
    importer.UnregisterLoader(loader);
    delete loader;
  }
}

size_t triangles_of(const aiMesh& mesh) {
  size_t triangles = 0;
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices == 0) throw std::invalid_argument("it has a face without corners");  // ends the importer
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

/// Returns the importer's message, in plain words for files without faces.
std::string cause_of(const std::string& message) {
  for (const char* no_faces :
       {"aiScene::mNumMeshes is 0", "contains no faces", "contains no vertices", "is a POINT", "file is empty",
        "file is too small", "File came out empty", "Unable to extract mesh data"}) {
    if (message.find(no_faces) != std::string::npos) return "it has no triangles";
  }
  return message;
}

}  // namespace

const aiScene& read_mesh(const std::filesystem::path& mesh, const std::string& text, Assimp::Importer& importer,
                         std::set<std::filesystem::path>* opened) {
  forget_other_formats(importer, suffix_of(mesh));
  importer.SetIOHandler(new GuardedFiles(mesh.string(), text, opened));  // the importer deletes it
  const aiScene* const model = importer.ReadFile(mesh.string(), aiProcess_ValidateDataStructure);
  if (!model || !model->mRootNode || (model->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) {
    throw std::invalid_argument(cause_of(importer.GetErrorString()));
  }
  require_bounded(*model);
  return *model;
}

}  // namespace hedgehop::scenes::mesh
