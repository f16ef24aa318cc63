#include "scenes/mesh/sides.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hedgehop::scenes::mesh {
namespace {

/// A number for each corner, the same for corners of equal place.
std::vector<uint32_t> places_of(const std::vector<Eigen::Vector3d>& corners) {
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

bool is_closed(const Polyhedron& body) {
  const std::vector<uint32_t> places = places_of(body.corners);
  std::vector<std::pair<uint32_t, uint32_t>> along, back;
  for (const auto& face : body.faces) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t from = places[face[i]], to = places[face[(i + 1) % 3]];
      along.emplace_back(from, to);
      back.emplace_back(to, from);
    }
  }
  std::ranges::sort(along);
  std::ranges::sort(back);
  return along == back;
}

}  // namespace

Facing facing_of(const Polyhedron& body) {
  if (body.faces.empty() || !is_closed(body)) return Facing::open;
  double six_volumes_m3 = 0.0;
  const Eigen::Vector3d origin = body.corners.front();
  for (const auto& [a, b, c] : body.faces) {
    six_volumes_m3 += (body.corners[a] - origin).dot((body.corners[b] - origin).cross(body.corners[c] - origin));
  }
  return six_volumes_m3 < 0.0 ? Facing::inward : Facing::outward;
}

}  // namespace hedgehop::scenes::mesh
