#include "scenes/mesh/bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;

// A direction of texture projection, with the image's right and down as seen by the viewer.
struct ProjectionSide {
  Vector3d out, right, down;
};

// The axes and the diagonals between two or three of them. They stretch the texture of a face by an eighth at most.
std::vector<ProjectionSide> make_sides() {
  std::vector<ProjectionSide> sides;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the zero vector
    const Vector3d out = Vector3d(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1).normalized();
    const bool upright = out.head<2>().isZero();
    const Vector3d right = upright ? Vector3d(0.0, -out.z(), 0.0) : Vector3d(out.y(), -out.x(), 0.0).normalized();
    sides.push_back({out, right, right.cross(out)});
  }
  return sides;
}

const std::vector<ProjectionSide>& sides() {
  static const std::vector<ProjectionSide> all = make_sides();
  return all;
}

size_t side_index(const Vector3d& n) {
  const auto nearest =
      std::ranges::max_element(sides(), {}, [&](const ProjectionSide& side) { return side.out.dot(n); });
  return static_cast<size_t>(nearest - sides().begin());
}

std::vector<Vector3d> smooth_normals(const Polyhedron& body) {
  std::vector<Vector3d> normals(body.corners.size(), Vector3d::Zero());
  for (const auto& [a, b, c] : body.faces) {
    const Vector3d n = (body.corners[b] - body.corners[a]).cross(body.corners[c] - body.corners[a]);
    for (const uint32_t corner : {a, b, c}) normals[corner] += n;  // weighted by area
  }
  for (Vector3d& n : normals) n.normalize();
  return normals;
}

}  // namespace

void add_polyhedron(const Polyhedron& body, Shading shading, const Cover& cover, MeshBuilder& mesh) {
  const std::vector<Vector3d> normals = smooth_normals(body);
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> faces;
  std::map<std::pair<uint32_t, size_t>, uint32_t> known;  // vertex of a corner per projection
  for (const std::array<uint32_t, 3>& face : body.faces) {
    const Vector3d a = body.corners[face[0]];
    const Vector3d across = (body.corners[face[1]] - a).cross(body.corners[face[2]] - a);
    const size_t from = side_index(across);
    const ProjectionSide& side = sides()[from];
    if (shading == Shading::flat) known.clear();
    std::array<uint32_t, 3>& added = faces.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = known.try_emplace({face[k], from}, static_cast<uint32_t>(vertices.size()));
      added[k] = at->second;
      if (!is_new) continue;
      const Vector3d p_W = body.corners[face[k]];
      const Eigen::Vector2d uv = cover.offset + Eigen::Vector2d(side.right.dot(p_W), side.down.dot(p_W)) / cover.tile_m;
      const Vector3d n = shading == Shading::flat ? across.normalized() : normals[face[k]];
      vertices.push_back({p_W.cast<float>(), n.cast<float>(), uv.cast<float>(), cover.texture});
    }
  }
  mesh.add(vertices, faces);
}

void add_post(const Post& post, int sides, const Cover& cover, MeshBuilder& mesh) {
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> faces;
  const Vector3d up(0.0, 0.0, -post.height_m);
  const auto add = [&](const Vector3d& p_W, const Vector3d& n_W, const Eigen::Vector2d& at_m) {
    const Eigen::Vector2d uv = cover.offset + at_m / cover.tile_m;
    vertices.push_back({p_W.cast<float>(), n_W.cast<float>(), uv.cast<float>(), cover.texture});
    return static_cast<uint32_t>(vertices.size() - 1);
  };
  const auto out = [sides](int k) -> Vector3d {
    const double turn = 2.0 * std::numbers::pi * k / sides;
    return {std::cos(turn), std::sin(turn), 0.0};
  };

  // The lateral surface: the viewer's right is opposite to the direction of rotation.
  for (int k = 0; k <= sides; ++k) {
    const Vector3d p_W = post.foot_W + post.radius_m * out(k % sides);
    const double across_m = -2.0 * std::numbers::pi * post.radius_m * k / sides;
    const uint32_t foot = add(p_W, out(k % sides), {across_m, 0.0});
    add(p_W + up, out(k % sides), {across_m, -post.height_m});
    if (k == sides) break;
    faces.push_back({foot + 3, foot + 2, foot});
    faces.push_back({foot + 3, foot, foot + 1});
  }

  // The top face: up in its image is north.
  uint32_t first = 0;
  for (int k = 0; k < sides; ++k) {
    const Vector3d rim = post.radius_m * out(k);
    const uint32_t corner = add(post.foot_W + up + rim, -Vector3d::UnitZ(), {rim.y(), -rim.x()});
    if (k == 0) first = corner;
    if (k >= 2) faces.push_back({first, corner, corner - 1});
  }
  mesh.add(vertices, faces);
}

