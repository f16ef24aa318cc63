#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "vision/camera/camera.h"

namespace hedgehop::sim {

/// How an image of any lens is put together from pinhole images ("faces"): one for a lens that sees little aside, up
/// to six sides of a cube otherwise, each only as large as its part of the image needs. The faces' images lie below
/// each other in one sheet. They reach far enough past each other that the four neighbors of a place lie in one face.
struct LensFaces {
  struct Face {
    vision::camera::PinholeCamera camera;
    Eigen::Matrix3d R_CK = Eigen::Matrix3d::Identity();
    int first_row = 0;  ///< in the sheet
  };
  /// Where a pixel is found in the sheet.
  struct Place {
    int32_t index = -1;            ///< of the pixel above and left of it, row by row; -1 where the lens shows nothing
    uint16_t right = 0, down = 0;  ///< the way from there to the pixels on the right and below, 1/256
  };
  /// The same, for images that must not be mixed: the nearest pixel.
  struct Nearest {
    int32_t index = -1;
    float right = 0.0f, down = 0.0f;  ///< the way from there, px, at most half a pixel
    float per_depth = 1.0f;           ///< what to multiply z in F with to get the depth that the camera's image holds
  };

  vision::camera::Camera camera;
  std::vector<Face> faces;
  cv::Size sheet;
  std::vector<Place> places;     ///< of each pixel of the image, row by row
  std::vector<Nearest> nearest;  ///< likewise
};

/// Whether a camera's depth is z in C; else it is the distance along the ray.
bool depth_is_z(const vision::camera::Camera& camera);

/// @param camera  anything that vision::check() accepts. Faces are as finely divided as the image is, on average.
LensFaces make_lens_faces(const vision::camera::Camera& camera);

// Each makes the image from a sheet of its faces. @param out  created when its size or type does not fit.
/// @param sheet  CV_8UC1 or CV_8UC3. Pixels are mixed from four; 0 where the lens shows nothing.
void mix_levels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// @param sheet  Raster::planes. Depth in m, CV_32FC1: the surface of the nearest pixel, where the ray meets its plane;
/// +infinity for sky, NaN where the lens shows nothing.
void meet_planes(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);
/// @param sheet  CV_32SC1. The nearest pixel's value; 0 where the lens shows nothing.
void pick_labels(const LensFaces& faces, const cv::Mat& sheet, cv::Mat& out);

}  // namespace hedgehop::sim
