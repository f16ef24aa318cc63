#include "scenes/generators.h"

namespace hedgehop::scenes {
namespace {

Scene generate(const UrbanConfig& config, uint64_t seed) { return make_urban(config, seed); }
Scene generate(const RoomConfig& config, uint64_t seed) { return make_room(config, seed); }

}  // namespace

Scene make_scene(const SceneConfig& config, uint64_t seed) {
  return std::visit([seed](const auto& chosen) { return generate(chosen, seed); }, config);
}

}  // namespace hedgehop::scenes
