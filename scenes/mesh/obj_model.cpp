#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "scenes/mesh/model.h"
#include "scenes/mesh/mtl_file.h"
#include "scenes/mesh/obj_file.h"
#include "scenes/mesh/obj_text.h"
#include "scenes/mesh/polygon.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Triangle = std::array<uint32_t, 3>;

constexpr uint32_t kNoCorner = static_cast<uint32_t>(-1);

// Builds one part for each material. Equal corners of smooth faces are one corner of the part; flat faces have corners
// of their own.
class ObjParts {
 public:
  explicit ObjParts(const ObjFile& file)
      : file_(file), parts_(file.materials.size()), materials_(file.materials.size()) {
    std::vector<bool> is_used(materials_.size());
    for (const ObjFace& face : file.faces) is_used[face.material] = true;
    for (size_t i = 0; i < materials_.size(); ++i) {
      parts_[i].material = i;
      if (is_used[i]) materials_[i] = file.library.find(file.materials[i]);
    }
    newest_.resize(file.positions.size(), kNoCorner);
  }

  void add(const ObjFace& face, std::span<const ObjCorner> corners) {
    if (corners.size() == 3) return add_triangle(face.material, {0, 1, 2}, corners);
    polygon_.clear();
    for (const ObjCorner& corner : corners) polygon_.push_back(position(corner));
    for (const Triangle& triangle : triangles_of_polygon(polygon_)) add_triangle(face.material, triangle, corners);
  }

  // Moves materials and parts to a model.
  void move_to(Model& model) {
    for (MtlMaterial& material : materials_) model.materials.push_back(std::move(material.look));
    for (Part& part : parts_) {
      if (!part.body.faces.empty()) model.parts.push_back(std::move(part));
    }
  }

 private:
  // A corner of a part. The former corners at its position form a list.
  struct Corner {
    ObjCorner source;
    uint32_t material, index, former;
  };

  const Vector3d& position(const ObjCorner& corner) const {
    return file_.positions[static_cast<size_t>(corner.position)];
  }

  void add_triangle(uint32_t material, const Triangle& triangle, std::span<const ObjCorner> corners) {
    const bool is_smooth = std::ranges::all_of(triangle, [&](uint32_t i) { return corners[i].normal != kNoIndex; });
    const std::array abc{corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]};
    Triangle face{};
    if (is_smooth) {
      std::ranges::transform(abc, face.begin(),
                             [&](const ObjCorner& corner) { return smooth_corner(material, corner); });
    } else {
      const Vector3d& a = position(abc[0]);
      const Vector3d normal = (position(abc[1]) - a).cross(position(abc[2]) - a).normalized();
      std::ranges::transform(abc, face.begin(),
                             [&](const ObjCorner& corner) { return new_corner(material, corner, normal); });
    }
    parts_[material].body.faces.push_back(face);
  }

  uint32_t smooth_corner(uint32_t material, const ObjCorner& source) {
    constexpr int kMaxSteps =
        16;  // limits the time for a file whose corners have one position; rare corners are not joined
    uint32_t& newest = newest_[static_cast<size_t>(source.position)];
    uint32_t at = newest;
    for (int step = 0; at != kNoCorner && step < kMaxSteps; ++step, at = corners_[at].former) {
      if (corners_[at].source == source && corners_[at].material == material) return corners_[at].index;
    }
    const uint32_t index =
        new_corner(material, source, file_.normals[static_cast<size_t>(source.normal)].cast<double>());
    corners_.push_back({source, material, index, std::exchange(newest, static_cast<uint32_t>(corners_.size()))});
    return index;
  }

  uint32_t new_corner(uint32_t material, const ObjCorner& source, const Vector3d& normal) {
    Part& part = parts_[material];
    const MtlMaterial& mtl = materials_[material];
    part.body.corners.push_back(position(source));
    part.normals.push_back(normal);
    if (!file_.uvs.empty()) {
      const Vector2f uv = source.uv == kNoIndex ? Vector2f::Zero() : file_.uvs[static_cast<size_t>(source.uv)];
      const Vector2f upward = mtl.uv_scale.cwiseProduct(uv) + mtl.uv_offset;
      part.uvs.emplace_back(upward.x(), 1.0f - upward.y());
    }
    if (!file_.colors.empty()) {
      const Eigen::Vector3f& color = file_.colors[static_cast<size_t>(source.position)];
      part.colors.push_back(color.hasNaN() ? mtl.look.color : color);
    }
    return static_cast<uint32_t>(part.body.corners.size() - 1);
  }

  const ObjFile& file_;
  std::vector<Part> parts_;  // of the materials
  std::vector<MtlMaterial> materials_;
  std::vector<uint32_t> newest_;  // of each position: index into corners_
  std::vector<Corner> corners_;
  std::vector<Vector3d> polygon_;
};

}  // namespace

Model read_obj(const std::filesystem::path& file, std::string_view text, const ModelOrigin& origin) {
  ObjFile obj = read_obj_file(text, file.parent_path(), origin_in_model(origin, false));
  ObjParts parts(obj);
  size_t first = 0;
  for (const ObjFace& face : obj.faces) {
    parts.add(face, std::span(obj.corners).subspan(first, face.corner_count));
    first += face.corner_count;
  }
  Model model;
  parts.move_to(model);
  model.unrendered = std::move(obj.library.unrendered);
  if (obj.has_points_or_lines) model.unrendered.insert("points and lines");
  model.files = std::move(obj.library.files);
  model.files.insert(file.lexically_normal());
  return model;
}

Model read_obj_materials(const std::filesystem::path& file, std::string_view text) {
  ObjMaterials library;
  for_each_line(text, [&](std::string_view keyword, std::string_view rest, size_t) {
    if (keyword == "mtllib") read_material_files(rest, file.parent_path(), library);
  });
  Model model;
  for (const auto& [name, material] : library.by_name) model.materials.push_back(material.look);
  model.files = std::move(library.files);
  model.files.insert(file.lexically_normal());
  return model;
}

}  // namespace hedgehop::scenes::mesh
