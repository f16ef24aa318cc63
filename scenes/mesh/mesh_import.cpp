#include "scenes/mesh/mesh_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgproc.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/polyhedron.h"
#include "scenes/textures/stone_textures.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;

constexpr double kMaxCoordinateM = 100e3;  // as for every position in a scenario

[[noreturn]] void refuse(const ImportConfig& c, const std::string& why) {
  throw fields::InvalidField("imports.file", "'" + c.file + "': " + why);
}

void read_file(const ImportConfig& c, Assimp::Importer& importer) {
  try {
    read_mesh(c.file, importer);
  } catch (const std::invalid_argument& fault) {
    refuse(c, fault.what());
  }
}

// Returns the map from the model's frame to W. It turns the model's front to the heading and its up axis upward.
Eigen::Affine3d model_to_world(const ImportConfig& c) {
  Eigen::Matrix3d to_level;  // north, east, down from the model's axes
  if (c.up == ImportConfig::Up::y) {
    to_level << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  } else {
    to_level << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  }
  return Eigen::Translation3d(c.north_m, c.east_m, -c.altitude_m) *
         Eigen::AngleAxisd(c.heading_rad, Vector3d::UnitZ()) * Eigen::Affine3d(c.scale * to_level);
}

// Returns the contents of a file; empty if it is not a regular file or too large.
std::vector<uint8_t> bytes_of(const std::filesystem::path& file) {
  if (!may_be_read(file)) return {};
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Returns the image of a material, or its color; CV_8UC3 RGB.
cv::Mat material_image(const ImportConfig& c, const aiScene& model, const aiMaterial& material, int size_px) {
  aiString path;
  const bool has_image = material.GetTexture(aiTextureType_BASE_COLOR, 0, &path) == AI_SUCCESS ||
                         material.GetTexture(aiTextureType_DIFFUSE, 0, &path) == AI_SUCCESS;
  if (!has_image) {
    aiColor4D color(0.7f, 0.7f, 0.7f, 1.0f);
    if (material.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) material.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    return textures::paint_blank(size_px, {color.r, color.g, color.b});
  }
  cv::Mat image;
  if (const aiTexture* inside = model.GetEmbeddedTexture(path.C_Str()); inside && inside->mHeight == 0) {
    image = decode_texture({reinterpret_cast<const uint8_t*>(inside->pcData), inside->mWidth});
  } else {
    image = decode_texture(bytes_of(std::filesystem::path(c.file).parent_path() / path.C_Str()));
  }
  if (image.empty()) refuse(c, std::string("its image '") + path.C_Str() + "' cannot be read as PNG, JPEG or PPM");
  cv::resize(image, image, {size_px, size_px}, 0.0, 0.0, cv::INTER_AREA);
  return image;
}

// Returns the corners and faces of a mesh in W, without degenerate faces.
Polyhedron faces_W(const aiMesh& mesh, const Eigen::Affine3d& to_W) {
  Polyhedron result;
  for (const aiVector3D& p : std::span(mesh.mVertices, mesh.mNumVertices)) {
    result.corners.push_back(to_W * Vector3d(p.x, p.y, p.z));
  }
  for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) {
    if (face.mNumIndices != 3) continue;
    const auto [a, b, c] = std::array<uint32_t, 3>{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    const Vector3d across = (result.corners[b] - result.corners[a]).cross(result.corners[c] - result.corners[a]);
    if (across.allFinite() && across.norm() > 0.0) result.faces.push_back({a, b, c});
  }
  return result;
}

// Returns a value above 0 if the normals point to the front side of the faces.
float facing(const std::vector<Vertex>& vertices, const std::vector<std::array<uint32_t, 3>>& faces) {
  float sum = 0.0f;
  for (const auto& [a, b, c] : faces) {
    const Eigen::Vector3f across = (vertices[b].p_W - vertices[a].p_W).cross(vertices[c].p_W - vertices[a].p_W);
    sum += across.dot(vertices[a].n_W + vertices[b].n_W + vertices[c].n_W);
  }
  return sum;
}

void turn_over(std::vector<std::array<uint32_t, 3>>& faces) {
  for (auto& face : faces) std::swap(face[0], face[1]);
}

// Adds one mesh of the file to the current chunk, facing outward; an open surface is added with both orientations.
void draw(const aiMesh& mesh, const Polyhedron& body, const Eigen::Affine3d& to_W, uint32_t texture,
          MeshBuilder& builder) {
  std::vector<Vertex> vertices(body.corners.size());
  for (size_t k = 0; k < vertices.size(); ++k) {
    const aiVector3D& n = mesh.mNormals[k];
    vertices[k].p_W = body.corners[k].cast<float>();
    vertices[k].n_W = (to_W.linear() * Vector3d(n.x, n.y, n.z)).normalized().cast<float>();
    if (mesh.HasTextureCoords(0)) vertices[k].uv = {mesh.mTextureCoords[0][k].x, mesh.mTextureCoords[0][k].y};
    vertices[k].texture = texture;
  }
  const Facing sides = facing_of(body);
  std::vector<std::array<uint32_t, 3>> faces = body.faces;
  if (sides == Facing::inward) turn_over(faces);
  const bool normals_agree = facing(vertices, faces) >= 0.0f;
  const auto turn_normals = [&] {
    for (Vertex& vertex : vertices) vertex.n_W = -vertex.n_W;
  };
  if (!normals_agree) turn_normals();
  builder.add(vertices, faces);
  if (sides != Facing::open) return;
  turn_over(faces);
  turn_normals();
  builder.add(vertices, faces);
}

void add_import(const ImportConfig& c, Scene& scene) {
  Assimp::Importer importer;
  read_file(c, importer);
  const aiScene* const model =
      importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenNormals |
                                   aiProcess_PreTransformVertices | aiProcess_SortByPType | aiProcess_FlipUVs);
  if (!model || !model->mRootNode) refuse(c, importer.GetErrorString());

  const int size_px = scene.textures.size_px();
  const Eigen::Affine3d to_W = model_to_world(c);
  std::vector<int> images(model->mNumMaterials, -1);
  MeshBuilder builder("opaque");
  builder.begin_instance(c.name, c.kind);
  size_t triangles = 0;
  for (const aiMesh* mesh : std::span(model->mMeshes, model->mNumMeshes)) {
    const Polyhedron body = faces_W(*mesh, to_W);
    if (body.faces.empty()) continue;
    triangles += body.faces.size();
    for (const Vector3d& corner : body.corners) {
      if (!corner.allFinite()) refuse(c, "it has corners that are not finite");
      if (corner.cwiseAbs().maxCoeff() > kMaxCoordinateM)
        refuse(c, "it has corners farther than 100 km from the origin");
    }
    int& image = images[mesh->mMaterialIndex];
    if (image < 0) {
      // Read now, because a missing image must not end a flight that has begun.
      const cv::Mat texture = material_image(c, *model, *model->mMaterials[mesh->mMaterialIndex], size_px);
      image = static_cast<int>(scene.textures.add([texture] { return texture; }));
    }
    builder.begin_chunk(false);
    draw(*mesh, body, to_W, static_cast<uint32_t>(image), builder);
    if (c.collide == ImportConfig::Collide::surface) {
      Solid solid;
      solid.name = c.name;
      solid.shape = Solid::Shape::surface;
      solid.polyhedron = body;
      scene.solids.push_back(solid);
    }
  }
  if (triangles == 0) refuse(c, "it has no triangles");
  scene.meshes.push_back(builder.finish());
}

}  // namespace

void add_imports(const std::vector<ImportConfig>& imports, Scene& scene) {
  for (size_t k = 0; k < imports.size(); ++k) {
    fields::require_bounds(imports[k], "imports." + std::to_string(k));
    add_import(imports[k], scene);
  }
}

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
