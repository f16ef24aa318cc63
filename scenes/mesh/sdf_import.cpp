#include "scenes/mesh/sdf_import.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>

#include "scenes/mesh/mesh_builder.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/placement.h"
#include "scenes/mesh/polyhedron.h"
#include "scenes/mesh/sdf_reader.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Kind = SdfShape::Kind;

constexpr int kCylinderSides = 32;
constexpr int kSphereCuts = 3;
constexpr double kSolidPlaneM = 2000.0;  // planes are endless in SDFormat
constexpr double kPlaneToleranceM = 1e-3;

// A cylinder of radius 1 and length 1 around z.
Polyhedron cylinder() {
  Polyhedron body;
  for (uint32_t k = 0; k < kCylinderSides; ++k) {
    const double turn = 2.0 * std::numbers::pi * k / kCylinderSides;
    for (const double z : {-0.5, 0.5}) body.corners.emplace_back(std::cos(turn), std::sin(turn), z);
    const uint32_t low = 2 * k, next = 2 * ((k + 1) % kCylinderSides);
    body.faces.push_back({low, next, next + 1});
    body.faces.push_back({low, next + 1, low + 1});
    if (k < 2) continue;
    body.faces.push_back({0, low, low - 2});
    body.faces.push_back({1, low - 1, low + 1});
  }
  return body;
}

