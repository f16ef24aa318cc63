#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace hedgehop::sim {

/// Indices of selected items, in ascending order.
using Subset = std::vector<size_t>;

/// Returns a 1-minimal failing subset of `count` items: removing any single item makes it pass. Each subset is tested
/// once. Source: [ZellerHildebrandt2002] sec. "A Minimizing Algorithm".
/// @param fails  returns whether a subset fails; must be true for all items.
Subset ddmin(size_t count, const std::function<bool(const Subset&)>& fails);

}  // namespace hedgehop::sim
