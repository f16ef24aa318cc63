#include "scenes/generators.h"

#include "scenes/movers.h"
#include "scenes/random.h"

namespace hedgehop::scenes {
namespace {

constexpr uint64_t kMoverStream = 1000;  // of the scene's seed; the generators count theirs from 0

Scene generate(const UrbanConfig& config, uint64_t seed) { return make_urban(config, seed); }
Scene generate(const RoomConfig& config, uint64_t seed) { return make_room(config, seed); }

}  // namespace

Scene make_scene(const SceneConfig& config, uint64_t seed) {
  const auto make = [seed](const auto& chosen) {
    Scene scene = generate(chosen, seed);
    add_movers(chosen.added.movers, derived_seed(seed, kMoverStream), scene);
    return scene;
  };
  return std::visit(make, config);
}

}  // namespace hedgehop::scenes
