#pragma once

namespace hedgehop::sim {

/// Whether the image shows shadows of the sun.
enum class Shadows { none, sun };

/// The parts of a scene that are skipped because the camera cannot see them. The choice affects the cost only: images
/// are equal, except for pixels at a crack of a mesh, which may show a different background.
enum class Culling { none, frustum, frustum_and_horizon };

/// The pixel values of an undistorted pinhole image.
enum class Raster {
  grey,    ///< CV_8UC1
  color,   ///< CV_8UC3, RGB
  depth,   ///< CV_32FC1, z in C, m; +infinity for the sky
  planes,  ///< CV_32FC4: 1 / z in C, 1/m; its change to the next pixel right; its change to the next pixel down, both
           ///< of the surface's plane; 0. All 0 for the sky
  labels,  ///< CV_32SC1
};

/// Returns OpenCV's type of an image of this raster.
int type_of(Raster raster);

}  // namespace hedgehop::sim
