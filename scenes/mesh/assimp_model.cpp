#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <assimp/Importer.hpp>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;

constexpr size_t kMaxOldNodes = 2'000;  // of a glTF of version 1, which the importer reads recursively

Wrap wrap_of_mode(int mode) {
  if (mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal) return Wrap::clamp;
  return mode == aiTextureMapMode_Mirror ? Wrap::mirror : Wrap::repeat;
}

// Returns a material as the importer reads it.
Material material_of(const aiScene& scene, const aiMaterial& read, const std::filesystem::path& folder,
                     std::set<std::string>& unrendered) {
  Material material{.name = read.GetName().C_Str()};
  aiString path;
  if (read.GetTexture(aiTextureType_DIFFUSE, 0, &path) == AI_SUCCESS) {
    material.image = ImageSource{.name = path.C_Str(), .folders = {folder}, .is_uri = true};
    const aiTexture* const inside = scene.GetEmbeddedTexture(path.C_Str());
    if (inside && inside->mHeight == 0) {
      const std::span bytes(reinterpret_cast<const uint8_t*>(inside->pcData), inside->mWidth);
      material.image->bytes = std::make_shared<const std::vector<uint8_t>>(bytes.begin(), bytes.end());
    }
    int u = aiTextureMapMode_Wrap, v = aiTextureMapMode_Wrap;
    read.Get(AI_MATKEY_MAPPINGMODE_U_DIFFUSE(0), u);
    read.Get(AI_MATKEY_MAPPINGMODE_V_DIFFUSE(0), v);
    material.wrap = {wrap_of_mode(u), wrap_of_mode(v)};
  }
  aiColor4D color(0.7f, 0.7f, 0.7f, 1.0f);
  read.Get(AI_MATKEY_COLOR_DIFFUSE, color);
  material.color = {color.r, color.g, color.b};
  float opacity = 1.0f;
  if (read.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity < 1.0f)
    unrendered.insert("transparency of material '" + material.name + "'");
  return material;
}

// Returns the triangles of a mesh. Points and lines have none.
Part part_of(const aiMesh& mesh, size_t uv_set) {
  Part part;
  part.material = mesh.mMaterialIndex;
  part.body.corners.reserve(mesh.mNumVertices);
  part.normals.reserve(mesh.mNumVertices);
  part.body.faces.reserve(mesh.mNumFaces);
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& p = mesh.mVertices[i];
    part.body.corners.emplace_back(p.x, p.y, p.z);
    const aiVector3D n = mesh.HasNormals() ? mesh.mNormals[i] : aiVector3D();
    part.normals.emplace_back(n.x, n.y, n.z);
    if (mesh.HasTextureCoords(static_cast<unsigned>(uv_set))) {
      const aiVector3D& uv = mesh.mTextureCoords[uv_set][i];
      part.uvs.emplace_back(uv.x, uv.y);
    }
    if (mesh.HasVertexColors(0)) {
      const aiColor4D& color = mesh.mColors[0][i];
      part.colors.emplace_back(color.r, color.g, color.b);
    }
  }
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices == 3) part.body.faces.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  }
  return part;
}

// Reads a file with the importer. @param origin  nullopt: without its triangles.
Model read_by_importer(const std::filesystem::path& file, const std::string& text,
                       const std::optional<ModelOrigin>& origin) {
  Model model;
  Assimp::Importer importer;
  const aiScene* scene = &read_mesh(file, text, importer, &model.files);
  if (origin) {
    // Not aiProcess_JoinIdenticalVertices, which takes 17 s per million triangles.
    scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_GenNormals | aiProcess_PreTransformVertices |
                                         aiProcess_SortByPType | aiProcess_FlipUVs);
    if (!scene || !scene->mRootNode) throw std::invalid_argument(importer.GetErrorString());
  }

  std::vector<size_t> uv_sets(scene->mNumMaterials, 0);
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    const aiMaterial& read = *scene->mMaterials[i];
    model.materials.push_back(material_of(*scene, read, file.parent_path(), model.unrendered));
    int uv_set = 0;
    if (read.Get(AI_MATKEY_UVWSRC_DIFFUSE(0), uv_set) == AI_SUCCESS && uv_set >= 0 &&
        uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS) {
      uv_sets[i] = static_cast<size_t>(uv_set);
    }
  }
  if (!origin) return model;
  const Vector3d origin_of_model = origin_in_model(*origin, false);
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
    Part part = part_of(*mesh, uv_sets[mesh->mMaterialIndex]);
    if (part.body.faces.empty()) {
      model.unrendered.insert("points and lines");
      continue;
    }
    for (Vector3d& corner : part.body.corners) corner -= origin_of_model;
    model.parts.push_back(std::move(part));
  }
  return model;
}

}  // namespace

Eigen::Matrix3d level_axes(bool z_is_up, bool front_is_z) {
  Eigen::Matrix3d level;
  if (z_is_up) {
    level << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  } else if (front_is_z) {
    level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  } else {
    level << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  }
  return level;
}

Vector3d origin_in_model(const ModelOrigin& origin, bool front_is_z) {
  const Vector3d& o = origin.east_north_up;
  return level_axes(origin.z_is_up, front_is_z).transpose() * Vector3d(o.y(), o.x(), -o.z());
}

namespace {

/// Reads a file of an allowed form. @param origin  nullopt: the materials are sufficient.
Model read_file(const std::filesystem::path& file, const std::optional<ModelOrigin>& origin) {
  const std::string text = require_importable(file);
  const std::string suffix = suffix_of(file);
  try {
    if (suffix == ".obj") return origin ? read_obj(file, text, *origin) : read_obj_materials(file, text);
    if (suffix != ".gltf" && suffix != ".glb") return read_by_importer(file, text, origin);
    try {
      return origin ? read_gltf(file, *origin) : read_gltf_materials(file);
    } catch (const OldGltf& old) {
      if (old.nodes > kMaxOldNodes) throw;
      return read_by_importer(file, text, origin);
    }
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& fault) {
    throw std::invalid_argument("it is not valid: " + std::string(fault.what()));
  }
}

}  // namespace

Model read_model(const std::filesystem::path& file, const ModelOrigin& origin) { return read_file(file, origin); }

Model read_materials(const std::filesystem::path& file) { return read_file(file, std::nullopt); }

std::string importer_version() {
  return "assimp " + std::to_string(aiGetVersionMajor()) + "." + std::to_string(aiGetVersionMinor()) + "." +
         std::to_string(aiGetVersionPatch());
}

}  // namespace hedgehop::scenes::mesh
