#pragma once

#include <vector>

#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/scene_view.h"

namespace hedgehop::sim::tiles {

/// The triangles of a scene as facets. Two consecutive triangles form one facet with four corners if they are in one
/// plane and their texture coordinates and brightness are affine over both.
struct Facets {
  std::vector<FacetShape> shapes;
  std::vector<FacetAttributes> attributes;     ///< of each shape
  std::vector<float> n_x, n_y, n_z, offset_m;  ///< of each shape, and seven more elements
  std::vector<uint32_t> of_triangle;           ///< number of facets before each triangle; then the number of all facets

  FacetPlanes planes() const { return {n_x.data(), n_y.data(), n_z.data(), offset_m.data()}; }

  struct FacetRange {
    uint32_t first = 0, count = 0;
  };
  /// Returns the facets of a stretch of indices.
  FacetRange range(uint32_t first_index, uint32_t index_count) const {
    const uint32_t first = of_triangle[first_index / 3];
    return {first, of_triangle[(first_index + index_count) / 3] - first};
  }
};

/// Returns the facets without triangles of zero area. Labels are those of ImageChannel::labels.
Facets make_facets(const SceneGeometry& geometry);

}  // namespace hedgehop::sim::tiles
