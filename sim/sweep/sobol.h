#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hedgehop::sim {

/// Dimensions for which direction numbers are known.
inline constexpr size_t kSobolDimensions = 10;

/// Point `index` (from 0, the origin) of Sobol's sequence, each coordinate in [0, 1).
/// @param dimensions  1..kSobolDimensions; std::invalid_argument otherwise. @param index  below 2^32.
/// Source: [JoeKuo2008] sec. 2, with the direction numbers of the file new-joe-kuo-6.21201.
std::vector<double> sobol_point(uint32_t index, size_t dimensions);

}  // namespace hedgehop::sim
