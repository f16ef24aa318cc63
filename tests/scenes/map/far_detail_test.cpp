#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "scenes/map/building_mesh.h"
#include "scenes/map/ground_mesh.h"
#include "scenes/map/map_trees.h"
#include "scenes/terrain/coarse_block.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Triangle3 = std::array<Vector3d, 3>;

constexpr double kSinglePrecisionM = 1e-4;

std::vector<Triangle3> triangles_of(const Mesh& mesh, bool far) {
  const Chunk& chunk = mesh.chunks.at(0);
  const auto& indices = far ? mesh.far_indices : mesh.indices;
  const size_t first = far ? chunk.far.first_index : chunk.first_index,
               count = far ? chunk.far.index_count : chunk.index_count;
  std::vector<Triangle3> triangles;
  for (size_t i = first; i < first + count; i += 3) {
    const auto corner = [&](size_t k) -> Vector3d { return mesh.vertices[indices[i + k]].p_W.cast<double>(); };
    triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return triangles;
}

/// Returns the maximum distance along a ray to a triangle; nullopt if it meets none.
std::optional<double> farthest_m(const std::vector<Triangle3>& triangles, const Vector3d& from, const Vector3d& ray) {
  std::optional<double> farthest;
  for (const auto& [a, b, c] : triangles) {
    Eigen::Matrix3d system;
    system << b - a, c - a, -ray;
    if (std::abs(system.determinant()) < 1e-12) continue;
    const Vector3d x = system.inverse() * (from - a);
    if (x[0] >= 0.0 && x[1] >= 0.0 && x[0] + x[1] <= 1.0 && x[2] >= 0.0)
      farthest = std::max(farthest.value_or(0.0), x[2]);
  }
  return farthest;
}

struct Built {
  Mesh mesh;
  std::vector<Solid> solids;
};

/// A building 9 m high with a roof of 3 m.
Built build(const PlanRing& outline, RoofShape roof) {
  const MapBuilding building{
      .name = "way 1", .footprints = {{outline, {}}}, .height_m = 9.0, .roof = roof, .roof_height_m = 3.0};
  Built built;
  std::vector<std::string> faults;
  Random random(5);
  mesh::MeshBuilder mesh("opaque");
  add_map_building(building, {}, {}, random, mesh, built.solids, faults);
  built.mesh = mesh.finish();
  return built;
}

PlanRing turned(PlanRing ring, double turn_rad) {
  for (Vector2d& p : ring) p = Eigen::Rotation2Dd(turn_rad) * p;
  return ring;
}

TEST(MapFarDetails, RoofsAreWithinHalfTheLostWidth) {
  const PlanRing rectangle = turned({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, 0.3);
  for (const RoofShape roof : {RoofShape::gabled, RoofShape::hipped, RoofShape::pyramidal, RoofShape::skillion}) {
    const Mesh mesh = build(rectangle, roof).mesh;
    const FarDetail& far = mesh.chunks.at(0).far;
    EXPECT_LT(far.index_count, mesh.chunks.at(0).index_count);
    const auto near_triangles = triangles_of(mesh, false), far_triangles = triangles_of(mesh, true);
    Random random(6);
    double largest_m = 0.0;
    for (int k = 0; k < 500; ++k) {
      const Vector2d p = Eigen::Rotation2Dd(0.3) * Vector2d(uniform(random, 0.01, 19.99), uniform(random, 0.01, 9.99));
      const Vector3d under(p.x(), p.y(), 1.0), up(0.0, 0.0, -1.0);
      const double change_m =
          std::abs(farthest_m(near_triangles, under, up).value() - farthest_m(far_triangles, under, up).value());
      largest_m = std::max(largest_m, change_m);
    }
    EXPECT_LE(largest_m, 0.5 * static_cast<double>(far.lost_m) + kSinglePrecisionM);
    EXPECT_GT(largest_m, 0.4 * static_cast<double>(far.lost_m));
  }
}

TEST(MapFarDetails, CrownsAreWithinHalfTheLostWidthInEveryDirection) {
  MapTree tree{"node 1", {3.0, -4.0}, 10.0, 2.5};
  std::vector<Solid> solids;
  std::vector<std::string> faults;
  mesh::MeshBuilder builder("opaque");
  add_map_trees({tree}, {}, {}, 7, builder, solids, faults);
  const Mesh mesh = builder.finish();
  const auto near_triangles = triangles_of(mesh, false), far_triangles = triangles_of(mesh, true);
  const Vector3d middle_W(3.0, -4.0, -6.25);  // of a crown from 2.5 m to 10 m
  for (int k = 0; k < 500; ++k) {
    const Vector3d ray = mesh::spiral_direction(k, 500, 0.0);
    if (ray.z() > 0.9) continue;  // to the trunk
    EXPECT_NEAR(farthest_m(near_triangles, middle_W, ray).value(), farthest_m(far_triangles, middle_W, ray).value(),
                0.5 * static_cast<double>(mesh.chunks.at(0).far.lost_m));
  }
  EXPECT_EQ(far_triangles.size(), 8u);
}

TEST(MapFarDetails, CoresAreInsideTheirBuildings) {
  const std::vector<PlanRing> outlines{{{0, 0}, {20, 0}, {20, 10}, {0, 10}},
                                       {{0, 0}, {20, 1}, {23, 12}, {-1, 9}},
                                       {{0, 0}, {12, -3}, {22, 2}, {20, 12}, {9, 15}, {-2, 8}}};
  for (const PlanRing& outline : outlines) {
    for (const double turn_rad : {0.0, 0.2, 0.8, 1.5, 3.0}) {
      const Built built = build(turned(outline, turn_rad), RoofShape::pyramidal);
      const Eigen::AlignedBox3d core = built.mesh.chunks.at(0).core_W.cast<double>();
      EXPECT_GT(core.volume(), 100.0);
      const mesh::Polyhedron& hull = built.solids.at(0).polyhedron;
      for (int k = 0; k < 8; ++k) {
        const Vector3d corner =
            built.solids[0].X_WS.inverse() * core.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
        for (const auto& [a, b, c] : hull.faces) {
          const auto& p = hull.corners;
          const Vector3d out = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
          EXPECT_LE(out.dot(corner - p[a]), kSinglePrecisionM);
        }
      }
    }
  }
  EXPECT_TRUE(
      build({{0, 0}, {20, 0}, {20, 4}, {6, 4}, {6, 10}, {0, 10}}, RoofShape::flat).mesh.chunks[0].core_W.isEmpty());
}

/// A rough surface on a grid of 10 m.
terrain::SurfaceGrid rough_grid(int rows, int columns, double roughness_m) {
  Random random(8);
  terrain::SurfaceGrid grid{.rows = rows, .columns = columns, .points_W = {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column)
      grid.points_W.emplace_back(-10.0 * row, 10.0 * column, uniform(random, 0.0, roughness_m) + 0.3 * row - column);
  }
  return grid;
}

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

TEST(CoarseBlocks, ErrorIsTheMaximumDistanceFromTheSurface) {
  const terrain::SurfaceGrid grid = rough_grid(17, 15, 4.0);
  const terrain::CoarseBlock coarse = terrain::coarse_block(grid, {0, 16, 0, 14});
  std::vector<Triangle3> triangles;
  for (const auto& [a, b, c] : coarse.triangles)
    triangles.push_back({grid.p_W(a.row, a.column), grid.p_W(b.row, b.column), grid.p_W(c.row, c.column)});
  Random random(9);
  double largest_m = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    const Vector2d p(uniform(random, -159.9, -0.1), uniform(random, 0.1, 139.9));
    const Vector3d under(p.x(), p.y(), 100.0), up(0.0, 0.0, -1.0);
    const double altitude_m = farthest_m(triangles, under, up).value() - 100.0;
    largest_m = std::max(largest_m, std::abs(altitude_m - grid.altitude_m(p).value()));
  }
  EXPECT_LE(largest_m, coarse.error_m + 1e-9);
  EXPECT_GT(largest_m, 0.9 * coarse.error_m);
}

TEST(CoarseBlocks, CoverTheirBlockAndMeetTheSurfaceAtItsBorder) {
  for (const auto& [rows, columns] : {std::pair{17, 17}, {17, 14}, {12, 16}, {10, 10}, {9, 9}}) {
    const terrain::SurfaceGrid grid = rough_grid(rows, columns, 4.0);
    const terrain::CoarseBlock coarse = terrain::coarse_block(grid, {0, rows - 1, 0, columns - 1});
    double area = 0.0;
    int border = 0;
    for (const terrain::GridTriangle& triangle : coarse.triangles) {
      const auto at = [&](size_t k) { return Vector2d(triangle[k % 3].row, triangle[k % 3].column); };
      const double own = 0.5 * cross(at(1) - at(0), at(2) - at(0));
      EXPECT_GT(own, 0.0);
      area += own;
      for (size_t k = 0; k < 3; ++k) {
        const Vector2d step = at(k + 1) - at(k);
        const bool along_row = step.x() == 0.0 && (at(k).x() == 0.0 || at(k).x() == rows - 1),
                   along_column = step.y() == 0.0 && (at(k).y() == 0.0 || at(k).y() == columns - 1);
        if (!along_row && !along_column) continue;
        EXPECT_EQ(step.norm(), 1.0);
        ++border;
      }
    }
    EXPECT_EQ(area, (rows - 1) * (columns - 1));
    EXPECT_EQ(border, 2 * (rows - 1 + columns - 1));
    EXPECT_LT(coarse.triangles.size(), static_cast<size_t>(2 * (rows - 1) * (columns - 1)));
  }
}

TEST(CoarseBlocks, APlaneHasNoErrorAndAHoleHasNoCoarseForm) {
  terrain::SurfaceGrid grid = rough_grid(17, 17, 0.0);
  EXPECT_NEAR(terrain::coarse_block(grid, {0, 16, 0, 16}).error_m, 0.0, 1e-9);
  EXPECT_TRUE(terrain::coarse_block(grid, {0, 16, 0, 4}).triangles.empty());
  grid.points_W[40].z() = std::nan("");
  EXPECT_TRUE(terrain::coarse_block(grid, {0, 16, 0, 16}).triangles.empty());
}

TEST(MapStreets, DrapedStreetsCoverTheirPlanOnTheGround) {
  const terrain::SurfaceGrid grid = rough_grid(17, 17, 4.0);
  // It runs south, 10 m wide, with a repeat of the texture every 8 m.
  const StreetTriangle street{{Vector2d(-20, 15), Vector2d(-140, 15), Vector2d(-140, 25)},
                              {Vector2d(0, 0), Vector2d(0, 15), Vector2d(-1, 15)},
                              3,
                              0.07};
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> faces;
  for (const auto& [a, b, c] : terrain::triangles_of(grid, {0, 16, 0, 16}))
    drape(street, {grid.p_W(a.row, a.column), grid.p_W(b.row, b.column), grid.p_W(c.row, c.column)}, vertices, faces);
  double area_m2 = 0.0;
  for (const auto& face : faces) {
    const auto p = [&](size_t k) -> Vector2d { return vertices[face[k]].p_W.head<2>().cast<double>(); };
    area_m2 -= 0.5 * cross(p(1) - p(0), p(2) - p(0));  // counter-clockwise from above has this sign in north and east
  }
  EXPECT_NEAR(area_m2, 600.0, 1e-2);
  for (const Vertex& vertex : vertices) {
    const Vector3d p_W = vertex.p_W.cast<double>();
    EXPECT_NEAR(-p_W.z(), grid.altitude_m(p_W.head<2>()).value() + street.lift_m, 1e-3);
    EXPECT_NEAR(static_cast<double>(vertex.uv.x()), (15.0 - p_W.y()) / 10.0, kSinglePrecisionM);
    EXPECT_NEAR(static_cast<double>(vertex.uv.y()), (-20.0 - p_W.x()) / 8.0, kSinglePrecisionM);
    EXPECT_EQ(vertex.texture, 3u);
  }
}

}  // namespace
}  // namespace hedgehop::scenes::map
