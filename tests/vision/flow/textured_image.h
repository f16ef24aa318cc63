#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <vector>

#include "vision/camera/pinhole_camera.h"

/// Images with known motion. A texture is a sum of waves, so that it can be evaluated exactly at any position and
/// requires no interpolation for subpixel motion.
namespace hedgehop::vision {

class WaveTexture {
 public:
  /// Waves of random directions with periods between the given limits, amplitudes proportional to the period, and a
  /// standard deviation of 35 grey levels about 127.
  WaveTexture(uint64_t seed, double least_period, double largest_period, int waves = 24);

  double grey(double s, double t) const;

 private:
  std::vector<double> per_s_, per_t_;  ///< waves per unit
  std::vector<double> phase_;          ///< turns
  std::vector<double> amplitude_;
};

inline uint8_t to_pixel(double grey) { return cv::saturate_cast<uint8_t>(std::lround(grey)); }

/// Returns the image with grey level `grey(u, v)` at pixel (u, v).
template <class Grey>
cv::Mat draw_image(int width, int height, Grey grey) {
  cv::Mat image(height, width, CV_8UC1);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) image.at<uint8_t>(v, u) = to_pixel(grey(u, v));
  }
  return image;
}

inline void add_noise(cv::Mat& image, double sigma_grey, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, sigma_grey);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      uint8_t& pixel = image.at<uint8_t>(v, u);
      pixel = to_pixel(pixel + noise(random));
    }
  }
}

/// A textured plane through `p_WO` with in-plane unit axes, limited along the first; texture coordinates in m.
struct TexturedPlane {
  Eigen::Vector3d p_WO, s_W, t_W;
  double half_width_m = std::numeric_limits<double>::infinity();
};

/// Returns the texture coordinates of the point at which a ray meets the first plane; none if it meets no plane.
std::optional<Eigen::Vector2d> seen_point(const Eigen::Vector3d& p_W, const Eigen::Vector3d& ray_W,
                                          const std::vector<TexturedPlane>& planes);

/// Draws planes as seen by a camera; uniform grey `sky` at pixels without a plane.
inline cv::Mat draw_planes(const camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC,
                           const std::vector<TexturedPlane>& planes, const WaveTexture& texture, double sky = 200.0) {
  return draw_image(camera.width_px, camera.height_px, [&](double u, double v) {
    const auto point = seen_point(X_WC.translation(), X_WC.linear() * camera.ray_at_unit_depth({u, v}), planes);
    return point ? texture.grey(point->x(), point->y()) : sky;
  });
}

}  // namespace hedgehop::vision