Polyhedron cube() {
  Polyhedron body;
  for (int k = 0; k < 8; ++k) body.corners.emplace_back((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5);
  body.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return body;
}

Polyhedron square() {
  return {{{-0.5, -0.5, 0.0}, {0.5, -0.5, 0.0}, {0.5, 0.5, 0.0}, {-0.5, 0.5, 0.0}}, {{0, 1, 2}, {0, 2, 3}}};
}

// The normals of a body's faces; the faces get corners of their own.
Part faceted(const Polyhedron& body, bool is_ball) {
  Part part;
  for (const auto& [a, b, c] : body.faces) {
    const auto first = static_cast<uint32_t>(part.body.corners.size());
    const Vector3d normal = (body.corners[b] - body.corners[a]).cross(body.corners[c] - body.corners[a]).normalized();
    for (const uint32_t corner : {a, b, c}) {
      part.body.corners.push_back(body.corners[corner]);
      part.normals.push_back(is_ball ? body.corners[corner] : normal);
    }
    part.body.faces.push_back({first, first + 1, first + 2});
  }
  return part;
}

Model primitive(Kind kind, const std::optional<Eigen::Vector3f>& color) {
  Model model;
  model.winding_is_front = true;
  Material material;
  if (color) material.color = *color;
  material.is_single_sided = true;
  model.materials.push_back(material);
  const bool is_ball = kind == Kind::sphere;
  model.parts.push_back(faceted(kind == Kind::box        ? cube()
                                : kind == Kind::cylinder ? cylinder()
                                : kind == Kind::plane    ? square()
                                                         : ball(kSphereCuts),
                                is_ball));
  return model;
}

// Returns the map from the coordinates of a mesh file to the axes of the shape. DAE and glTF are read with y up.
Eigen::Affine3d mesh_to_shape(const std::filesystem::path& file, const Vector3d& scale) {
  const std::string suffix = suffix_of(file);
  const bool y_is_up = suffix == ".dae" || suffix == ".gltf" || suffix == ".glb";
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  if (y_is_up) map.rotate(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
  return Eigen::Scaling(scale) * map;
}

class SdfImport {
 public:
  SdfImport(const ImportConfig& config, const Eigen::Affine3d& to_W, Scene& scene)
      : c_(config), to_W_(to_W), scene_(scene) {}

  std::string add() {
    SdfWorld world = read_sdf(c_.file);
    if (world.shapes.empty()) throw std::invalid_argument("it has no shapes");
    std::optional<std::string> current;
    for (const SdfShape& shape : world.shapes) {
      const std::string model = shape.name.substr(0, shape.name.find("::"));
      if (current != model) builder_.begin_instance(model, c_.kind);
      current = model;
      if (is_ground(shape)) {
        ++world.left_out["plane (the scene has a ground)"];
      } else if (shape.use == SdfShape::Use::visual) {
        draw(shape, model);
      } else if (c_.collide == ImportConfig::Collide::surface) {
        collide(shape, model);
      }
    }
    if (builder_.index_count() > 0) scene_.meshes.push_back(builder_.finish());
    return remarks(world);
  }

 private:
  // The look of all shapes of one mesh file, or of one form and color.
  using Look = std::pair<std::string, std::array<float, 4>>;

  PlacedModel& model_of(const SdfShape& shape) {
    const Eigen::Vector3f color = shape.color.value_or(Eigen::Vector3f::Zero());
    const Look look{shape.kind == Kind::mesh ? shape.mesh.string() : "/" + std::to_string(static_cast<int>(shape.kind)),
                    {color.x(), color.y(), color.z(), shape.color ? 1.0f : 0.0f}};
    const auto known = models_.find(look);
    if (known != models_.end()) return known->second;
    if (shape.kind != Kind::mesh) return models_.emplace(look, primitive(shape.kind, shape.color)).first->second;
    Model model;
    try {
      model = read_model(shape.mesh, {});
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("mesh '" + shape.mesh.string() + "': " + fault.what());
    }
    for (Material& material : model.materials) {
      if (shape.color && !material.image) material.color = *shape.color;
    }
    return models_.emplace(look, std::move(model)).first->second;
  }

  // From the axes of the shape's model to W.
  Eigen::Affine3d place(const SdfShape& shape) const {
    const Eigen::Affine3d scaled =
        shape.kind == Kind::mesh ? mesh_to_shape(shape.mesh, shape.size) : Eigen::Affine3d(Eigen::Scaling(shape.size));
    return to_W_ * shape.pose * scaled;
  }

  void draw(const SdfShape& shape, const std::string& name) {
    count(model_of(shape).add({name, place(shape), true, false}, builder_, scene_));
  }

  void count(size_t triangles) {
    triangles_ += triangles;
    if (triangles_ > kMaxTriangles)
      throw std::invalid_argument("it has more than " + std::to_string(kMaxTriangles) + " triangles");
  }

  void collide(const SdfShape& shape, const std::string& name) {
    if (shape.kind == Kind::mesh) {
      count(model_of(shape).add({name, place(shape), false, true}, builder_, scene_));
      return;
    }
    const double scale = std::cbrt(to_W_.linear().determinant());
    Solid solid;
    solid.name = name;
    solid.X_WS.linear() = to_W_.linear() / scale * shape.pose.linear();
    solid.X_WS.translation() = to_W_ * shape.pose.translation();
    solid.half_extents_m = 0.5 * scale * shape.size;
    if (shape.kind == Kind::cylinder) {
      solid.shape = Solid::Shape::cylinder;
      solid.half_extents_m.head<2>() *= 2.0;  // radii
    } else if (shape.kind == Kind::sphere) {
      solid.shape = Solid::Shape::sphere;
      solid.half_extents_m *= 2.0;
    } else if (shape.kind == Kind::plane) {
      solid.shape = Solid::Shape::surface;
      solid.polyhedron = moved(Eigen::Affine3d(Eigen::Scaling(kSolidPlaneM)), square());
    }
    scene_.solids.push_back(std::move(solid));
  }

  bool is_ground(const SdfShape& shape) const {
    if (shape.kind != Kind::plane || !scene_.has_ground) return false;
    const Vector3d normal_W = (to_W_.linear() * shape.pose.linear().col(2)).normalized();
    return normal_W.z() < kPlaneToleranceM - 1.0 && std::abs((to_W_ * shape.pose.translation()).z()) < kPlaneToleranceM;
  }

  std::string remarks(const SdfWorld& world) const {
    std::string line;
    for (const auto& [element, count] : world.left_out)
      line += (line.empty() ? "left out: " : ", ") + std::to_string(count) + " " + element;
    for (const auto& [look, model] : models_) {
      if (const std::string text = model.remarks(); !text.empty())
        line += (line.empty() ? "" : "; ") + ("'" + look.first + "': " + text);
    }
    return line;
  }

  const ImportConfig& c_;
  Eigen::Affine3d to_W_;
  Scene& scene_;
  std::map<Look, PlacedModel> models_;
  MeshBuilder builder_{"opaque"};
  size_t triangles_ = 0;
};

}  // namespace

bool is_sdf(const std::filesystem::path& file) {
  const std::string suffix = suffix_of(file);
  return suffix == ".sdf" || suffix == ".world";
}

std::string add_sdf(const ImportConfig& config, const Eigen::Affine3d& to_W, Scene& scene) {
  return SdfImport(config, to_W, scene).add();
}

}  // namespace hedgehop::scenes::mesh
