#include "scenes/mesh/gltf_primitive.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "scenes/mesh/model.h"

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Json = GltfFile::Json;

constexpr size_t kTriangles = 4, kFan = 6;  // below: points and lines; between: strips

GltfNumbers gltf_numbers(const GltfFile& file, const Json& attributes, const std::string& name, size_t components,
                         size_t count) {
  GltfNumbers read = file.numbers(GltfFile::count_at(attributes, name.c_str()));
  if (read.components != components || read.count() != count) fail_gltf("the attribute " + name + " has a wrong size");
  return read;
}

std::vector<Vector3d> gltf_vectors(const GltfFile& file, const Json& attributes, const char* name) {
  const GltfNumbers read = file.numbers(GltfFile::count_at(attributes, name));
  const size_t count =
      GltfFile::count_at(file.element("accessors", GltfFile::count_at(attributes, "POSITION")), "count");
  if (read.components != 3 || read.count() != count)
    fail_gltf(std::string("the attribute ") + name + " has a wrong size");
  std::vector<Vector3d> result(count);
  for (size_t i = 0; i < count; ++i) {
    result[i] = Eigen::Map<const Vector3f>(read.values.data() + 3 * i).cast<double>();
  }
  return result;
}

void add_gltf_faces(const std::vector<uint32_t>& indices, bool is_list, bool is_fan, GltfPrimitive& result) {
  result.faces.reserve(is_list ? indices.size() / 3 : indices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += is_list ? 3 : 1) {
    const uint32_t a = indices[is_fan ? 0 : i], b = indices[i + 1], c = indices[i + 2];
    const bool is_odd = !is_list && !is_fan && i % 2 == 1;
    result.faces.push_back(is_odd ? std::array{a, c, b} : std::array{a, b, c});
  }
}

// Gives each triangle corners of its own, with its normal.
void flatten(GltfPrimitive& p) {
  GltfPrimitive flat;
  flat.material = p.material;
  const size_t corners = 3 * p.faces.size();
  flat.corners.reserve(corners);
  flat.normals.reserve(corners);
  flat.uvs.reserve(corners);
  flat.colors.reserve(corners);
  flat.faces.reserve(p.faces.size());
  for (const auto& face : p.faces) {
    const Vector3d across = (p.corners[face[1]] - p.corners[face[0]]).cross(p.corners[face[2]] - p.corners[face[0]]);
    const auto first = static_cast<uint32_t>(flat.corners.size());
    for (const uint32_t i : face) {
      flat.corners.push_back(p.corners[i]);
      flat.normals.push_back(across.normalized());
      flat.uvs.push_back(p.uvs[i]);
      flat.colors.push_back(p.colors[i]);
    }
    flat.faces.push_back({first, first + 1, first + 2});
  }
  p = std::move(flat);
}

void read_colors(const GltfFile& file, const Json& attributes, const Material& look, std::set<std::string>& unrendered,
                 GltfPrimitive& result) {
  const GltfNumbers read = file.numbers(GltfFile::count_at(attributes, "COLOR_0"));
  if (read.components < 3 || read.count() != result.corners.size()) fail_gltf("the attribute COLOR_0 has a wrong size");
  for (size_t i = 0; i < result.colors.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      const float value = read.values[read.components * i + k];
      const float linear = value > 0.0f ? std::min(value, 1.0f) : 0.0f;  // 0 also for NaN
      if (look.image && linear < 1.0f) unrendered.insert("vertex colors on an image ('" + look.name + "')");
      const auto channel = static_cast<Eigen::Index>(k);
      result.colors[i][channel] = srgb_of_linear(linear * look.tint[channel]);
    }
  }
}

// Reads normals, image coordinates and colors. Without normals, the faces are flat.
void read_look(const GltfFile& file, const Json& attributes, const GltfMaterial& material,
               std::set<std::string>& unrendered, GltfPrimitive& result) {
  const std::string uvs = "TEXCOORD_" + std::to_string(material.uv_set);
  const bool is_flat = !attributes.contains("NORMAL");
  if (!is_flat) result.normals = gltf_vectors(file, attributes, "NORMAL");
  result.uvs.assign(result.corners.size(), Eigen::Vector2f::Zero());
  if (material.look.image && attributes.contains(uvs)) {
    const GltfNumbers read = gltf_numbers(file, attributes, uvs, 2, result.corners.size());
    for (size_t i = 0; i < result.uvs.size(); ++i) {
      result.uvs[i] = material.uv_transform * Eigen::Vector2f(read.values[2 * i], read.values[2 * i + 1]);
    }
  }
  result.colors.assign(result.corners.size(), material.look.color);
  if (attributes.contains("COLOR_0")) read_colors(file, attributes, material.look, unrendered, result);
  if (is_flat) flatten(result);
}

}  // namespace

GltfSize gltf_size(const GltfFile& file, const Json& json) {
  const size_t mode = GltfFile::count_at(json, "mode", kTriangles);
  if (mode < kTriangles || mode > kFan) return {};
  const Json& attributes = json.at("attributes");
  if (!attributes.contains("POSITION")) return {};
  const auto count_of = [&file](const Json& list, const char* accessor) {
    return GltfFile::count_at(file.element("accessors", GltfFile::count_at(list, accessor)), "count", 0);
  };
  const size_t positions = count_of(attributes, "POSITION"),
               indices = json.contains("indices") ? count_of(json, "indices") : positions,
               faces = mode == kTriangles ? indices / 3 : std::max<size_t>(indices, 2) - 2;
  return {attributes.contains("NORMAL") ? positions : 3 * faces, faces};
}

std::optional<GltfPrimitive> read_gltf_primitive(const GltfFile& file, const Json& json,
                                                 const std::vector<GltfMaterial>& materials,
                                                 std::set<std::string>& unrendered) {
  const size_t mode = GltfFile::count_at(json, "mode", kTriangles);
  if (mode > kFan) fail_gltf("a primitive has the mode " + std::to_string(mode) + "; valid: 0 to 6");
  if (mode < kTriangles) {
    unrendered.insert("points and lines");
    return std::nullopt;
  }
  if (json.contains("targets")) unrendered.insert("morph targets");
  const Json& attributes = json.at("attributes");
  if (!attributes.contains("POSITION")) return std::nullopt;
  GltfPrimitive result;
  result.material = std::min(GltfFile::count_at(json, "material", materials.size()), materials.size() - 1);
  result.corners = gltf_vectors(file, attributes, "POSITION");
  std::vector<uint32_t> indices(result.corners.size());
  for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  if (json.contains("indices")) indices = file.indices(GltfFile::count_at(json, "indices"));
  for (const uint32_t index : indices) {
    if (index >= result.corners.size()) fail_gltf("an index is out of range");
  }
  add_gltf_faces(indices, mode == kTriangles, mode == kFan, result);
  read_look(file, attributes, materials[result.material], unrendered, result);
  return result;
}

}  // namespace hedgehop::scenes::mesh
