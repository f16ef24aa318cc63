#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/normal_stream.h"

namespace hedgehop::sim {

/// One seed of a blend, for the normal numbers of wind, sensors and start: a flight whose chance lies between those of
/// several seeds. Scene, module, cameras and failures depend on the scenario's seed, where nothing lies between two.
struct ChanceTerm {
  uint64_t seed = 0;
  double weight = 1.0;
};
template <class Visitor>
void describe(Visitor& v, ChanceTerm& c) {
  v("seed", c.seed, {.required = true, .meaning = "whose numbers of wind, sensors and start are taken"});
  v("weight", c.weight, {.above = 0.0, .at_most = 1.0, .required = true, .meaning = "of these numbers"});
}

/// What a named stream of wind, sensors or start is drawn from: the blend, or without one the run's seed. One term
/// draws what a flight of its seed draws, bit for bit.
dynamics::SeedBlend blended_stream(const std::vector<ChanceTerm>& chance, uint64_t run_seed, std::string_view name);

/// What is wrong with a blend's weights, one line; "" when nothing is.
std::string blend_fault(const std::vector<ChanceTerm>& chance);

}  // namespace hedgehop::sim
