#pragma once

#include "sim/render/drawing_options.h"
#include "sim/render/tiles/frame.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// Memory of an image; row 0 is the top row.
struct ImageMemory {
  uint8_t* data;
  size_t step;  ///< bytes per row
};

/// An axis-aligned box in the frame of the facets.
struct Box {
  float low_m[3], high_m[3];
};

/// Pose of C in Cn, C at the time of the next image, for points fixed in the frame of one of Frame::poses.
struct NextPose {
  double R_CnC[9];  ///< row-major
  double p_CnC_m[3];
};

/// The loops over facets and pixels, compiled for one type of processor. All give the same bits.
struct Kernels {
  const char* lanes;  ///< instruction set

  /// Draws facets into a frame. The frame has space for this number of surfaces. @param pose  index in Frame::poses.
  void (*draw)(Frame& frame, const SceneView& scene, uint32_t first, uint32_t count, uint32_t pose, double near_m);

  /// Returns true only if the facets drawn so far hide the whole box.
  bool (*hides)(const Frame& frame, const ViewPose& pose, const Box& box, double near_m);

  /// Writes the image. Several samples per pixel for grey and color only.
  void (*finish)(const SceneView& scene, Frame& frame, Raster raster, const ImageMemory& image);

  /// Writes the flow until the next image, CV_32FC2, as ImageChannel::flow. @param next  one for each of Frame::poses;
  /// the sky turns with the first.
  void (*flow)(const Frame& frame, const NextPose* next, const ImageMemory& image);
};

extern const Kernels kPlainKernels;
#ifdef __x86_64__
extern const Kernels kAvx2Kernels, kAvx512Kernels;
#endif

/// Returns the fastest kernels that this processor supports. The environment variable HEDGEHOP_TILES selects others:
/// "avx512", "avx2", or "plain", which is slow and runs on every processor. All kernels give the same bits.
/// Throws std::runtime_error that names a remedy if there are none.
const Kernels& chosen_kernels();

}  // namespace hedgehop::sim::tiles
