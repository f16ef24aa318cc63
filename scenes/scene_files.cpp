#include "scenes/scene_files.h"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>
#include <variant>

#include "scenes/additions.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes {
namespace {

constexpr uint64_t kTerrainStream = 1002, kMapStream = 1003;  // of the scene's seed; generators.cpp uses others

/// Removes the triangles of the ground and of roads. Boxes then hide no view below their bottoms.
void remove_ground(Scene& scene) {
  scene.has_ground = false;
  for (Mesh& mesh : scene.meshes) {
    std::vector<Chunk> kept;
    std::vector<uint32_t> indices;
    for (Chunk chunk : mesh.chunks) {
      const auto first = static_cast<uint32_t>(indices.size());
      for (uint32_t i = chunk.first_index; i < chunk.first_index + chunk.index_count; i += 3) {
        const SemanticClass kind = mesh.instances[mesh.vertices[mesh.indices[i]].instance].kind;
        if (kind == SemanticClass::ground || kind == SemanticClass::road) continue;
        for (uint32_t k = i; k < i + 3; ++k) indices.push_back(mesh.indices[k]);
      }
      chunk.first_index = first;
      chunk.index_count = static_cast<uint32_t>(indices.size()) - first;
      chunk.fills_box_to_ground = false;
      chunk.core_W.setEmpty();
      if (chunk.index_count > 0) kept.push_back(chunk);
    }
    mesh.chunks = std::move(kept);
    mesh.indices = std::move(indices);
  }
  std::erase_if(scene.meshes, [](const Mesh& mesh) { return mesh.chunks.empty(); });
}

}  // namespace

SceneFiles read_scene_files(const SceneConfig& config, uint64_t seed) {
  const auto read = [seed](const auto& world) {
    fields::require_bounds(world);
    int size_px = kFixedTexturePx;
    if constexpr (requires { world.texture_size_px; }) size_px = static_cast<int>(world.texture_size_px);
    SceneFiles files;
    files.contents.textures = TextureList(size_px);
    if constexpr (std::is_same_v<decltype(world), const worlds::MapConfig&>) {
      worlds::MapContents map = worlds::read_map(world, derived_seed(seed, kMapStream));
      files = {std::move(map.scene), std::move(map.remarks)};
    }
    const bool map_has_ground = files.contents.has_ground;
    std::ranges::move(add_files(world.added, derived_seed(seed, kTerrainStream), files.contents),
                      std::back_inserter(files.remarks));
    files.contents.has_ground &= map_has_ground;
    return files;
  };
  return std::visit(read, config);
}

void add_scene_files(SceneFiles files, Scene& scene) {
  Scene& added = files.contents;
  if (!added.has_ground) remove_ground(scene);
  const auto first = static_cast<uint32_t>(scene.textures.size());
  scene.textures.add(added.textures.size(), [list = added.textures] { return list.images(); });
  const auto shift_textures = [first](Mesh& mesh) {
    for (Vertex& vertex : mesh.vertices) vertex.texture += first;
  };
  for (Mesh& mesh : added.meshes) shift_textures(mesh);
  for (Mover& mover : added.movers) shift_textures(mover.mesh);
  std::ranges::move(added.meshes, std::back_inserter(scene.meshes));
  std::ranges::move(added.solids, std::back_inserter(scene.solids));
  std::ranges::move(added.movers, std::back_inserter(scene.movers));
  scene.bounds_NE_m.extend(added.bounds_NE_m);
}

}  // namespace hedgehop::scenes
