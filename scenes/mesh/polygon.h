#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hedgehop::scenes::mesh {

/// Returns n - 2 triangles that cover a polygon, also a concave one, with its order of corners: ears are cut off until
/// a triangle is left. A polygon that is not flat is projected along its mean normal. One that crosses itself gives
/// triangles of any shape.
/// @param corners  n >= 3.
/// @return indices of the corners. A convex polygon is a fan around corner 0.
/// Source: after [Meisters1975]. Cost is quadratic in n.
std::vector<std::array<uint32_t, 3>> triangles_of_polygon(std::span<const Eigen::Vector3d> corners);

}  // namespace hedgehop::scenes::mesh
