#pragma once

#include <opencv2/core.hpp>

#include "sim/libm/random.h"

namespace hedgehop::scenes::textures {

/// Spectrum of a noise image: `octaves` layers of value noise. The first lattice has `cells_u` x `cells_v` cells; each
/// further layer doubles the number of cells in both directions and multiplies the amplitude by `gain`.
struct NoiseShape {
  int cells_u = 4;
  int cells_v = 4;
  int octaves = 7;
  double gain = 0.75;
};

/// Returns tileable noise with mean 0 and standard deviation 1. Lattices finer than the pixels are omitted.
cv::Mat1f fractal_noise(int size_px, const NoiseShape& shape, Random& random);

}  // namespace hedgehop::scenes::textures
