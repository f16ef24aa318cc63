#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
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
  WaveTexture(uint64_t seed, double least_period, double largest_period, int waves = 24) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    double power = 0.0;
    for (int i = 0; i < waves; ++i) {
      const double period = least_period * std::pow(largest_period / least_period, uniform(random));
      const double direction = 2 * std::numbers::pi * uniform(random), phase = 2 * std::numbers::pi * uniform(random);
      const double wave_number = 2 * std::numbers::pi / period;
      waves_.push_back({wave_number * std::cos(direction), wave_number * std::sin(direction), phase, period});
      power += 0.5 * period * period;
    }
    for (auto& wave : waves_) wave[3] *= 35.0 / std::sqrt(power);
  }

  double grey(double s, double t) const {
    double sum = 127.0;
    for (const auto& wave : waves_) sum += wave[3] * std::sin(wave[0] * s + wave[1] * t + wave[2]);
    return sum;
  }

 private:
  std::vector<std::array<double, 4>> waves_;
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

/// Draws planes as seen by a camera; uniform grey `sky` at pixels without a plane.
inline cv::Mat draw_planes(const camera::PinholeCamera& camera, const Eigen::Isometry3d& X_WC,
                           const std::vector<TexturedPlane>& planes, const WaveTexture& texture, double sky = 200.0) {
  return draw_image(camera.width_px, camera.height_px, [&](double u, double v) {
    const Eigen::Vector3d ray_W = X_WC.linear() * camera.ray_at_unit_depth({u, v});
    double nearest = std::numeric_limits<double>::infinity(), s = 0.0, t = 0.0;
    for (const TexturedPlane& plane : planes) {
      const Eigen::Vector3d normal_W = plane.s_W.cross(plane.t_W);
      const double range = normal_W.dot(plane.p_WO - X_WC.translation()) / normal_W.dot(ray_W);
      if (!(range > 1e-6 && range < nearest)) continue;
      const Eigen::Vector3d p_OP_W = X_WC.translation() + range * ray_W - plane.p_WO;
      if (std::abs(plane.s_W.dot(p_OP_W)) > plane.half_width_m) continue;
      nearest = range;
      s = plane.s_W.dot(p_OP_W);
      t = plane.t_W.dot(p_OP_W);
    }
    return std::isinf(nearest) ? sky : texture.grey(s, t);
  });
}

}  // namespace hedgehop::vision
