#include "sim/export/scene_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include <opencv2/core.hpp>

#include "scenes/mesh_detail.h"
#include "sim/export/sensor_record.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kMaxTriangles = 100'000;  // viewers stay interactive; 20 MB as protobuf

/// The colors of a scene's surfaces: the mean of each texture, and the light.
class SurfaceColors {
 public:
  explicit SurfaceColors(const scenes::Scene& scene) : lights_(scene.lights) {
    for (const cv::Mat& image : scene.textures.images()) {
      const cv::Scalar mean = cv::mean(image) / 255.0;
      means_.emplace_back(static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2]));
    }
  }

  Eigen::Vector3f at(const scenes::Vertex& vertex) const {
    const float light = lights_.ambient + lights_.sun * std::max(0.0f, vertex.n_W.dot(lights_.to_sun_W));
    const Eigen::Vector3f albedo =
        vertex.texture < means_.size() ? means_[vertex.texture] : Eigen::Vector3f::Constant(0.5f);
    return (light * albedo).cwiseMin(1.0f);
  }

 private:
  scenes::Lights lights_;
  std::vector<Eigen::Vector3f> means_;
};

void add_corner(const scenes::Vertex& vertex, const SurfaceColors& colors, SurfaceMesh& mesh) {
  mesh.points_E.emplace_back(R_EW().cast<float>() * vertex.p_W);
  mesh.colors.push_back(colors.at(vertex));
}

/// Returns the surfaces of the instances of a mesh.
std::vector<SurfaceMesh> split(const scenes::Mesh& mesh, bool far, const SurfaceColors& colors) {
  std::vector<SurfaceMesh> objects(mesh.instances.size());
  for (size_t i = 0; i < objects.size(); ++i) {
    objects[i].id = mesh.instances[i].name;
    objects[i].kind = mesh.instances[i].kind;
  }
  constexpr uint32_t kUnused = UINT32_MAX;
  std::vector<uint32_t> renamed(mesh.vertices.size(), kUnused);
  for (const uint32_t index : scenes::triangle_indices(mesh, far)) {
    const scenes::Vertex& vertex = mesh.vertices[index];
    SurfaceMesh& object = objects[vertex.instance];
    if (renamed[index] == kUnused) {
      renamed[index] = static_cast<uint32_t>(object.points_E.size());
      add_corner(vertex, colors, object);
    }
    object.indices.push_back(renamed[index]);
  }
  return objects;
}

/// Makes the id of an object unique.
void number(SurfaceMesh& object, std::set<std::string>& used) {
  const std::string name = object.id.empty() ? "object" : object.id;
  object.id = name;
  for (int i = 2; !used.insert(object.id).second; ++i) object.id = fmt::format("{} ({})", name, i);
}

}  // namespace

void for_each_object(const scenes::Scene& scene, const std::function<void(const SurfaceMesh&)>& use) {
  size_t triangles = 0;
  for (const scenes::Mesh& mesh : scene.meshes) triangles += mesh.indices.size() / 3;
  const SurfaceColors colors(scene);
  std::set<std::string> used;
  for (const scenes::Mesh& mesh : scene.meshes) {
    for (SurfaceMesh& object : split(mesh, triangles > kMaxTriangles, colors)) {
      if (object.indices.empty()) continue;
      number(object, used);
      use(object);
    }
  }
}

void for_each_mover(const scenes::Scene& scene, const std::function<void(const SurfaceMesh&)>& use) {
  const SurfaceColors colors(scene);
  std::set<std::string> used;
  for (const scenes::Mover& mover : scene.movers) {
    std::vector<SurfaceMesh> parts = split(mover.mesh, false, colors);
    parts[0].id = mover.name;
    number(parts[0], used);
    use(parts[0]);
  }
}

std::string mover_frame(size_t mover) { return fmt::format("mover/{}", mover); }

}  // namespace hedgehop::sim
