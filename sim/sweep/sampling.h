#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// Points of the unit cube [0, 1)^d for experiments, each a function of its arguments alone.
namespace hedgehop::sim {

using UnitPoints = std::vector<std::vector<double>>;

/// Dimensions for which direction numbers are known.
inline constexpr size_t kSobolDimensions = 10;

/// Point `index` (from 0, the origin) of Sobol's sequence, each coordinate in [0, 1).
/// @param dimensions  1..kSobolDimensions; std::invalid_argument otherwise. @param index  below 2^32.
/// Source: [JoeKuo2008] sec. 2, with the direction numbers of the file new-joe-kuo-6.21201.
std::vector<double> sobol_point(uint32_t index, size_t dimensions);

/// Independent even draws. @param dimensions  >= 1.
UnitPoints random_points(size_t points, size_t dimensions, uint64_t seed);

/// Draws of which, along every coordinate, each of `points` equal intervals holds exactly one.
/// Source: [McKayBeckmanConover1979] sec. 2.
UnitPoints latin_hypercube(size_t points, size_t dimensions, uint64_t seed);

/// The first points of Sobol's sequence. Throws std::invalid_argument for too many dimensions.
UnitPoints sobol_points(size_t points, size_t dimensions);

}  // namespace hedgehop::sim
