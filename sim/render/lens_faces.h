#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// How an image of any lens is composed of pinhole images ("faces"): one for a lens with a narrow view, else up to six
/// sides of a cube, each only as large as its part of the image needs. The faces' images lie below each other in one
/// sheet. They overlap far enough that the four neighbors of a sampled position lie in one face. Cf: frame of a face,
/// its origin and handedness those of C, z through the middle of the cube's side.
struct LensFaces {
  struct Face {
    vision::camera::PinholeCamera camera;
    Eigen::Matrix3d R_CCf = Eigen::Matrix3d::Identity();
    int first_row = 0;  ///< in the sheet
  };
  /// Position of a pixel in the sheet.
  struct Place {
    int32_t index = -1;            ///< of the pixel above and left of it, row by row; -1 where the lens shows nothing
    uint16_t right = 0, down = 0;  ///< offset from there to the right and down, 1/256 px
  };
  /// The same, for images that must not be interpolated: the nearest pixel.
  struct Nearest {
    int32_t index = -1;
    float right = 0.0f, down = 0.0f;  ///< offset from there, px, at most half a pixel
    float per_depth = 1.0f;           ///< depth in the camera's image over z in Cf
  };

  vision::camera::Camera camera;
  std::vector<Face> faces;
  cv::Size sheet;
  std::vector<Place> places;     ///< of each pixel of the image, row by row
  std::vector<Nearest> nearest;  ///< likewise
};

/// Whether a camera's depth is z in C; else it is the distance along the ray.
bool depth_is_z(const vision::camera::Camera& camera);

/// @param camera  anything that vision::check() accepts. Faces have the image's resolution, on average.
LensFaces make_lens_faces(const vision::camera::Camera& camera);

// Each makes the image from a sheet of its faces. @param out  created when its size or type does not fit.
/// @param sheet  CV_8UC1 or CV_8UC3. Pixels are interpolated from four; 0 where the lens shows nothing.
void mix_levels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// @param sheet  Raster::planes. Depth in m, CV_32FC1: the surface of the nearest pixel, where the ray meets its plane;
/// +infinity for sky, NaN where the lens shows nothing.
void meet_planes(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// @param sheet  CV_32SC1. The nearest pixel's value; 0 where the lens shows nothing.
void pick_labels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);

}  // namespace hedgehop::sim
