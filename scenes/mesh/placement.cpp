#include "scenes/mesh/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "scenes/mesh/orientation.h"
#include "scenes/mesh/polyhedron.h"
#include "scenes/mesh/vertex_colors.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

constexpr double kMaxCoordinateM = 100e3;  // as for every position in a scenario
constexpr float kMaxRepeats = 1e6f;        // of an image; more exceeds the precision of floats

// Returns the corners and faces of a part in W, without degenerate faces.
Polyhedron faces_W(const Polyhedron& body, const Eigen::Affine3d& to_W) {
  Polyhedron result;
  result.corners.reserve(body.corners.size());
  result.faces.reserve(body.faces.size());
  for (const Vector3d& corner : body.corners) result.corners.push_back(to_W * corner);
  for (const auto& [a, b, c] : body.faces) {
    const Vector3d across = (result.corners[b] - result.corners[a]).cross(result.corners[c] - result.corners[a]);
    if (across.norm() > 0.0) result.faces.push_back({a, b, c});
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
  result.corners.reserve(triangles.vertices.size());
  for (const Vertex& vertex : triangles.vertices) result.corners.push_back(vertex.p_W.cast<double>());
  result.faces = triangles.faces;
  return result;
}

}  // namespace

std::string PlacedModel::remarks() const {
  std::string line;
  for (const std::string& feature : model_.unrendered) line += (line.empty() ? "not rendered: " : ", ") + feature;
  for (const std::string& change : changes_) line += (line.empty() ? "" : "; ") + change;
  return line;
}

const PlacedModel::Texture& PlacedModel::texture_of(size_t material, Scene& scene) {
  std::optional<Texture>& texture = textures_[material];
  if (texture) return *texture;
  // Read now, because a missing image must not end a flight that has begun.
  MaterialImage image = material_image(model_.materials[material], scene.textures.size_px(), changes_);
  const uint32_t added = scene.textures.add([rgb = image.rgb] { return rgb; });
  return texture.emplace(Texture{added, std::move(image)});
}

size_t PlacedModel::add(const Place& place, MeshBuilder& builder, Scene& scene) {
  size_t count = 0;
  for (const Part& part : model_.parts) {
    if (part.body.faces.empty()) continue;
    if (!std::ranges::all_of(part.body.corners, [](const Vector3d& corner) { return corner.allFinite(); })) {
      throw std::invalid_argument("it has corners that are not finite");
    }
    Polyhedron body = faces_W(part.body, place.to_W);
    if (body.faces.empty()) continue;
    count += body.faces.size();
    for (const Vector3d& corner : body.corners) {
      if (corner.cwiseAbs().maxCoeff() > kMaxCoordinateM) {
        throw std::invalid_argument("it has corners farther than 100 km from the origin; 'origin' can be subtracted");
      }
    }
    Triangles triangles = triangles_of(part, body, place.to_W, model_);
    if (cover(part, triangles, scene)) body = polyhedron_of(triangles);
    if (triangles.faces.empty()) continue;
    if (place.is_drawn) {
      builder.begin_chunk(false);
      draw(triangles, builder);
    }
    if (!place.is_solid) continue;
    Solid solid;
    solid.name = place.name;
    solid.shape = Solid::Shape::surface;
    solid.polyhedron = std::move(body);
    scene.solids.push_back(std::move(solid));
  }
  return count;
}

// Gives triangles their texture. Returns whether they were cut.
bool PlacedModel::cover(const Part& part, Triangles& triangles, Scene& scene) {
  const Material& material = model_.materials[part.material];
  const bool has_colors = std::ranges::any_of(part.colors, [&](const auto& color) { return color != material.color; });
  if (has_colors && !material.image) {
    triangles = colored(triangles, part.colors, scene);
    return false;
  }
  if (has_colors && !model_.winding_is_front) model_.unrendered.insert("vertex colors on an image");
  const Texture& texture = texture_of(part.material, scene);
  const float cutoff = material.alpha_cutoff.value_or(0.0f);
  for (Vertex& vertex : triangles.vertices) {
    vertex.texture = texture.index;
    vertex.uv = vertex.uv.cwiseQuotient(texture.image.repeat);
  }
  for (int axis = 0; axis < 2; ++axis) {
    if (material.wrap[static_cast<size_t>(axis)] != Wrap::clamp) continue;
    triangles = clamped(triangles, axis, scene.textures.size_px());
  }
  if (!material.alpha_cutoff || (texture.image.opacity.empty() && cutoff <= 1.0f)) return false;
  triangles = cutoff > 1.0f ? Triangles() : without_holes(triangles, texture.image.opacity, cutoff);
  return true;
}

}  // namespace hedgehop::scenes::mesh
