#pragma once

#include <cstddef>

namespace hedgehop {

/// Returns how often this program has requested heap memory since its start, by `new` or
/// by Eigen. The program must list allocations.cpp among its sources. Returns 0 under the address sanitizer.
size_t allocation_count();

/// Whether allocation_count() counts.
bool counts_allocations();

}  // namespace hedgehop
