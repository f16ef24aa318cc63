#pragma once

#include <cstddef>

namespace hedgehop {

/// How often this program has asked for heap memory since it began: by `new`, by Eigen, by anybody. Programs that ask
/// list allocations.cpp among their sources. None where it cannot be counted: under the address sanitizer.
size_t allocation_count();

/// Whether allocation_count() counts.
bool counts_allocations();

}  // namespace hedgehop
