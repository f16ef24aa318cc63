#include "sim/render/haze.h"

#include <array>
#include <cmath>

#include "sim/render/lens_faces.h"

namespace hedgehop::sim {
namespace {

/// Ratio of the distance along the ray to the depth of each pixel. It is 1 if the depth is the distance along the ray.
class RayLengths {
 public:
  RayLengths(const vision::camera::Camera& camera, std::span<const Eigen::Vector3d> rays)
      : depth_is_z_(depth_is_z(camera)),
        pinhole_(camera.is_undistorted_pinhole()),
        width_(camera.width_px),
        rays_(rays) {
    if (pinhole_) camera_ = camera.pinhole();
  }

  double at(int u, int v) const {
    if (!depth_is_z_) return 1.0;
    if (!pinhole_)
      return 1.0 / rays_[static_cast<size_t>(v) * static_cast<size_t>(width_) + static_cast<size_t>(u)].z();
    const double x = (u - camera_.center_u_px) / camera_.focal_x_px, y = (v - camera_.center_v_px) / camera_.focal_y_px;
    return std::sqrt(1.0 + x * x + y * y);
  }

 private:
  bool depth_is_z_, pinhole_;
  int width_;
  std::span<const Eigen::Vector3d> rays_;
  vision::camera::PinholeCamera camera_;
};

/// Rounds as std::lround, without a call for each level.
/// @param level  >= 0.
uint8_t rounded(double level) {
  const int whole = static_cast<int>(level);
  return static_cast<uint8_t>(level - whole >= 0.5 ? whole + 1 : whole);
}

}  // namespace

double transmittance(double distance_m, double visibility_m) {
  return std::exp(-std::log(20.0) * distance_m / visibility_m);
}

void add_haze(const scenes::Sky& sky, const vision::camera::Camera& camera, std::span<const Eigen::Vector3d> rays,
              const cv::Mat1f& depth, cv::Mat& image) {
  const int channels = image.channels();
  std::array<double, 3> air{};
  for (int k = 0; k < channels; ++k)
    air[static_cast<size_t>(k)] = 255.0 * (channels == 1 ? sky.horizon.mean() : sky.horizon[k]);
  const RayLengths lengths(camera, rays);
  for (int v = 0; v < image.rows; ++v) {
    uint8_t* level = image.ptr<uint8_t>(v);
    for (int u = 0; u < image.cols; ++u, level += channels) {
      const double z_m = depth(v, u);
      if (!std::isfinite(z_m)) continue;  // sky, or outside the image circle
      const double share = transmittance(z_m * lengths.at(u, v), sky.visibility_m);
      for (int k = 0; k < channels; ++k) {
        const double hazy = air[static_cast<size_t>(k)] + share * (level[k] - air[static_cast<size_t>(k)]);
        level[k] = rounded(hazy);
      }
    }
  }
}

}  // namespace hedgehop::sim