void add_box(const Eigen::AlignedBox3d& box_K, const Eigen::Isometry3d& X_WK, const Cover& cover, MeshBuilder& mesh) {
  const auto add = [&](const TexturedPanel& panel) {
    const TexturedPanel placed{X_WK * panel.top_left_W, X_WK.linear() * panel.right_m, X_WK.linear() * panel.down_m};
    const Eigen::Vector2d from_origin_m(placed.right_m.normalized().dot(placed.top_left_W),
                                        placed.down_m.normalized().dot(placed.top_left_W));
    mesh.add_tiled(placed, cover.tile_m, cover.offset + from_origin_m / cover.tile_m, cover.texture);
  };
  for (const TexturedPanel& panel : side_panels(box_K)) add(panel);
  add(top_panel(box_K));
  constexpr double kOnGroundM = 1e-6;
  using Corner = Eigen::AlignedBox3d::CornerType;
  const auto is_above_ground = [&](Corner corner) { return (X_WK * box_K.corner(corner)).z() < -kOnGroundM; };
  constexpr Corner kBottom[] = {Corner::BottomLeftCeil, Corner::BottomRightCeil, Corner::TopLeftCeil,
                                Corner::TopRightCeil};
  if (std::ranges::any_of(kBottom, is_above_ground)) add(bottom_panel(box_K));
}

Solid solid_of(const std::string& name, const Post& post) {
  Solid solid;
  solid.name = name;
  solid.shape = Solid::Shape::cylinder;
  solid.X_WS.translation() = post.foot_W - Vector3d(0.0, 0.0, 0.5 * post.height_m);
  solid.half_extents_m = {post.radius_m, post.radius_m, 0.5 * post.height_m};
  return solid;
}

Solid solid_of(const std::string& name, const Polyhedron& body) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& corner : body.corners) bounds.extend(corner);
  Solid solid;
  solid.name = name;
  solid.shape = Solid::Shape::hull;
  solid.X_WS.translation() = bounds.center();
  solid.half_extents_m = 0.5 * bounds.sizes();
  solid.polyhedron = moved(Eigen::Affine3d(Eigen::Translation3d(-bounds.center())), body);
  return solid;
}

Solid ball_of(const std::string& name, const Eigen::Vector3d& center_W, double radius_m) {
  Solid solid;
  solid.name = name;
  solid.shape = Solid::Shape::sphere;
  solid.X_WS.translation() = center_W;
  solid.half_extents_m.setConstant(radius_m);
  return solid;
}

namespace {

// From an altitude of 40 m, the edge of the ground appears 0.2 degrees below the horizon.
constexpr double kFarM = 12000.0;

// Adds lines outside the given ones, at growing distances.
void extend_to_horizon(std::vector<double>& lines_m) {
  while (lines_m.back() < kFarM) lines_m.push_back(lines_m.back() + 0.5 * (lines_m.back() - lines_m.front()));
  while (lines_m.front() > -kFarM)
    lines_m.insert(lines_m.begin(), lines_m.front() - 0.5 * (lines_m.back() - lines_m.front()));
}

}  // namespace

void add_ground(std::vector<double> norths_m, std::vector<double> easts_m,
                const std::function<GroundCell(const Eigen::Vector2d& middle_NE)>& cell_at, MeshBuilder& mesh) {
  extend_to_horizon(norths_m);
  extend_to_horizon(easts_m);
  mesh.begin_chunk(false);
  const uint32_t ground = mesh.begin_instance("ground", SemanticClass::ground);
  std::optional<uint32_t> road;
  for (size_t i = 1; i < norths_m.size(); ++i) {
    for (size_t j = 1; j < easts_m.size(); ++j) {
      const Eigen::Vector3d low(norths_m[i - 1], easts_m[j - 1], 0.0), high(norths_m[i], easts_m[j], 0.0);
      const GroundCell cell = cell_at(0.5 * (low + high).head<2>());
      const Cover& cover = cell.cover;
      if (cell.is_road && !road) road = mesh.begin_instance("road", SemanticClass::road);
      mesh.resume_instance(cell.is_road ? *road : ground);
      const Eigen::Vector2d from_origin_m(low.y(), -high.x());  // up in the image is north
      const Eigen::Vector2d offset = cover.offset + from_origin_m / cover.tile_m;
      const TexturedPanel panel = top_panel({low, high});
      if (cell.add) {
        const Eigen::Vector2d end = offset + Eigen::Vector2d(panel.right_m.norm(), panel.down_m.norm()) / cover.tile_m;
        cell.add(panel, {offset.x(), offset.y(), end.x(), end.y()});
      } else {
        mesh.add_tiled(panel, cover.tile_m, offset, cover.texture);
      }
    }
  }
}

void add_ground(double half_m, const Cover& cover, MeshBuilder& mesh) {
  std::vector<double> lines_m;
  for (int k = -4; k <= 4; ++k) lines_m.push_back(0.25 * k * half_m);
  add_ground(
      lines_m, lines_m, [&](const Eigen::Vector2d&) { return GroundCell{cover}; }, mesh);
}

}  // namespace hedgehop::scenes::mesh
