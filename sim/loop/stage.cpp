#include "sim/loop/stage.h"

#include <optional>

#include "sim/render/haze.h"
#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

/// The scene as it is seen through air of the scenario's visibility; the sky through a kilometer of it.
scenes::Scene stage_scene(const Scenario& scenario) {
  scenes::Scene scene = build_part("scene", [&] { return build_scene(scenario.scene, scenario.seed); });
  if (const std::optional<double>& visibility_m = scenario.drawing.visibility_m) {
    constexpr double kThickM = 1000.0;
    scene.sky.visibility_m = *visibility_m;
    const auto seen = static_cast<float>(transmittance(kThickM, *visibility_m));
    scene.sky.zenith = scene.sky.horizon + seen * (scene.sky.zenith - scene.sky.horizon);
  }
  return scene;
}

}  // namespace

Stage::Stage(const Scenario& scenario)
    : scene(std::make_shared<const scenes::Scene>(stage_scene(scenario))),
      hull(dynamics::hull(scenario.vehicle)),
      collision(*scene, hull),
      renderer(*scene, Culling::frustum_and_horizon, scenario.drawing.renderer,
               scenario.drawing.shadows ? Shadows::sun : Shadows::none) {}

}  // namespace hedgehop::sim
