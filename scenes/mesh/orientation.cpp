#include "scenes/mesh/orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace hedgehop::scenes::mesh {

namespace {

using Eigen::Vector3d;
using Face = std::array<uint32_t, 3>;

/// Returns a number for each corner that is the same for corners at the same position.
std::vector<uint32_t> places_of(const std::vector<Vector3d>& corners) {
  // Equal positions have equal keys. Sorting by one number takes half the time of sorting by three.
  struct Keyed {
    double key;
    uint32_t corner;
  };
  std::vector<Keyed> order(corners.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = {corners[i].dot(Vector3d(1.0, 0.7548, 0.5698)), i};
  const auto before = [&](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    const Vector3d &p = corners[a.corner], &q = corners[b.corner];
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  };
  std::ranges::sort(order, before);
  std::vector<uint32_t> places(corners.size());
  for (size_t i = 1; i < order.size(); ++i) {
    places[order[i].corner] = places[order[i - 1].corner] + (before(order[i - 1], order[i]) ? 1 : 0);
  }
  return places;
}

/// The faces of a connected body, in order.
struct ConnectedFaces {
  std::vector<uint32_t> faces;
  bool is_closed = true;  ///< faces pass each edge equally often in both directions
};

std::vector<ConnectedFaces> bodies_of(const std::vector<Face>& faces) {
  struct Edge {
    std::pair<uint32_t, uint32_t> ends;
    uint32_t face;
    int direction;
  };
  std::vector<Edge> edges;
  edges.reserve(3 * faces.size());
  for (uint32_t f = 0; f < faces.size(); ++f) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = faces[f][i], b = faces[f][(i + 1) % 3];
      edges.push_back({std::minmax(a, b), f, (a < b ? 1 : 0) - (b < a ? 1 : 0)});
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  std::vector<uint32_t> parent(faces.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](uint32_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  std::vector<uint32_t> open;
  for (size_t i = 0; i < edges.size();) {
    const Edge& first = edges[i];
    int sum = 0;
    for (; i < edges.size() && edges[i].ends == first.ends; ++i) {
      sum += edges[i].direction;
      const uint32_t one = root(edges[i].face), other = root(first.face);
      parent[std::max(one, other)] = std::min(one, other);
    }
    if (sum != 0) open.push_back(first.face);
  }
  std::vector<ConnectedFaces> bodies;
  std::vector<size_t> number(faces.size());
  for (uint32_t f = 0; f < faces.size(); ++f) {
    if (root(f) == f) {
      number[f] = bodies.size();
      bodies.emplace_back();
    }
    bodies[number[root(f)]].faces.push_back(f);
  }
  for (const uint32_t f : open) bodies[number[root(f)]].is_closed = false;
  return bodies;
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

struct Body {
  std::vector<uint32_t> faces;
  Facing facing = Facing::open;
  Eigen::AlignedBox3d box;
};

/// The bodies of a mesh that face outward, as an interval tree along the longest axis of the mesh.
class OutwardBodies {
 public:
  /// @param bodies  must outlive this object.
  explicit OutwardBodies(const std::vector<Body>& bodies) {
    Eigen::AlignedBox3d all;
    for (const Body& body : bodies) {
      if (body.facing != Facing::outward) continue;
      sorted_.push_back(&body);
      all.extend(body.box);
    }
    if (sorted_.empty()) return;
    all.sizes().maxCoeff(&axis_);
    std::ranges::sort(sorted_, {}, [this](const Body* body) { return body->box.min()[axis_]; });
    highest_.resize(sorted_.size());
    set_highest(0, sorted_.size());
  }

  /// Returns whether a body whose box contains another box fulfills a condition.
  template <class Condition>
  bool any_around(const Eigen::AlignedBox3d& box, const Condition& holds) const {
    return any_around(box, holds, 0, sorted_.size());
  }

 private:
  double set_highest(size_t first, size_t last) {
    if (first == last) return -std::numeric_limits<double>::infinity();
    const size_t middle = (first + last) / 2;
    highest_[middle] =
        std::max({sorted_[middle]->box.max()[axis_], set_highest(first, middle), set_highest(middle + 1, last)});
    return highest_[middle];
  }

  template <class Condition>
  bool any_around(const Eigen::AlignedBox3d& box, const Condition& holds, size_t first, size_t last) const {
    if (first == last) return false;
    const size_t middle = (first + last) / 2;
    if (highest_[middle] < box.max()[axis_]) return false;
    if (any_around(box, holds, first, middle)) return true;
    const Body& body = *sorted_[middle];
    if (body.box.min()[axis_] > box.min()[axis_]) return false;  // as all after it
    return (body.box.contains(box) && holds(body)) || any_around(box, holds, middle + 1, last);
  }

  std::vector<const Body*> sorted_;  ///< by the lower side of their boxes
  std::vector<double> highest_;      ///< maximum upper side in the range whose middle is this body
  Eigen::Index axis_ = 0;
};

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
  std::vector<Body> bodies;
  for (ConnectedFaces& body : bodies_of(faces)) {
    Facing facing = Facing::open;
    if (body.is_closed) facing = six_volumes_m3(mesh, body.faces) < 0.0 ? Facing::inward : Facing::outward;
    const Eigen::AlignedBox3d box = box_of(mesh, body.faces);
    bodies.push_back({std::move(body.faces), facing, box});
  }
  const OutwardBodies outward(bodies);
  std::vector<Facing> result(mesh.faces.size());
  for (const Body& body : bodies) {
    const Vector3d inside = mesh.corners[mesh.faces[body.faces.front()][0]];
    const auto encloses_it = [&](const Body& other) { return encloses(mesh, other.faces, inside); };
    const bool is_cavity = body.facing == Facing::inward && outward.any_around(body.box, encloses_it);
    for (const uint32_t f : body.faces) result[f] = is_cavity ? Facing::outward : body.facing;
  }
  return result;
}

}  // namespace hedgehop::scenes::mesh
