#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/mesh/gltf_file.h"
#include "scenes/mesh/gltf_material.h"
#include "scenes/mesh/gltf_primitive.h"
#include "scenes/mesh/make_room.h"
#include "scenes/mesh/mesh_reader.h"
#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Json = GltfFile::Json;

constexpr size_t kMaxCorners = 3 * kMaxTriangles;
// They are rendered, or have no effect on images.
constexpr std::array<std::string_view, 11> kKnownExtensions{
    "KHR_mesh_quantization",   "KHR_texture_transform",    "EXT_texture_webp",
    "KHR_materials_ior",       "KHR_materials_specular",   "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_clearcoat", "KHR_materials_dispersion", "KHR_xmp_json_ld",
    "KHR_lights_punctual",     "EXT_mesh_features"};

void require_extensions(const Json& json, std::set<std::string>& unrendered) {
  const auto is_known = [](const std::string& name) {
    return std::ranges::find(kKnownExtensions, name) != kKnownExtensions.end();
  };
  for (const std::string& name : json.value("extensionsRequired", std::vector<std::string>{})) {
    if (is_known(name) || name.starts_with("KHR_materials_")) continue;
    fail_gltf("it requires the extension '" + name +
              "'; valid: KHR_mesh_quantization, KHR_texture_transform, EXT_texture_webp, KHR_materials_*");
  }
  for (const std::string& name : json.value("extensionsUsed", std::vector<std::string>{})) {
    if (!is_known(name)) unrendered.insert("extension " + name);
  }
}

Eigen::Affine3d transform_of(const Json& node) {
  if (node.contains("matrix")) {
    const auto m = node["matrix"].get<std::array<double, 16>>();
    return Eigen::Affine3d(Eigen::Map<const Eigen::Matrix4d>(m.data()));  // both are column-major
  }
  const auto t = node.value("translation", std::array<double, 3>{0.0, 0.0, 0.0});
  const auto q = node.value("rotation", std::array<double, 4>{0.0, 0.0, 0.0, 1.0});
  const auto s = node.value("scale", std::array<double, 3>{1.0, 1.0, 1.0});
  return Eigen::Translation3d(t[0], t[1], t[2]) * Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized() *
         Eigen::Scaling(s[0], s[1], s[2]);
}

// Reads the triangles of a file, in the frame of the scene, with one part for each material.
class GltfModel {
 public:
  GltfModel(const std::filesystem::path& file, const ModelOrigin& origin)
      : file_(file), origin_(origin_in_model(origin, true)) {
    require_extensions(file_.json(), model_.unrendered);
    if (file_.json().contains("animations")) model_.unrendered.insert("animations");
    if (file_.json().contains("skins")) model_.unrendered.insert("skins");
  }

  Model read_materials() {
    const size_t materials = file_.length("materials");
    GltfMaterials reader(file_, model_.unrendered);
    for (size_t i = 0; i <= materials; ++i) {  // the last one is the default
      materials_.push_back(GltfFile::in_element("materials", i, [&] { return reader.read(i); }));
      model_.materials.push_back(materials_.back().look);
    }
    model_.files = file_.files();
    return model_;
  }

  Model read() {
    read_materials();
    parts_.resize(materials_.size());
    read_nodes();
    for (Part& part : parts_) {
      if (!part.body.faces.empty()) model_.parts.push_back(std::move(part));
    }
    model_.front_is_z = model_.winding_is_front = true;
    return std::move(model_);
  }

