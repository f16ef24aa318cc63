#include "sim/sweep/sampling.h"

#include <numeric>
#include <utility>

#include "sim/libm/random.h"
#include "sim/sweep/sobol.h"

namespace hedgehop::sim {
namespace {

/// A random order of 0 .. count - 1 (Fisher and Yates).
std::vector<size_t> permutation(size_t count, Random& generator) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t i = count; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<size_t>(uniform(generator) * static_cast<double>(i))]);
  }
  return order;
}

}  // namespace

UnitPoints random_points(size_t points, size_t dimensions, uint64_t seed) {
  Random generator(seed);
  UnitPoints drawn(points, std::vector<double>(dimensions));
  for (auto& point : drawn) {
    for (double& coordinate : point) coordinate = uniform(generator);
  }
  return drawn;
}

UnitPoints latin_hypercube(size_t points, size_t dimensions, uint64_t seed) {
  Random generator(seed);
  UnitPoints drawn(points, std::vector<double>(dimensions));
  for (size_t d = 0; d < dimensions; ++d) {
    const std::vector<size_t> strata = permutation(points, generator);
    for (size_t i = 0; i < points; ++i) {
      drawn[i][d] = (static_cast<double>(strata[i]) + uniform(generator)) / static_cast<double>(points);
    }
  }
  return drawn;
}

UnitPoints sobol_points(size_t points, size_t dimensions) {
  UnitPoints drawn;
  for (size_t i = 0; i < points; ++i) drawn.push_back(sobol_point(static_cast<uint32_t>(i), dimensions));
  return drawn;
}

}  // namespace hedgehop::sim
