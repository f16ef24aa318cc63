#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes::mesh {

/// Triangles to draw and to collide with.
struct Triangles {
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> faces;
  std::vector<bool> is_two_sided;  ///< one per face
};

/// Returns the triangles with their image clamped along an axis (0: u, 1: v). They are cut at the edges of the image;
/// outside, the coordinate is that of the edge. @param size_px  of the texture.
Triangles clamped(const Triangles& triangles, int axis, int size_px);

/// Returns the triangles without their holes. The image is divided into up to 64 x 64 cells; a cell is a hole if its
/// mean opacity is below the cutoff. A triangle of a uniform opacity stays whole.
/// @param opacity  CV_8UC1, square, which repeats. @param cutoff  0..1.
Triangles without_holes(const Triangles& triangles, const cv::Mat& opacity, float cutoff);

}  // namespace hedgehop::scenes::mesh
