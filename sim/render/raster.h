#pragma once

namespace hedgehop::sim {

/// What is put into a pixel of an undistorted pinhole's image.
enum class Raster {
  grey,    ///< CV_8UC1
  color,   ///< CV_8UC3, RGB
  depth,   ///< CV_32FC1, z in C, m; +infinity where nothing but sky is seen
  planes,  ///< CV_32FC4: 1 / z in C, 1/m, and how it changes to the next pixel on the right and below: the surface's
           ///< own plane; 0 for sky
  labels,  ///< CV_32SC1
};

/// OpenCV's type of an image of this raster.
int type_of(Raster raster);

}  // namespace hedgehop::sim
