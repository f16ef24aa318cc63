#include "tests/sim/render/small_world.h"

#include <numbers>
#include <opencv2/imgproc.hpp>

namespace hedgehop::sim {

SmallWorld::SmallWorld(std::vector<cv::Mat> textures) {
  if (textures.empty()) textures.push_back(plain_image(4, {255, 255, 255}));
  scene.name = "small";
  scene.textures = std::move(textures);
  scene.meshes.push_back({.material = "opaque"});
}

void SmallWorld::quad(const Eigen::Vector3f& top_left_W, const Eigen::Vector3f& right_W, const Eigen::Vector3f& down_W,
                      uint32_t texture) {
  scenes::Mesh& mesh = scene.meshes.front();
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const auto instance = static_cast<uint32_t>(mesh.chunks.size());
  const Eigen::Vector3f n_W = down_W.cross(right_W).normalized();  // towards a viewer with `right` on the right
  mesh.vertices.push_back({top_left_W, n_W, {0, 0}, texture, instance});
  mesh.vertices.push_back({top_left_W + down_W, n_W, {0, 1}, texture, instance});
  mesh.vertices.push_back({top_left_W + down_W + right_W, n_W, {1, 1}, texture, instance});
  mesh.vertices.push_back({top_left_W + right_W, n_W, {1, 0}, texture, instance});
  for (const uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

void SmallWorld::close_chunk(bool fills_box_to_ground) {
  scenes::Mesh& mesh = scene.meshes.front();
  scenes::Chunk chunk;
  if (!mesh.chunks.empty()) chunk.first_index = mesh.chunks.back().first_index + mesh.chunks.back().index_count;
  chunk.index_count = static_cast<uint32_t>(mesh.indices.size()) - chunk.first_index;
  chunk.fills_box_to_ground = fills_box_to_ground;
  for (uint32_t i = chunk.first_index; i < mesh.indices.size(); ++i) {
    chunk.box_W.extend(mesh.vertices[mesh.indices[i]].p_W);
  }
  mesh.chunks.push_back(chunk);
  mesh.instances.resize(mesh.chunks.size());
}

void SmallWorld::add_quad(const Eigen::Vector3f& top_left_W, const Eigen::Vector3f& right_W,
                          const Eigen::Vector3f& down_W, uint32_t texture) {
  quad(top_left_W, right_W, down_W, texture);
  close_chunk(false);
}

void SmallWorld::add_box(const Eigen::AlignedBox3f& box_W, uint32_t texture, bool fills_box_to_ground) {
  const Eigen::Vector3f north = box_W.sizes().x() * Eigen::Vector3f::UnitX();
  const Eigen::Vector3f east = box_W.sizes().y() * Eigen::Vector3f::UnitY();
  const Eigen::Vector3f down = box_W.sizes().z() * Eigen::Vector3f::UnitZ();
  const Eigen::Vector3f a = box_W.min();         // south-west corner of the roof
  quad(a, east, down, texture);                  // south face
  quad(a + north + east, -east, down, texture);  // north face
  quad(a + north, -north, down, texture);        // west face
  quad(a + east, north, down, texture);          // east face
  quad(a + north, east, -north, texture);        // roof, north on top
  quad(a + down, east, north, texture);          // floor
  close_chunk(fills_box_to_ground);
}

void SmallWorld::add_ground(float half_m, int tiles_per_side, uint32_t texture) {
  const float side_m = 2.0f * half_m / static_cast<float>(tiles_per_side);
  for (int i = 0; i < tiles_per_side; ++i) {
    for (int j = 0; j < tiles_per_side; ++j) {
      const float north = -half_m + side_m * static_cast<float>(i + 1), east = -half_m + side_m * static_cast<float>(j);
      add_quad({north, east, 0}, {0, side_m, 0}, {-side_m, 0, 0}, texture);
    }
  }
}

Eigen::Isometry3d look_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W, double roll_rad) {
  const Eigen::Vector3d forward = (target_W - p_WC).normalized();
  const bool vertical = std::abs(forward.z()) > 0.999;
  const Eigen::Vector3d down_hint = vertical ? Eigen::Vector3d(-Eigen::Vector3d::UnitX()) : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = down_hint.cross(forward).normalized();
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() << right, forward.cross(right), forward;
  X_WC.linear() = (X_WC.linear() * Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ())).eval();
  X_WC.translation() = p_WC;
  return X_WC;
}

Eigen::Isometry3d random_pose(std::mt19937_64& random, double half_m, double height_m, double tilt_rad) {
  const Eigen::Vector3d p_WC(uniform(random, -half_m, half_m), uniform(random, -half_m, half_m),
                             -uniform(random, 0.2, height_m));
  const double heading = uniform(random, -std::numbers::pi, std::numbers::pi);
  const double pitch = uniform(random, -tilt_rad, tilt_rad);
  const Eigen::Vector3d forward(std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch),
                                -std::sin(pitch));
  return look_at(p_WC, p_WC + forward, uniform(random, -tilt_rad, tilt_rad));
}

SmallWorld small_city(int blocks_per_side, uint64_t seed) {
  std::mt19937_64 random(seed);
  SmallWorld world({noise_image(256, seed + 1), noise_image(256, seed + 2), noise_image(256, seed + 3)});
  const double pitch_m = 34.0, half_m = 0.5 * pitch_m * blocks_per_side;
  world.add_ground(static_cast<float>(half_m + 20.0), blocks_per_side, 0);
  for (int i = 0; i < blocks_per_side; ++i) {
    for (int j = 0; j < blocks_per_side; ++j) {
      const Eigen::Vector2d corner(pitch_m * i - half_m + uniform(random, 4.0, 7.0),
                                   pitch_m * j - half_m + uniform(random, 4.0, 7.0));
      const Eigen::Vector2d size(uniform(random, 12.0, 24.0), uniform(random, 12.0, 24.0));
      const Eigen::Vector3d low(corner.x(), corner.y(), -uniform(random, 8.0, 40.0));
      const Eigen::Vector3d high(corner.x() + size.x(), corner.y() + size.y(), 0.0);
      world.add_box({low.cast<float>(), high.cast<float>()}, 1 + static_cast<uint32_t>((i + j) % 2), true);
    }
  }
  return world;
}

cv::Mat noise_image(int size_px, uint64_t seed) {
  std::mt19937_64 random(seed);
  cv::Mat image(size_px, size_px, CV_8UC3);
  for (auto it = image.begin<cv::Vec3b>(); it != image.end<cv::Vec3b>(); ++it) {
    for (int c = 0; c < 3; ++c) (*it)[c] = static_cast<uint8_t>(random());
  }
  cv::GaussianBlur(image, image, {0, 0}, 1.5);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

cv::Mat plain_image(int size_px, const cv::Scalar& rgb) { return {size_px, size_px, CV_8UC3, rgb}; }

}  // namespace hedgehop::sim
