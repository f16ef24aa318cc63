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

/// Eight axis-aligned boxes in the frame of the facets, as lanes of vectors.
struct alignas(32) EightBoxes {
  float low_m[3][8], high_m[3][8];
};

/// The pixels around a box, both ends included, and its max 1 / z, 1/m; infinite for a box that crosses the near plane,
/// which has no pixels.
struct PixelBox {
  int left, right, top, bottom;
  float nearest;
};

/// Error bound of the float operations on boxes, relative to their distance.
inline constexpr float kFloatError = 1e-6f;

/// A camera as boxes in W or M need it.
struct BoxCamera {
  float eye_m[3], eye_rest_m[3];  ///< position of C as a sum of two floats
  float R_CW[3][3];
  float sides[4][3];     ///< inward normals of the sides of the image with a margin of one pixel
  float side_errors[4];  ///< error bound of a product with a normal, relative to the distance
  float focal_px[2], center_px[2];
  float near_m;
};

/// Eight boxes as a camera sees them.
struct EightViews {
  PixelBox pixels[8];
  alignas(32) float distance2_m2[8];  ///< square of the horizontal distance
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
  bool (*hides_pixels)(const Frame& frame, const PixelBox& box);

  /// Returns which of eight boxes the image may show, lane 0 in the lowest bit, and sets their views.
  /// @param lanes  boxes to test. @param behind_facets  whether boxes behind the facets drawn so far are included.
  uint32_t (*see)(const Frame& frame, const BoxCamera& camera, const EightBoxes& boxes, uint32_t lanes,
                  bool behind_facets, EightViews& views);

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
/// Throws InputError that names a remedy if there are none.
const Kernels& chosen_kernels();

}  // namespace hedgehop::sim::tiles
