#include "sim/loop/stage.h"

#include <stdexcept>

#include "sim/scenario/flight_parts.h"

namespace hedgehop::sim {
namespace {

ContextKind context_kind(DrawingConfig::Context context) {
  switch (context) {
    case DrawingConfig::Context::osmesa:
      return ContextKind::osmesa;
    case DrawingConfig::Context::egl:
      return ContextKind::egl;
    case DrawingConfig::Context::tiles:
      return ContextKind::tiles;
  }
  throw std::logic_error("unknown context");
}

}  // namespace

Stage::Stage(const Scenario& scenario)
    : scene(std::make_shared<const scenes::Scene>(
          build_part("scene", [&] { return build_scene(scenario.scene, scenario.seed); }))),
      hull(dynamics::hull(scenario.vehicle)),
      collision(*scene, hull),
      renderer(*scene, Culling::frustum_and_horizon, context_kind(scenario.drawing.context),
               scenario.drawing.shadows ? Shadows::sun : Shadows::none) {}

}  // namespace hedgehop::sim
