#include "sim/render/lens_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace hedgehop::sim {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Returns R_CCf of the sides of the cube: front, right, left, down, up, back.
const std::array<Eigen::Matrix3d, 6>& cube_sides() {
  static const std::array<Eigen::Matrix3d, 6> sides = [] {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
    std::array<Eigen::Matrix3d, 6> R_CCf;
    R_CCf[0] << x, y, z;
    R_CCf[1] << -z, y, x;
    R_CCf[2] << z, y, -x;
    R_CCf[3] << x, -z, y;
    R_CCf[4] << x, z, -y;
    R_CCf[5] << -x, y, -z;
    return R_CCf;
  }();
  return sides;
}

/// Intersection of the ray of a pixel with the plane z = 1 of a side.
struct FaceRay {
  int side = -1;  ///< -1 outside the image circle
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double length = 1.0;  ///< of the ray up to the plane
};

std::vector<FaceRay> face_rays_of(const vision::camera::Camera& camera) {
  std::vector<Eigen::Vector3d> rays;
  double min_cosine = 1.0;  // of the angles between the rays and the optical axis
  for (int row = 0; row < camera.height_px; ++row) {
    for (int col = 0; col < camera.width_px; ++col) {
      const auto ray = camera.unit_ray(Eigen::Vector2d(col, row));
      rays.push_back(ray.value_or(Eigen::Vector3d::Constant(kUnknown)));
      if (ray) min_cosine = std::min(min_cosine, ray->z());
    }
  }
  // One face is sufficient for a perspective lens, and for other lenses if a perspective image is not stretched too
  // much.
  constexpr double kOneFaceRad = 50.0 * std::numbers::pi / 180.0;
  const bool one_face =
      std::holds_alternative<vision::camera::PinholeLens>(camera.lens) || min_cosine > std::cos(kOneFaceRad);
  std::vector<FaceRay> face_rays(rays.size());
  for (size_t i = 0; i < rays.size(); ++i) {
    if (!rays[i].allFinite()) continue;
    double best = -1.0;
    for (int side = 0; side < (one_face ? 1 : 6); ++side) {
      const Eigen::Vector3d ray_Cf = cube_sides()[static_cast<size_t>(side)].transpose() * rays[i];
      if (ray_Cf.z() <= best) continue;
      best = ray_Cf.z();
      face_rays[i] = {side, ray_Cf.head<2>() / ray_Cf.z(), 1.0 / ray_Cf.z()};
    }
  }
  return face_rays;
}

/// Returns the focal length at which the mean resolution of a face equals that of its part of the image. It follows
/// from the area that neighboring pixels of the image span on the plane z = 1 of the side.
double focal_px(const vision::camera::Camera& camera, const std::vector<FaceRay>& face_rays, int side) {
  double area = 0.0, count = 0.0;
  for (int row = 0; row + 1 < camera.height_px; ++row) {
    for (int col = 0; col + 1 < camera.width_px; ++col) {
      const auto at = [&](int down, int right) -> const FaceRay& {
        return face_rays[static_cast<size_t>((row + down) * camera.width_px + col + right)];
      };
      const FaceRay &here = at(0, 0), &right = at(0, 1), &below = at(1, 0);
      if (here.side != side || right.side != side || below.side != side) continue;
      const Eigen::Vector2d a = right.at - here.at, b = below.at - here.at;
      area += std::abs(a.x() * b.y() - a.y() * b.x());
      count += 1.0;
    }
  }
  constexpr double kDefaultFocalPx = 100.0;
  return area > 0.0 ? std::sqrt(count / area) : kDefaultFocalPx;
}

/// Returns the face of a side, cropped to its part of the image; none if no pixel of the image is on that side.
std::optional<LensFaces::Face> make_face(const vision::camera::Camera& camera, const std::vector<FaceRay>& face_rays,
                                         int side) {
  Eigen::AlignedBox2d seen;
  for (const FaceRay& face_ray : face_rays) {
    if (face_ray.side == side) seen.extend(face_ray.at);
  }
  if (seen.isEmpty()) return std::nullopt;
  LensFaces::Face face;
  face.R_CCf = cube_sides()[static_cast<size_t>(side)];
  const double focal = focal_px(camera, face_rays, side);
  const Eigen::Vector2d first = (focal * seen.min()).array().floor(), last = (focal * seen.max()).array().ceil();
  constexpr double kMarginPx = 1.0;
  const Eigen::Vector2d center = Eigen::Vector2d::Constant(kMarginPx) - first;
  const Eigen::Vector2d size = last - first + Eigen::Vector2d::Constant(2.0 * kMarginPx + 1.0);
  face.camera = {static_cast<int>(size.x()), static_cast<int>(size.y()), focal, focal, center.x(), center.y()};
  return face;
}

}  // namespace

