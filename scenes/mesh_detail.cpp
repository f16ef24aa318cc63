#include "scenes/mesh_detail.h"

namespace hedgehop::scenes {

std::vector<uint32_t> triangle_indices(const Mesh& mesh, bool far) {
  if (!far) return mesh.indices;
  std::vector<uint32_t> indices;
  for (const Chunk& chunk : mesh.chunks) {
    const bool has_far = chunk.far.index_count > 0;
    const auto& from = has_far ? mesh.far_indices : mesh.indices;
    const auto first = from.begin() + (has_far ? chunk.far.first_index : chunk.first_index);
    indices.insert(indices.end(), first, first + (has_far ? chunk.far.index_count : chunk.index_count));
  }
  return indices;
}

}  // namespace hedgehop::scenes
