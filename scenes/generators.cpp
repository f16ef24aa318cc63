#include "scenes/generators.h"

#include "scenes/mesh_import.h"
#include "scenes/movers.h"
#include "scenes/random.h"

namespace hedgehop::scenes {
namespace {

constexpr uint64_t kMoverStream = 1000;  // of the scene's seed; the generators count theirs from 0

Scene generate(const UrbanConfig& config, uint64_t seed) { return make_urban(config, seed); }
Scene generate(const RoomConfig& config, uint64_t seed) { return make_room(config, seed); }
Scene generate(const TreeConfig& config, uint64_t seed) { return make_tree(config, seed); }
Scene generate(const ForestConfig& config, uint64_t seed) { return make_forest(config, seed); }
Scene generate(const CorridorConfig& config, uint64_t seed) { return make_corridor(config, seed); }
Scene generate(const HighriseConfig& config, uint64_t seed) { return make_highrise(config, seed); }
Scene generate(const BalloonConfig& config, uint64_t seed) { return make_balloon(config, seed); }
Scene generate(const WallConfig& config, uint64_t seed) { return make_wall(config, seed); }
Scene generate(const ParkConfig& config, uint64_t seed) { return make_park(config, seed); }

}  // namespace

Scene make_scene(const SceneConfig& config, uint64_t seed) {
  const auto make = [seed](const auto& chosen) {
    Scene scene = generate(chosen, seed);
    add_movers(chosen.added.movers, derived_seed(seed, kMoverStream), scene);
    add_imports(chosen.added.imports, scene);
    return scene;
  };
  return std::visit(make, config);
}

}  // namespace hedgehop::scenes
