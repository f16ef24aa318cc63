#pragma once

#include <vector>

#include "sim/render/scene_geometry.h"
#include "sim/render/tiles/facet.h"

namespace hedgehop::sim::tiles {

/// A scene's triangles as facets. Two that follow each other and lie in one plane, under one image and one light, are
/// one facet of four corners.
struct Facets {
  std::vector<FacetShape> shapes;
  std::vector<FacetCover> covers;              ///< likewise
  std::vector<float> n_x, n_y, n_z, offset_m;  ///< likewise, and seven more
  std::vector<uint32_t> of_triangle;           ///< number of facets before each triangle, and of all of them

  FacetPlanes planes() const { return {n_x.data(), n_y.data(), n_z.data(), offset_m.data()}; }

  struct Range {
    uint32_t first = 0, count = 0;
  };
  /// Facets of a stretch of indices.
  Range range(uint32_t first_index, uint32_t index_count) const {
    const uint32_t first = of_triangle[first_index / 3];
    return {first, of_triangle[(first_index + index_count) / 3] - first};
  }
};

/// Triangles without area are left out. Labels as Channel::labels has them.
Facets make_facets(const SceneGeometry& geometry);

}  // namespace hedgehop::sim::tiles
