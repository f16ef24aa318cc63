#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace hedgehop::sim {

/// A few of some items by their numbers, rising.
using Subset = std::vector<size_t>;

/// Returns a subset of `count` items that still fails, and of which no single item can be left out. Each subset is
/// tested once. Source: [ZellerHildebrandt2002] sec. "A Minimizing Algorithm".
/// @param fails  of a subset; true of all items.
Subset ddmin(size_t count, const std::function<bool(const Subset&)>& fails);

}  // namespace hedgehop::sim
