#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// The composition of an image of any lens from pinhole images ("faces"). A lens with a narrow view has one face. Other
/// lenses have up to six faces, the sides of a cube, each cropped to its part of the image. The images of the faces are
/// stacked in one sheet. They overlap, so that the four neighbors of a sampled position are in one face. Cf is the
/// frame of a face: origin and handedness of C, z through the middle of the side of the cube.
struct LensFaces {
  struct Face {
    vision::camera::PinholeCamera camera;
    Eigen::Matrix3d R_CCf = Eigen::Matrix3d::Identity();
    int first_row = 0;  ///< in the sheet
  };
  /// Position of a pixel in the sheet, for interpolation.
  struct SheetPosition {
    int32_t index = -1;            ///< of the pixel above left in row-major order; -1 outside the image circle
    uint16_t right = 0, down = 0;  ///< offset from that pixel, 1/256 px
  };
  /// Pixel of the sheet nearest to a pixel of the image, for values that must not be interpolated.
  struct NearestPixel {
    int32_t index = -1;
    float right = 0.0f, down = 0.0f;  ///< offset from that pixel, px, at most half a pixel
    float per_depth = 1.0f;           ///< depth in the camera image divided by z in Cf
  };

  vision::camera::Camera camera;
  std::vector<Face> faces;
  cv::Size sheet;
  std::vector<SheetPosition> positions;  ///< of each pixel of the image, row-major
  std::vector<NearestPixel> nearest;     ///< likewise
};

/// Returns whether the depth of a camera is z in C. Otherwise it is the distance along the ray.
bool depth_is_z(const vision::camera::Camera& camera);

/// Returns the faces of a camera. Their mean resolution is that of the image.
/// @param camera  any camera that vision::check() accepts.
LensFaces make_lens_faces(const vision::camera::Camera& camera);

// Each of the following functions composes the image from a sheet. `out` is created if its size or type differs.

/// Interpolates each pixel from four; 0 outside the image circle. @param sheet  CV_8UC1 or CV_8UC3.
void interpolate_levels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// Writes depth, m, CV_32FC1: the intersection of the ray with the plane of the surface at the nearest pixel. +infinity
/// for the sky, NaN outside the image circle. @param sheet  of Raster::planes.
void depths_of_planes(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// Writes the value of the nearest pixel; 0 outside the image circle. @param sheet  CV_32SC1.
void labels_of_nearest(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);

}  // namespace hedgehop::sim
