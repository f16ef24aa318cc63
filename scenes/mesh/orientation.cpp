#include "scenes/mesh/orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

/// Returns a number for each corner that is the same for corners at the same position.
std::vector<uint32_t> places_of(const std::vector<Vector3d>& corners) {
  std::vector<uint32_t> order(corners.size()), places(corners.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto before = [&](uint32_t a, uint32_t b) {
    return std::lexicographical_compare(corners[a].begin(), corners[a].end(), corners[b].begin(), corners[b].end());
  };
  std::ranges::sort(order, before);
  for (size_t i = 1; i < order.size(); ++i) {
    places[order[i]] = places[order[i - 1]] + (before(order[i - 1], order[i]) ? 1 : 0);
  }
  return places;
}

/// Returns the faces of each connected body, in order.
std::vector<std::vector<uint32_t>> bodies_of(const std::vector<Face>& faces) {
  struct Edge {
    std::pair<uint32_t, uint32_t> ends;
    uint32_t face;
  };
  std::vector<Edge> edges;
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (size_t i = 0; i < 3; ++i) edges.push_back({std::minmax(faces[f][i], faces[f][(i + 1) % 3]), f});
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  std::vector<uint32_t> parent(faces.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (size_t i = 1; i < edges.size(); ++i) {
    if (edges[i].ends != edges[i - 1].ends) continue;
    const uint32_t one = root(edges[i].face), other = root(edges[i - 1].face);
    parent[std::max(one, other)] = std::min(one, other);
  }
  std::vector<std::vector<uint32_t>> bodies;
  std::vector<size_t> number(faces.size());
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (root(f) == f) {
      number[f] = bodies.size();
      bodies.emplace_back();
    }
    bodies[number[root(f)]].push_back(f);
  }
  return bodies;
}

bool is_closed(const std::vector<Face>& faces, const std::vector<uint32_t>& body) {
  std::vector<std::pair<uint32_t, uint32_t>> along, back;
  for (const uint32_t f : body) {
    for (size_t i = 0; i < 3; ++i) {
      along.emplace_back(faces[f][i], faces[f][(i + 1) % 3]);
      back.emplace_back(faces[f][(i + 1) % 3], faces[f][i]);
    }
  }
  std::ranges::sort(along);
  std::ranges::sort(back);
  return along == back;
}

double six_volumes_m3(const Polyhedron& mesh, const std::vector<uint32_t>& body) {
  const Vector3d origin = mesh.corners[mesh.faces[body.front()][0]];
  double sum = 0.0;
  for (const uint32_t f : body) {
    const auto& [a, b, c] = mesh.faces[f];
    sum += (mesh.corners[a] - origin).dot((mesh.corners[b] - origin).cross(mesh.corners[c] - origin));
  }
  return sum;
}

Eigen::AlignedBox3d box_of(const Polyhedron& mesh, const std::vector<uint32_t>& body) {
  Eigen::AlignedBox3d box;
  for (const uint32_t f : body) {
    for (const uint32_t corner : mesh.faces[f]) box.extend(mesh.corners[corner]);
  }
  return box;
}

/// Returns whether a closed body encloses a point: the solid angle of its faces is that of a sphere.
bool encloses(const Polyhedron& mesh, const std::vector<uint32_t>& body, const Vector3d& p) {
  double half_angle = 0.0;
  for (const uint32_t f : body) {
    const Vector3d a = mesh.corners[mesh.faces[f][0]] - p, b = mesh.corners[mesh.faces[f][1]] - p,
                   c = mesh.corners[mesh.faces[f][2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half_angle += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(half_angle) > std::numbers::pi;  // 2 pi inside, 0 outside
}

}  // namespace

std::vector<Facing> facing_of_faces(const Polyhedron& mesh) {
  const std::vector<uint32_t> places = places_of(mesh.corners);
  std::vector<Face> faces = mesh.faces;
  for (Face& face : faces) {
    for (uint32_t& corner : face) corner = places[corner];
  }
  struct Body {
    std::vector<uint32_t> faces;
    Facing facing;
    Eigen::AlignedBox3d box;
  };
  std::vector<Body> bodies;
  for (std::vector<uint32_t>& body : bodies_of(faces)) {
    Facing facing = Facing::open;
    if (is_closed(faces, body)) facing = six_volumes_m3(mesh, body) < 0.0 ? Facing::inward : Facing::outward;
    const Eigen::AlignedBox3d box = box_of(mesh, body);
    bodies.push_back({std::move(body), facing, box});
  }
  std::vector<Facing> result(mesh.faces.size());
  for (const Body& body : bodies) {
    const Vector3d inside = mesh.corners[mesh.faces[body.faces.front()][0]];
    const bool is_cavity =
        body.facing == Facing::inward && std::ranges::any_of(bodies, [&](const Body& other) {
          return other.facing == Facing::outward && other.box.contains(body.box) && encloses(mesh, other.faces, inside);
        });
    for (const uint32_t f : body.faces) result[f] = is_cavity ? Facing::outward : body.facing;
  }
  return result;
}

}  // namespace hedgehop::scenes::mesh
