#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// Sample points of the unit cube [0, 1)^d for experiments. Each function depends only on its arguments.
namespace hedgehop::sim {

using UnitPoints = std::vector<std::vector<double>>;

/// Maximum number of dimensions with direction numbers.
inline constexpr size_t kSobolDimensions = 20;

/// Returns point `index` (from 0, the origin) of Sobol's sequence, each coordinate in [0, 1).
/// @param dimensions  1..kSobolDimensions; std::invalid_argument otherwise. @param index  below 2^32.
/// Source: [JoeKuo2008] sec. 2, with the direction numbers of the file new-joe-kuo-6.21201.
std::vector<double> sobol_point(uint32_t index, size_t dimensions);

/// Returns independent uniform draws. @param dimensions  >= 1.
UnitPoints random_points(size_t points, size_t dimensions, uint64_t seed);

/// Returns a Latin hypercube: along every coordinate, each of `points` equal intervals contains exactly one draw.
/// Source: [McKayBeckmanConover1979] sec. 2.
UnitPoints latin_hypercube(size_t points, size_t dimensions, uint64_t seed);

}  // namespace hedgehop::sim
