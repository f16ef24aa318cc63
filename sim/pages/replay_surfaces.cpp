#include "sim/pages/replay_surfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "scenes/mesh_detail.h"
#include "sim/flight/json_reader.h"
#include "sim/pages/report_page.h"
#include "sim/record/image_file.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMaxTriangles = 100'000;                // about 3 MB in base64
constexpr size_t kMaxTextureBytes = 2'000'000;           // of all textures
constexpr int kMinTexturePx = 64, kTextureQuality = 82;  // of the JPEG

template <class Value>
std::string packed(const std::vector<Value>& values) {
  static_assert(std::endian::native == std::endian::little);
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
}

Json rgb_list(const Eigen::Vector3f& v) { return {brief(v.x()), brief(v.y()), brief(v.z())}; }

/// The triangles of one mesh or several meshes.
class Surfaces {
 public:
  void add(const scenes::Mesh& mesh, bool far) {
    constexpr uint32_t kUnused = UINT32_MAX;
    std::vector<uint32_t> renamed(mesh.vertices.size(), kUnused);
    for (const uint32_t index : scenes::triangle_indices(mesh, far)) {
      if (renamed[index] == kUnused) {
        renamed[index] = static_cast<uint32_t>(vertices_.size());
        vertices_.push_back(mesh.vertices[index]);
      }
      indices_.push_back(renamed[index]);
    }
  }

  Json json() const {
    Eigen::AlignedBox3f box;
    for (const scenes::Vertex& v : vertices_) box.extend(v.p_W);
    if (vertices_.empty()) box = Eigen::AlignedBox3f(Eigen::Vector3f::Zero());
    const Eigen::Vector3f step = (box.sizes() / 65535.0f).cwiseMax(1e-6f);
    std::vector<uint16_t> p, texture;
    std::vector<float> uv;
    std::vector<int8_t> n;
    for (const scenes::Vertex& v : vertices_) {
      const Eigen::Vector3f from_low = (v.p_W - box.min()).cwiseQuotient(step);
      for (const float value : from_low) p.push_back(static_cast<uint16_t>(std::lround(value)));
      for (const float value : v.n_W) n.push_back(static_cast<int8_t>(std::lround(127.0f * value)));
      uv.insert(uv.end(), {v.uv.x(), v.uv.y()});
      texture.push_back(static_cast<uint16_t>(v.texture));
    }
    Json steps = Json::array();
    for (const float value : step) steps.push_back(value);  // with all digits
    return {{"count", vertices_.size()},
            {"low", rgb_list(box.min())},
            {"step", steps},
            {"p", packed(p)},
            {"uv", packed(uv)},
            {"n", packed(n)},
            {"texture", packed(texture)},
            {"index", packed(indices_)}};
  }

 private:
  std::vector<scenes::Vertex> vertices_;
  std::vector<uint32_t> indices_;
};

Json textures(const scenes::Scene& scene) {
  const std::vector<cv::Mat> images = scene.textures.images();
  for (int side_px = scene.textures.size_px();; side_px /= 2) {
    Json jpegs = Json::array();
    size_t bytes = 0;
    for (const cv::Mat& image : images) {
      cv::Mat smaller = image;
      if (side_px < image.cols) cv::resize(image, smaller, {side_px, side_px}, 0, 0, cv::INTER_AREA);
      const std::string jpeg = jpeg_of(smaller, kTextureQuality);
      bytes += jpeg.size();
      jpegs.push_back(base64(jpeg));
    }
    if (bytes <= kMaxTextureBytes || side_px <= kMinTexturePx) return jpegs;
  }
}

}  // namespace

Json replay_surfaces(const scenes::Scene& scene, bool shadows) {
  size_t triangles = 0;
  for (const scenes::Mesh& mesh : scene.meshes) triangles += mesh.indices.size() / 3;
  Surfaces fixed;
  for (const scenes::Mesh& mesh : scene.meshes) fixed.add(mesh, triangles > kMaxTriangles);
  Json json;
  json["lights"] = {{"ambient", brief(scene.lights.ambient)},
                    {"sun", brief(scene.lights.sun)},
                    {"to_sun", rgb_list(scene.lights.to_sun_W)},
                    {"shadows", shadows}};
  json["sky"] = {{"horizon", rgb_list(scene.sky.horizon)},
                 {"zenith", rgb_list(scene.sky.zenith)},
                 {"visibility_m", json_number(scene.sky.visibility_m)}};
  json["textures"] = textures(scene);
  json["meshes"] = Json::array({fixed.json()});
  for (const scenes::Mover& mover : scene.movers) {
    Surfaces moving;
    moving.add(mover.mesh, false);
    json["meshes"].push_back(moving.json());
  }
  return json;
}

}  // namespace hedgehop::sim
