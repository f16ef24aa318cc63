#include "scenes/mesh/polygon.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace hedgehop::scenes::mesh {
namespace {

using Eigen::Vector3d;
using Triangles = std::vector<std::array<uint32_t, 3>>;

constexpr double kRounding = 1e-9;

// Twice the area as a vector.
Vector3d across(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return (b - a).cross(c - a); }

// Twice the area of a polygon as a vector, by the shoelace formula.
Vector3d across(const std::vector<Vector3d>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (size_t i = 0; i < corners.size(); ++i) sum += corners[i].cross(corners[(i + 1) % corners.size()]);
  return sum;
}

// If all triangles are in the orientation of the polygon and have its area, they cover it without overlap.
void expect_cover(const std::vector<Vector3d>& corners) {
  const Triangles triangles = triangles_of_polygon(corners);
  ASSERT_EQ(triangles.size(), corners.size() - 2);
  const Vector3d whole = across(corners);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = across(corners[a], corners[b], corners[c]).dot(whole.normalized());
    EXPECT_GE(area, -kRounding);
    sum += area;
  }
  EXPECT_NEAR(sum, whole.norm(), kRounding * whole.norm());
}

std::vector<Vector3d> flat(const std::vector<std::pair<double, double>>& corners) {
  std::vector<Vector3d> result;
  for (const auto& [x, y] : corners) result.emplace_back(x, y, 0.0);
  return result;
}

TEST(Polygon, AConvexOneIsAFanAroundItsFirstCorner) {
  const std::vector<Vector3d> square = flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  EXPECT_EQ(triangles_of_polygon(square), (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangles_of_polygon(flat({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}})),
            (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_EQ(triangles_of_polygon(std::span(square).first(3)), (Triangles{{0, 1, 2}}));
}

TEST(Polygon, AConcaveOneIsCoveredFromEveryFirstCornerInBothOrientations) {
  for (std::vector<Vector3d> corners :
       {flat({{0, 10}, {-0.1, -1}, {0, 0}, {0.1, -1}}),  // an arrow, whose short diagonal is outside
        flat({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 1}, {1, 1}, {1, 4}, {0, 4}}),  // a U
        flat({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}),          // an L with a straight corner
        flat(
            {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}})}) {  // a bridge to a hole
    for (size_t first = 0; first < corners.size(); ++first) {
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      expect_cover(corners);
      expect_cover({corners.rbegin(), corners.rend()});
    }
  }
}

TEST(Polygon, StarsInAnyPlaneFarFromTheOriginAreCovered) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> radius(0.2, 3.0), share(-1.0, 1.0);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Quaterniond turned =
        Eigen::Quaterniond(share(random), share(random), share(random), share(random)).normalized();
    std::vector<Vector3d> corners;
    for (int i = 0; i < 5 + k; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / (5 + k), r = radius(random);
      corners.push_back(turned * Vector3d(r * std::cos(angle), r * std::sin(angle), 0.0) + Vector3d(30, -20, 10));
    }
    expect_cover(corners);
  }
}

TEST(Polygon, OneWithoutAnInsideGivesItsNumberOfTriangles) {
  EXPECT_EQ(triangles_of_polygon(std::vector<Vector3d>(6, Vector3d::Ones())).size(), 4u);
  EXPECT_EQ(triangles_of_polygon(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).size(), 2u);  // crosses itself
  EXPECT_EQ(triangles_of_polygon(std::vector<Vector3d>(5, Vector3d::Constant(std::nan("")))).size(), 3u);
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