bool depth_is_z(const vision::camera::Camera& camera) {
  return std::holds_alternative<vision::camera::PinholeLens>(camera.lens);
}

LensFaces make_lens_faces(const vision::camera::Camera& camera) {
  const std::vector<FaceRay> face_rays = face_rays_of(camera);
  LensFaces faces;
  faces.camera = camera;
  std::array<size_t, 6> face_of_side{};
  for (int side = 0; side < 6; ++side) {
    std::optional<LensFaces::Face> face = make_face(camera, face_rays, side);
    if (!face) continue;
    face->first_row = faces.sheet.height;
    faces.sheet.height += face->camera.height_px;
    faces.sheet.width = std::max(faces.sheet.width, face->camera.width_px);
    face_of_side[static_cast<size_t>(side)] = faces.faces.size();
    faces.faces.push_back(*face);
  }

  faces.positions.resize(face_rays.size());
  faces.nearest.resize(face_rays.size());
  for (size_t i = 0; i < face_rays.size(); ++i) {
    if (face_rays[i].side < 0) continue;
    const LensFaces::Face& face = faces.faces[face_of_side[static_cast<size_t>(face_rays[i].side)]];
    const double u = face.camera.center_u_px + face.camera.focal_x_px * face_rays[i].at.x();
    const double v = face.camera.center_v_px + face.camera.focal_y_px * face_rays[i].at.y();
    const auto index = [&](double col, double row) {
      return static_cast<int32_t>((face.first_row + static_cast<int>(row)) * faces.sheet.width + static_cast<int>(col));
    };
    const double left = std::floor(u), top = std::floor(v), near_u = std::round(u), near_v = std::round(v);
    faces.positions[i] = {index(left, top), static_cast<uint16_t>(std::lround(256.0 * (u - left))),
                          static_cast<uint16_t>(std::lround(256.0 * (v - top)))};
    faces.nearest[i] = {index(near_u, near_v), static_cast<float>(u - near_u), static_cast<float>(v - near_v),
                        static_cast<float>(depth_is_z(camera) ? 1.0 : face_rays[i].length)};
  }
  return faces;
}

namespace {

template <int kChannels>
void interpolate(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out) {
  const size_t below = sheet.step[0];
  const LensFaces::SheetPosition* position = faces.positions.data();
  for (int row = 0; row < out.rows; ++row) {
    uint8_t* pixel = out.ptr<uint8_t>(row);
    for (int col = 0; col < out.cols; ++col, ++position, pixel += kChannels) {
      if (position->index < 0) {
        std::fill_n(pixel, kChannels, uint8_t{0});
        continue;
      }
      const uint8_t* const a = sheet.data + static_cast<size_t>(position->index) * kChannels;
      const uint32_t right = position->right, left = 256 - right, down = position->down, up = 256 - down;
      for (int c = 0; c < kChannels; ++c) {
        const uint32_t above = a[c] * left + a[c + kChannels] * right;
        const uint32_t beneath =
            a[below + static_cast<size_t>(c)] * left + a[below + static_cast<size_t>(c) + kChannels] * right;
        pixel[c] = static_cast<uint8_t>((above * up + beneath * down + (1u << 15)) >> 16);
      }
    }
  }
}

}  // namespace

void interpolate_levels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out) {
  out.create(faces.camera.height_px, faces.camera.width_px, sheet.type());
  sheet.channels() == 1 ? interpolate<1>(faces, sheet, out) : interpolate<3>(faces, sheet, out);
}

void depths_of_planes(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out) {
  out.create(faces.camera.height_px, faces.camera.width_px, CV_32FC1);
  const LensFaces::NearestPixel* near = faces.nearest.data();
  for (int row = 0; row < out.rows; ++row) {
    for (int col = 0; col < out.cols; ++col, ++near) {
      float& depth_m = out.at<float>(row, col);
      depth_m = std::numeric_limits<float>::quiet_NaN();
      if (near->index < 0) continue;
      const auto& plane = reinterpret_cast<const cv::Vec4f*>(sheet.data)[near->index];
      const float per_z = plane[0] + near->right * plane[1] + near->down * plane[2];
      depth_m = near->per_depth / (per_z > 0.0f ? per_z : plane[0]);  // division by 0 for the sky
    }
  }
}

void labels_of_nearest(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out) {
  out.create(faces.camera.height_px, faces.camera.width_px, CV_32SC1);
  const LensFaces::NearestPixel* near = faces.nearest.data();
  for (int row = 0; row < out.rows; ++row) {
    int* label = out.ptr<int>(row);
    for (int col = 0; col < out.cols; ++col, ++near, ++label) {
      *label = near->index < 0 ? 0 : reinterpret_cast<const int*>(sheet.data)[near->index];
    }
  }
}

}  // namespace hedgehop::sim