 private:
  std::vector<size_t> roots() const {
    const Json& json = file_.json();
    if (json.contains("scenes")) {
      const Json& scene = file_.element("scenes", GltfFile::count_at(json, "scene", 0));
      return scene.value("nodes", std::vector<size_t>{});
    }
    std::vector<bool> is_child(file_.length("nodes"));
    for (size_t i = 0; i < is_child.size(); ++i) {
      for (const size_t child : file_.element("nodes", i).value("children", std::vector<size_t>{})) {
        if (child < is_child.size()) is_child[child] = true;
      }
    }
    std::vector<size_t> found;
    for (size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) found.push_back(i);
    }
    return found;
  }

  void read_nodes() {
    std::vector<std::pair<size_t, Eigen::Affine3d>> open;
    const auto add = [&](const std::vector<size_t>& nodes, const Eigen::Affine3d& parent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.emplace_back(*node, parent);
    };
    std::vector<bool> is_read(file_.length("nodes"));
    add(roots(), Eigen::Affine3d(Eigen::Translation3d(-origin_)));
    while (!open.empty()) {
      const auto [index, parent] = open.back();
      open.pop_back();
      const Json& node = file_.element("nodes", index);
      if (is_read[index]) fail_gltf("its nodes[" + std::to_string(index) + "] has two parents");
      is_read[index] = true;
      GltfFile::in_element("nodes", index, [&, parent = parent] {
        const Eigen::Affine3d here = parent * transform_of(node);
        if (node.contains("mesh")) add_mesh(GltfFile::count_at(node, "mesh"), here);
        if (node.contains("extensions") && node["extensions"].contains("EXT_mesh_gpu_instancing"))
          model_.unrendered.insert("instances");
        add(node.value("children", std::vector<size_t>{}), here);
      });
    }
  }

  void add_mesh(size_t index, const Eigen::Affine3d& transform) {
    const auto [at, is_new] = meshes_.try_emplace(index);
    if (is_new) {
      GltfFile::in_element("meshes", index, [&, &primitives = at->second] {
        GltfSize size;
        for (const Json& json : file_.element("meshes", index).at("primitives")) {
          const GltfSize more = gltf_size(file_, json);
          size = {size.corners + more.corners, size.faces + more.faces};
          require_room(size);
          if (auto triangles = read_gltf_primitive(file_, json, materials_, model_.unrendered))
            primitives.push_back(*std::move(triangles));
        }
      });
    }
    for (const GltfPrimitive& primitive : at->second) add_primitive(primitive, transform);
  }

  void require_room(const GltfSize& size) const {
    if (triangles_ + size.faces > kMaxTriangles)
      fail_gltf("it has more than " + std::to_string(kMaxTriangles) + " triangles");
    if (corners_ + size.corners > kMaxCorners)
      fail_gltf("it has more than " + std::to_string(kMaxCorners) + " corners");
  }

  // Appends triangles to the part of their material. A transform that mirrors reverses their winding.
  void add_primitive(const GltfPrimitive& primitive, const Eigen::Affine3d& transform) {
    Part& part = parts_[primitive.material];
    part.material = primitive.material;
    require_room({primitive.corners.size(), primitive.faces.size()});
    corners_ += primitive.corners.size();
    triangles_ += primitive.faces.size();
    const auto first = static_cast<uint32_t>(part.body.corners.size());
    make_room(part.body.corners, primitive.corners.size());
    make_room(part.normals, primitive.normals.size());
    make_room(part.body.faces, primitive.faces.size());
    const Eigen::Matrix3d linear = transform.linear();
    const bool mirrors = linear.determinant() < 0.0;
    Eigen::Matrix3d of_normals = linear.inverse().transpose();
    if (!of_normals.allFinite()) of_normals = linear;
    for (const Vector3d& corner : primitive.corners) part.body.corners.push_back(transform * corner);
    for (const Vector3d& normal : primitive.normals) part.normals.push_back((of_normals * normal).normalized());
    part.uvs.insert(part.uvs.end(), primitive.uvs.begin(), primitive.uvs.end());
    part.colors.insert(part.colors.end(), primitive.colors.begin(), primitive.colors.end());
    for (auto face : primitive.faces) {
      for (uint32_t& corner : face) corner += first;
      if (mirrors) std::swap(face[0], face[1]);
      part.body.faces.push_back(face);
    }
  }

  GltfFile file_;
  Vector3d origin_;
  Model model_;
  std::vector<GltfMaterial> materials_;
  std::vector<Part> parts_;
  std::map<size_t, std::vector<GltfPrimitive>> meshes_;
  size_t triangles_ = 0, corners_ = 0;
};

}  // namespace

Model read_gltf(const std::filesystem::path& file, const ModelOrigin& origin) { return GltfModel(file, origin).read(); }

Model read_gltf_materials(const std::filesystem::path& file) { return GltfModel(file, {}).read_materials(); }

}  // namespace hedgehop::scenes::mesh
