#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.h"

namespace hedgehop::scenes {

/// Returns the indices of all triangles of a mesh; with `far`, the far detail of the chunks that have one.
std::vector<uint32_t> triangle_indices(const Mesh& mesh, bool far);

}  // namespace hedgehop::scenes
