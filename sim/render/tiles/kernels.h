#pragma once

#include "sim/render/raster.h"
#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// Memory of an image, row 0 on top.
struct Image {
  uint8_t* data;
  size_t step;  ///< bytes from row to row
};

/// A box along the axes of the frame of the facets.
struct Box {
  float low_m[3], high_m[3];
};

/// From where the next image is taken. Cn: C then.
struct NextView {
  double R_CnC[9];        ///< row by row
  const double* p_CnC_m;  ///< three for each of Frame::eyes, as what stands still with it sees it
};

/// The loops over facets and over pixels, compiled for one kind of processor. All give the same bits.
struct Kernels {
  const char* lanes;  ///< what they are made for

  /// Draws facets into a frame that has room for as many surfaces. @param eye  into Frame::eyes.
  void (*draw)(Frame& frame, const SceneView& scene, uint32_t first, uint32_t count, uint32_t eye, double near_m);

  /// True only when nothing in a box can be seen past what was drawn so far.
  bool (*hides)(const Frame& frame, const Eye& eye, const Box& box, double near_m);

  /// Makes the image. Several samples a pixel for grey and color only.
  void (*finish)(const SceneView& scene, Frame& frame, Raster raster, const Image& image);

  /// Makes an image of the flow until the next one, CV_32FC2, as Channel::flow.
  void (*flow)(const Frame& frame, const NextView& next, const Image& image);
};

extern const Kernels kPlainKernels;
#ifdef __x86_64__
extern const Kernels kAvx2Kernels, kAvx512Kernels;
#endif

/// The fastest that this processor can run at speed, or those that the environment variable HEDGEHOP_TILES names:
/// "avx512", "avx2", or "plain", which runs anywhere, slowly. Throws std::runtime_error, with the remedy, when there
/// are none.
const Kernels& chosen_kernels();

}  // namespace hedgehop::sim::tiles
