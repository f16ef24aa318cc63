#include "scenes/scene.h"

#include <stdexcept>

namespace hedgehop::scenes {

size_t solid_count(const Scene& scene) {
  size_t count = scene.solids.size();
  for (const Mover& mover : scene.movers) count += mover.solids.size();
  return count;
}

const Solid& solid_at(const Scene& scene, size_t index) {
  if (index < scene.solids.size()) return scene.solids[index];
  index -= scene.solids.size();
  for (const Mover& mover : scene.movers) {
    if (index < mover.solids.size()) return mover.solids[index];
    index -= mover.solids.size();
  }
  throw std::out_of_range("the scene has fewer solids");
}

}  // namespace hedgehop::scenes
