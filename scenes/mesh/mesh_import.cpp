#include "scenes/mesh/mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "scenes/mesh/cut.h"
#include "scenes/mesh/image_file.h"
#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/model.h"
#include "scenes/mesh/orientation.h"
#include "scenes/mesh/polyhedron.h"
#include "scenes/mesh/vertex_colors.h"
#include "sim/fields/bounds.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

constexpr double kMaxCoordinateM = 100e3;  // as for every position in a scenario
constexpr float kMaxRepeats = 1e6f;        // of an image; floats resolve no more

[[noreturn]] void refuse(const ImportConfig& c, const std::string& why) {
  throw fields::InvalidField("imports.file", "'" + c.file + "': " + why);
}

Model model_of(const ImportConfig& c) {
  try {
    return read_model(c.file, {c.origin_ENU, c.up == ImportConfig::Up::z});
  } catch (const std::invalid_argument& fault) {
    refuse(c, fault.what());
  }
}

// Returns the map from the model's frame to W. It turns the model's front to the heading and its up axis upward.
Eigen::Affine3d model_to_world(const ImportConfig& c, bool front_is_z) {
  return Eigen::Translation3d(c.north_m, c.east_m, -c.altitude_m) *
         Eigen::AngleAxisd(c.heading_rad, Vector3d::UnitZ()) *
         Eigen::Affine3d(c.scale * level_axes(c.up == ImportConfig::Up::z, front_is_z));
}

// Returns the corners and faces of a part in W, without degenerate faces.
Polyhedron faces_W(const Polyhedron& body, const Eigen::Affine3d& to_W) {
  Polyhedron result;
  for (const Vector3d& corner : body.corners) result.corners.push_back(to_W * corner);
  for (const auto& [a, b, c] : body.faces) {
    const Vector3d across = (result.corners[b] - result.corners[a]).cross(result.corners[c] - result.corners[a]);
    if (across.allFinite() && across.norm() > 0.0) result.faces.push_back({a, b, c});
  }
  return result;
}

// Turns the normals that point to the back of their faces, and replaces those that are not finite.
void correct_normals(Triangles& triangles) {
  std::vector<Eigen::Vector3f> across(triangles.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& [a, b, c] : triangles.faces) {
    const Eigen::Vector3f& p_W = triangles.vertices[a].p_W;
    const Eigen::Vector3f normal = (triangles.vertices[b].p_W - p_W).cross(triangles.vertices[c].p_W - p_W);
    for (const uint32_t corner : {a, b, c}) across[corner] += normal;
  }
  for (size_t k = 0; k < across.size(); ++k) {
    Eigen::Vector3f& normal = triangles.vertices[k].n_W;
    if (!normal.allFinite() || normal.isZero()) normal = across[k].normalized();
    if (!normal.allFinite() || normal.isZero()) normal = -Eigen::Vector3f::UnitZ();
    if (across[k].dot(normal) < 0.0f) normal = -normal;
  }
}

// Returns the triangles of a part, counter-clockwise seen from their front. Open surfaces of formats without a front
// are visible from both sides.
Triangles triangles_of(const Part& part, const Polyhedron& body, const Eigen::Affine3d& to_W, const Model& model) {
  Triangles result;
  result.vertices.resize(body.corners.size());
  for (size_t k = 0; k < result.vertices.size(); ++k) {
    Vertex& vertex = result.vertices[k];
    vertex.p_W = body.corners[k].cast<float>();
    vertex.n_W = (to_W.linear() * part.normals[k]).normalized().cast<float>();
    if (!part.uvs.empty()) vertex.uv = part.uvs[k];
    if (!(vertex.uv.cwiseAbs().maxCoeff() < kMaxRepeats)) vertex.uv.setZero();
  }
  result.faces = body.faces;
  if (model.winding_is_front) {
    result.is_two_sided.assign(result.faces.size(), !model.materials[part.material].is_single_sided);
  } else {
    const std::vector<Facing> facing = facing_of_faces(body);
    for (size_t f = 0; f < result.faces.size(); ++f) {
      if (facing[f] == Facing::inward) std::swap(result.faces[f][0], result.faces[f][1]);
      result.is_two_sided.push_back(facing[f] == Facing::open);
    }
  }
  correct_normals(result);
  return result;
}

// Adds triangles to the current chunk; those with two sides also from behind.
void draw(const Triangles& triangles, MeshBuilder& builder) {
  builder.add(triangles.vertices, triangles.faces);
  std::vector<Face> behind;
  for (size_t f = 0; f < triangles.faces.size(); ++f) {
    const auto& [a, b, c] = triangles.faces[f];
    if (triangles.is_two_sided[f]) behind.push_back({b, a, c});
  }
  if (behind.empty()) return;
  std::vector<Vertex> vertices = triangles.vertices;
  for (Vertex& vertex : vertices) vertex.n_W = -vertex.n_W;
  builder.add(vertices, behind);
}

Polyhedron polyhedron_of(const Triangles& triangles) {
  Polyhedron result;
  for (const Vertex& vertex : triangles.vertices) result.corners.push_back(vertex.p_W.cast<double>());
  result.faces = triangles.faces;
  return result;
}

