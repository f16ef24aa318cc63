#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "scenes/scene.h"
#include "sim/libm/random.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {

/// Small scenes of boxes and quads.
class SmallWorld {
 public:
  /// One texture per image; a white one if there are no images.
  explicit SmallWorld(std::vector<cv::Mat> textures = {});

  /// A box with outward faces, one chunk and one instance. Each face shows its texture once, upright as seen from
  /// outside.
  void add_box(const Eigen::AlignedBox3f& box_W, uint32_t texture = 0, bool fills_box_to_ground = false);
  /// A parallelogram with its texture, one chunk and one instance. `right` and `down` are the sides of the texture seen
  /// from the front.
  void add_quad(const Eigen::Vector3f& top_left_W, const Eigen::Vector3f& right_W, const Eigen::Vector3f& down_W,
                uint32_t texture = 0);
  /// Tiles of the plane z = 0 over [-half_m, half_m]^2, seen from above.
  void add_ground(float half_m, int tiles_per_side, uint32_t texture = 0);

  scenes::Scene scene;

 private:
  void quad(const Eigen::Vector3f& top_left_W, const Eigen::Vector3f& right_W, const Eigen::Vector3f& down_W,
            uint32_t texture);
  void close_chunk(bool fills_box_to_ground);
};

/// Returns the pose of a camera at p_WC that points to a target, rotated by roll about its axis.
Eigen::Isometry3d look_at(const Eigen::Vector3d& p_WC, const Eigen::Vector3d& target_W, double roll_rad = 0.0);

/// Returns a city on a jittered grid with streets of about 10 m, heights 8 to 40 m, on tiles of ground, centered on the
/// origin.
SmallWorld small_city(int blocks_per_side, uint64_t seed);

/// Returns smoothed noise, RGB, with different values in each channel.
cv::Mat noise_image(int size_px, uint64_t seed);
/// Returns an image of one color.
cv::Mat plain_image(int size_px, const cv::Scalar& rgb);

/// Returns a pose within +-half_m of the origin and up to height_m above ground, any heading, pitch and roll within
/// +-tilt_rad.
Eigen::Isometry3d random_pose(std::mt19937_64& random, double half_m, double height_m, double tilt_rad);

}  // namespace hedgehop::sim
