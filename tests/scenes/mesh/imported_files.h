#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "scenes/mesh/mesh_import.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::scenes::mesh {

/// A folder of mesh files, which are imported into a scene with textures of 64 px.
class ImportedFiles : public testing::Test {
 protected:
  static constexpr int kSizePx = 64;

  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  Scene imported(const ImportConfig& config) {
    Scene scene;
    scene.textures = std::vector<cv::Mat>{cv::Mat(kSizePx, kSizePx, CV_8UC3, cv::Scalar(0, 0, 0))};
    lines_ = add_imports({config}, Eigen::Vector3d::Zero(), scene);
    if (!scene.meshes.empty()) {
      size_line_ = lines_.at(0);
      lines_.erase(lines_.begin());
    }
    return scene;
  }

  const sim::TemporaryFolder temporary_;
  const std::filesystem::path& folder_ = temporary_.path();
  std::string size_line_;           ///< of the last import
  std::vector<std::string> lines_;  ///< of the last import, without its size
};

inline const cv::Vec3b kRed(200, 0, 0), kBlue(0, 0, 200);  ///< of test images

/// The first hit of a ray.
struct RayHit {
  double distance_m = std::numeric_limits<double>::infinity();
  cv::Vec3b color;  ///< of the nearest texel
};

/// Returns the first triangle that a ray meets from its front. @param ray_W  unit vector.
inline RayHit cast(const Scene& scene, const Eigen::Vector3d& eye_W, const Eigen::Vector3d& ray_W) {
  RayHit hit;
  const std::vector<cv::Mat> images = scene.textures.images();
  for (const Mesh& mesh : scene.meshes) {
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const Vertex &a = mesh.vertices[mesh.indices[i]], &b = mesh.vertices[mesh.indices[i + 1]],
                   &c = mesh.vertices[mesh.indices[i + 2]];
      Eigen::Matrix3d system;  // eye + t ray = a + r (b - a) + s (c - a)
      system << -ray_W, (b.p_W - a.p_W).cast<double>(), (c.p_W - a.p_W).cast<double>();
      if (system.determinant() <= 1e-12) continue;  // from behind, or along the surface
      const Eigen::Vector3d trs = system.inverse() * (eye_W - a.p_W.cast<double>());
      if (trs[0] < 0.0 || trs[0] >= hit.distance_m || trs[1] < 0.0 || trs[2] < 0.0 || trs[1] + trs[2] > 1.0) continue;
      const Eigen::Vector2f uv =
          a.uv + static_cast<float>(trs[1]) * (b.uv - a.uv) + static_cast<float>(trs[2]) * (c.uv - a.uv);
      const cv::Mat& image = images[a.texture];
      const auto texel = [&](float x) {
        return std::min(static_cast<int>((x - std::floor(x)) * static_cast<float>(image.cols)), image.cols - 1);
      };
      hit = {trs[0], image.at<cv::Vec3b>(texel(uv.y()), texel(uv.x()))};
    }
  }
  return hit;
}

}  // namespace hedgehop::scenes::mesh