// Adds the parts of a file to a scene.
class Import {
 public:
  Import(const ImportConfig& config, Scene& scene)
      : c_(config),
        scene_(scene),
        model_(model_of(config)),
        to_W_(model_to_world(config, model_.front_is_z)),
        textures_(model_.materials.size()) {
    builder_.begin_instance(config.name, config.kind);
  }

  // Returns the features that are not rendered and the images that are reduced, in one line; empty without them.
  std::string add() {
    for (const Part& part : model_.parts) add(part);
    if (triangles_ == 0) refuse(c_, "it has no triangles");
    scene_.meshes.push_back(builder_.finish());
    std::string line;
    for (const std::string& feature : model_.unrendered) line += (line.empty() ? "not rendered: " : ", ") + feature;
    for (const std::string& change : changes_) line += (line.empty() ? "" : "; ") + change;
    return line.empty() ? line : "'" + c_.file + "': " + line;
  }

 private:
  struct Texture {
    uint32_t index;
    MaterialImage image;
  };

  const Texture& texture_of(size_t index) {
    std::optional<Texture>& texture = textures_[index];
    if (texture) return *texture;
    // Read now, because a missing image must not end a flight that has begun.
    try {
      MaterialImage image = material_image(model_.materials[index], scene_.textures.size_px(), changes_);
      const uint32_t added = scene_.textures.add([rgb = image.rgb] { return rgb; });
      texture = Texture{added, std::move(image)};
    } catch (const std::exception& fault) {
      refuse(c_, fault.what());
    }
    return *texture;
  }

  void add(const Part& part) {
    Polyhedron body = faces_W(part.body, to_W_);
    if (body.faces.empty()) return;
    triangles_ += body.faces.size();
    for (const Vector3d& corner : body.corners) {
      if (!corner.allFinite()) refuse(c_, "it has corners that are not finite");
      if (corner.cwiseAbs().maxCoeff() > kMaxCoordinateM)
        refuse(c_, "it has corners farther than 100 km from the origin; 'origin' can be subtracted");
    }
    Triangles triangles = triangles_of(part, body, to_W_, model_);
    if (cover(part, triangles)) body = polyhedron_of(triangles);
    if (triangles.faces.empty()) return;
    builder_.begin_chunk(false);
    draw(triangles, builder_);
    if (c_.collide == ImportConfig::Collide::none) return;
    Solid solid;
    solid.name = c_.name;
    solid.shape = Solid::Shape::surface;
    solid.polyhedron = std::move(body);
    scene_.solids.push_back(std::move(solid));
  }

  // Gives triangles their texture. Returns whether they were cut.
  bool cover(const Part& part, Triangles& triangles) {
    const Material& material = model_.materials[part.material];
    const bool has_colors =
        std::ranges::any_of(part.colors, [&](const auto& color) { return color != material.color; });
    if (has_colors && !material.image) {
      triangles = colored(triangles, part.colors, scene_);
      return false;
    }
    if (has_colors && !model_.winding_is_front) model_.unrendered.insert("vertex colors on an image");
    const Texture& texture = texture_of(part.material);
    const float cutoff = material.alpha_cutoff.value_or(0.0f);
    for (Vertex& vertex : triangles.vertices) {
      vertex.texture = texture.index;
      vertex.uv = vertex.uv.cwiseQuotient(texture.image.repeat);
    }
    for (int axis = 0; axis < 2; ++axis) {
      if (material.wrap[static_cast<size_t>(axis)] != Wrap::clamp) continue;
      triangles = clamped(triangles, axis, scene_.textures.size_px());
    }
    if (!material.alpha_cutoff || (texture.image.opacity.empty() && cutoff <= 1.0f)) return false;
    triangles = cutoff > 1.0f ? Triangles() : without_holes(triangles, texture.image.opacity, cutoff);
    return true;
  }

  const ImportConfig& c_;
  Scene& scene_;
  Model model_;
  Eigen::Affine3d to_W_;
  std::vector<std::optional<Texture>> textures_;
  MeshBuilder builder_{"opaque"};
  std::set<std::string> changes_;
  size_t triangles_ = 0;
};

}  // namespace

std::vector<std::string> add_imports(const std::vector<ImportConfig>& imports, Scene& scene) {
  std::vector<std::string> lines;
  for (size_t k = 0; k < imports.size(); ++k) {
    fields::require_bounds(imports[k], "imports." + std::to_string(k));
    std::string line = Import(imports[k], scene).add();
    if (!line.empty() && std::ranges::find(lines, line) == lines.end()) lines.push_back(std::move(line));
  }
  return lines;
}

std::set<std::filesystem::path> mesh_files(const std::filesystem::path& mesh) {
  Model model;
  try {
    model = read_model(mesh, {});
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("'" + mesh.string() + "': " + fault.what());
  }
  for (const Material& material : model.materials) {
    for (const std::optional<ImageSource>& image : {material.image, material.opacity}) {
      if (!image || image->bytes) continue;
      const auto file = file_named(image->name, image->folders, image->is_uri);
      if (file) model.files.insert(file->lexically_normal());
    }
  }
  return std::move(model.files);
}

}  // namespace hedgehop::scenes::mesh
