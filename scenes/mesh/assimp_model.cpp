#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <Eigen/LU>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/model.h"
#include "scenes/mesh/mtl_file.h"

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

// Applies the scale and offset of an MTL image, whose v is upward.
void transform_uvs(const MtlMaterial& material, Part& part) {
  if (material.uv_scale == Eigen::Vector2f::Ones() && material.uv_offset == Eigen::Vector2f::Zero()) return;
  for (Eigen::Vector2f& uv : part.uvs) {
    const Eigen::Vector2f upward(uv.x(), 1.0f - uv.y());
    const Eigen::Vector2f moved = material.uv_scale.cwiseProduct(upward) + material.uv_offset;
    uv = {moved.x(), 1.0f - moved.y()};
  }
}

Model read_by_importer(const std::filesystem::path& file, std::string text, const ModelOrigin& origin) {
  const Eigen::Matrix3d level = level_axes(origin.z_is_up, false);
  const Vector3d& o = origin.east_north_up;
  Vector3d origin_W = level.transpose() * Vector3d(o.y(), o.x(), -o.z());
  Model model;
  ObjMaterials obj;
  const bool is_obj = suffix_of(file) == ".obj";
  if (is_obj) {
    obj = obj_materials(file, text);
    text = with_leading_zeros(text);
    if (!origin_W.isZero(0.0)) text = subtracted(text, std::exchange(origin_W, Vector3d::Zero()));
    model.unrendered = obj.unrendered;
  }
  Assimp::Importer importer;
  read_mesh(file, text, importer, &model.files);
  model.files.merge(obj.files);
  const aiScene* const scene =
      importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenNormals |
                                   aiProcess_PreTransformVertices | aiProcess_SortByPType | aiProcess_FlipUVs);
  if (!scene || !scene->mRootNode) throw std::invalid_argument(importer.GetErrorString());

  std::vector<const MtlMaterial*> mtl(scene->mNumMaterials, nullptr);
  std::vector<size_t> uv_sets(scene->mNumMaterials, 0);
  for (unsigned i = 0; i < scene->mNumMaterials; ++i) {
    const aiMaterial& read = *scene->mMaterials[i];
    const auto named = obj.by_name.find(std::string_view(read.GetName().C_Str()));
    if (named != obj.by_name.end()) mtl[i] = &named->second;
    model.materials.push_back(mtl[i] ? mtl[i]->look : material_of(*scene, read, file.parent_path(), model.unrendered));
    int uv_set = 0;
    if (!is_obj && read.Get(AI_MATKEY_UVWSRC_DIFFUSE(0), uv_set) == AI_SUCCESS && uv_set >= 0 &&
        uv_set < AI_MAX_NUMBER_OF_TEXTURECOORDS) {
      uv_sets[i] = static_cast<size_t>(uv_set);
    }
  }
  for (const aiMesh* mesh : std::span(scene->mMeshes, scene->mNumMeshes)) {
    Part part = part_of(*mesh, uv_sets[mesh->mMaterialIndex]);
    if (part.body.faces.empty()) {
      model.unrendered.insert("points and lines");
      continue;
    }
    if (!origin_W.isZero(0.0)) {
      for (Vector3d& corner : part.body.corners) corner -= origin_W;
    }
    if (mtl[part.material]) transform_uvs(*mtl[part.material], part);
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

namespace {

Model obj_looks(const std::filesystem::path& file, std::string_view text) {
  ObjMaterials obj = obj_materials(file, text);
  Model model;
  for (const auto& [name, material] : obj.by_name) model.materials.push_back(material.look);
  model.files = std::move(obj.files);
  model.files.insert(file.lexically_normal());
  return model;
}

/// Reads a file of an allowed form. @param origin  nullopt: the materials are sufficient.
Model read_file(const std::filesystem::path& file, const std::optional<ModelOrigin>& origin) {
  std::string text = require_importable(file);
  const std::string suffix = suffix_of(file);
  const ModelOrigin from = origin.value_or(ModelOrigin());
  try {
    if (suffix == ".obj" && !origin) return obj_looks(file, text);
    if (suffix != ".gltf" && suffix != ".glb") return read_by_importer(file, std::move(text), from);
    try {
      return origin ? read_gltf(file, from) : read_gltf_materials(file);
    } catch (const OldGltf& old) {
      if (old.nodes > kMaxOldNodes) throw;
      return read_by_importer(file, std::move(text), from);
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

}  // namespace hedgehop::scenes::mesh
