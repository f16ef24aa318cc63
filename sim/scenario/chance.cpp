#include "sim/scenario/chance.h"

#include <fmt/format.h>

#include <cmath>

#include "sim/scenario/random_stream.h"

namespace hedgehop::sim {

dynamics::SeedBlend blended_stream(const std::vector<ChanceTerm>& chance, uint64_t run_seed, std::string_view name) {
  if (chance.empty()) return stream_seed(run_seed, name);
  std::vector<dynamics::BlendedSeed> terms;
  for (const ChanceTerm& term : chance) terms.push_back({stream_seed(term.seed, name), term.weight});
  return dynamics::SeedBlend(std::move(terms));
}

std::string blend_fault(const std::vector<ChanceTerm>& chance) {
  constexpr double kRounding = 1e-12;
  double squares = chance.empty() ? 1.0 : 0.0;
  for (const ChanceTerm& term : chance) squares += term.weight * term.weight;
  if (std::abs(squares - 1.0) <= kRounding) return "";
  return fmt::format("the squares of the weights sum to {}, must be 1", squares);
}

}  // namespace hedgehop::sim
