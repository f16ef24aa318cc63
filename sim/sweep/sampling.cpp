#include "sim/sweep/sampling.h"

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

constexpr int kBits = 32;

/// A primitive polynomial over the field of two elements and the first direction numbers of a dimension.
struct Dimension {
  int degree;
  uint32_t coefficients;  ///< of the polynomial, without its first and last, as bits
  std::array<uint32_t, 7> m;
};

/// Dimensions 2 to 20; the first has no polynomial. [JoeKuo2008] table of direction numbers, file new-joe-kuo-6.21201.
constexpr std::array<Dimension, kSobolDimensions - 1> kDimensions{{{1, 0, {1}},
                                                                   {2, 1, {1, 3}},
                                                                   {3, 1, {1, 3, 1}},
                                                                   {3, 2, {1, 1, 1}},
                                                                   {4, 1, {1, 1, 3, 3}},
                                                                   {4, 4, {1, 3, 5, 13}},
                                                                   {5, 2, {1, 1, 5, 5, 17}},
                                                                   {5, 4, {1, 1, 5, 5, 5}},
                                                                   {5, 7, {1, 1, 7, 11, 19}},
                                                                   {5, 11, {1, 1, 5, 1, 1}},
                                                                   {5, 13, {1, 1, 1, 3, 11}},
                                                                   {5, 14, {1, 3, 5, 5, 31}},
                                                                   {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                   {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                   {6, 16, {1, 3, 1, 13, 27, 49}},
                                                                   {6, 19, {1, 1, 1, 15, 7, 5}},
                                                                   {6, 22, {1, 3, 1, 15, 13, 25}},
                                                                   {6, 25, {1, 1, 5, 5, 19, 61}},
                                                                   {7, 1, {1, 3, 7, 11, 23, 15, 103}}}};

/// Direction numbers of one dimension, each a fraction of 2^32. [JoeKuo2008] sec. 2.
std::array<uint32_t, kBits> directions(size_t dimension) {
  std::array<uint32_t, kBits> v{};
  if (dimension == 0) {
    for (int k = 0; k < kBits; ++k) v[static_cast<size_t>(k)] = 1u << (kBits - 1 - k);
    return v;
  }
  const Dimension& d = kDimensions[dimension - 1];
  const auto degree = static_cast<size_t>(d.degree);
  for (size_t k = 0; k < degree; ++k) v[k] = d.m[k] << (kBits - 1 - static_cast<int>(k));
  for (size_t k = degree; k < kBits; ++k) {
    v[k] = v[k - degree] ^ (v[k - degree] >> d.degree);
    for (size_t i = 1; i < degree; ++i) {
      if ((d.coefficients >> (degree - 1 - i)) & 1u) v[k] ^= v[k - i];
    }
  }
  return v;
}

/// Returns a random permutation of 0 .. count - 1 (Fisher and Yates).
std::vector<size_t> permutation(size_t count, Random& generator) {
  std::vector<size_t> order(count);
  std::iota(order.begin(), order.end(), size_t{0});
  for (size_t i = count; i > 1; --i) {
    std::swap(order[i - 1], order[static_cast<size_t>(uniform(generator) * static_cast<double>(i))]);
  }
  return order;
}

}  // namespace

std::vector<double> sobol_point(uint32_t index, size_t dimensions) {
  if (dimensions < 1 || dimensions > kSobolDimensions) {
    throw std::invalid_argument("Sobol's sequence supports 1 to 20 coordinates");
  }
  std::vector<double> point;
  for (size_t dimension = 0; dimension < dimensions; ++dimension) {
    const std::array<uint32_t, kBits> v = directions(dimension);
    uint32_t x = 0;
    for (size_t k = 0; k < kBits; ++k) {
      if ((index >> k) & 1u) x ^= v[k];
    }
    point.push_back(std::ldexp(static_cast<double>(x), -kBits));
  }
  return point;
}

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

}  // namespace hedgehop::sim
