#pragma once

#include <cstdint>
#include <random>

#include "vision/camera/camera.h"

#include "sim/libm/random.h"

/// Random cameras of every kind for property tests.
namespace hedgehop::vision {

inline camera::Camera random_distorted_pinhole(std::mt19937_64& random) {
  camera::PinholeLens lens{uniform(random, 250, 500), uniform(random, 250, 500), uniform(random, 150, 170),
                           uniform(random, 110, 130)};
  lens.k1 = uniform(random, -0.35, 0.3);
  lens.k2 = uniform(random, -0.05, 0.15);
  lens.p1 = uniform(random, -5e-3, 5e-3);
  lens.p2 = uniform(random, -5e-3, 5e-3);
  lens.k3 = uniform(random, -0.01, 0.02);
  return {320, 240, lens};
}

inline camera::Camera random_fisheye(std::mt19937_64& random) {
  camera::FisheyeLens lens{uniform(random, 70, 130), uniform(random, 70, 130), uniform(random, 150, 170),
                           uniform(random, 110, 130)};
  lens.k1 = uniform(random, -0.05, 0.05);
  lens.k2 = uniform(random, -0.01, 0.01);
  lens.k3 = uniform(random, -2e-3, 2e-3);
  lens.k4 = uniform(random, -2e-4, 2e-4);
  lens.limit_rad = lens.growth_limit_rad();
  return {320, 240, lens};
}

inline camera::Camera random_rational_pinhole(std::mt19937_64& random) {
  camera::Camera camera = random_distorted_pinhole(random);
  auto& lens = std::get<camera::PinholeLens>(camera.lens);
  lens.k4 = uniform(random, -0.1, 0.3);
  lens.k5 = uniform(random, -0.05, 0.1);
  lens.k6 = uniform(random, -0.01, 0.02);
  return camera;
}

/// As random_distorted_pinhole(), behind a sphere moved by 0 to 2: up to beyond 180 degrees.
inline camera::Camera random_unified(std::mt19937_64& random) {
  camera::Camera camera = random_distorted_pinhole(random);
  auto plane = std::get<camera::PinholeLens>(camera.lens);
  plane.k3 = 0.0;
  camera.lens = camera::UnifiedLens{plane, uniform(random, 0.0, 2.0)};
  return camera;
}

inline camera::Camera random_double_sphere(std::mt19937_64& random) {
  camera::DoubleSphereLens lens{uniform(random, 70, 130), uniform(random, 70, 130), uniform(random, 150, 170),
                                uniform(random, 110, 130)};
  lens.xi = uniform(random, -0.3, 0.4);
  lens.alpha = uniform(random, 0.3, 0.7);
  return {320, 240, lens};
}

/// A synthetic calibration in OCamCalib's format: 752 x 480 px, about 200 degrees across.
inline constexpr const char* kSmallCalibration = R"(#polynomial coefficients for the direct mapping function

5 -2.2e+02 0.0 1.6e-03 -2.1e-06 8.0e-09

#polynomial coefficients for the inverse mapping function, not fitted to the other

2 330.0 190.0

#center: "row" and "column", starting from 0 (C convention)

241.25 374.5

#affine parameters "c", "d", "e"

0.9985 0.0004 -0.0003

#image size: "height" and "width"

480 752
)";

}  // namespace hedgehop::vision
