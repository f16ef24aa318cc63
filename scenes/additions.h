#pragma once

#include <vector>

#include "scenes/boxes.h"
#include "scenes/mesh/mesh_import.h"
#include "scenes/movers.h"

namespace hedgehop::scenes {

/// What any scene can have besides what its generator makes.
struct SceneAdditions {
  std::vector<BoxConfig> boxes;
  std::vector<MoverConfig> movers;
  std::vector<mesh::ImportConfig> imports;
};

template <class Visitor>
void describe(Visitor& v, SceneAdditions& c) {
  v("boxes", c.boxes, {.meaning = "boxes that stand on the ground, turned about the vertical"});
  v("movers", c.movers, {.meaning = "obstacles that move"});
  v("imports", c.imports, {.meaning = "meshes from files, as scenery and obstacles"});
}

}  // namespace hedgehop::scenes
