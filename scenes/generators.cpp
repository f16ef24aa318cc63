#include "scenes/generators.h"

#include <type_traits>
#include <utility>

#include "scenes/additions.h"
#include "scenes/scene_files.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes {
namespace {

constexpr uint64_t kMoverStream = 1000, kBoxStream = 1001;  // of the scene's seed; generators use 0 and up

Scene generate(const worlds::UrbanConfig& config, uint64_t seed) { return worlds::make_urban(config, seed); }
Scene generate(const worlds::RoomConfig& config, uint64_t seed) { return worlds::make_room(config, seed); }
Scene generate(const worlds::TreeConfig& config, uint64_t seed) { return worlds::make_tree(config, seed); }
Scene generate(const worlds::ForestConfig& config, uint64_t seed) { return worlds::make_forest(config, seed); }
Scene generate(const worlds::CorridorConfig& config, uint64_t seed) { return worlds::make_corridor(config, seed); }
Scene generate(const worlds::HighriseConfig& config, uint64_t seed) { return worlds::make_highrise(config, seed); }
Scene generate(const worlds::BalloonConfig& config, uint64_t seed) { return worlds::make_balloon(config, seed); }
Scene generate(const worlds::WallConfig& config, uint64_t seed) { return worlds::make_wall(config, seed); }
Scene generate(const worlds::ParkConfig& config, uint64_t seed) { return worlds::make_park(config, seed); }
Scene generate(const worlds::CheckerboardConfig& config, uint64_t seed) {
  return worlds::make_checkerboard(config, seed);
}
Scene generate(const worlds::OpenConfig& config, uint64_t seed) { return worlds::make_open(config, seed); }
Scene generate(const worlds::MapConfig& config, uint64_t seed) { return worlds::make_map(config, seed); }
Scene generate(const worlds::AprilGridConfig& config, uint64_t seed) { return worlds::make_aprilgrid(config, seed); }

}  // namespace

Scene make_scene(const SceneConfig& config, uint64_t seed) {
  return make_scene(config, seed, read_scene_files(config, seed));
}

Scene make_scene(const SceneConfig& config, uint64_t seed, SceneFiles files) {
  const auto make = [&](const auto& chosen) {
    Scene scene = generate(chosen, seed);
    add_boxes(chosen.added.boxes, derived_seed(seed, kBoxStream), scene);
    add_movers(chosen.added.movers, derived_seed(seed, kMoverStream), scene);
    add_scene_files(std::move(files), scene);
    if constexpr (std::is_same_v<decltype(chosen), const worlds::OpenConfig&>) worlds::set_bounds(scene);
    return scene;
  };
  return std::visit(make, config);
}

}  // namespace hedgehop::scenes
