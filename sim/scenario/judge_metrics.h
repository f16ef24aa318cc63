#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "sim/scenario/checks.h"

namespace hedgehop::sim {

/// The judge's figures of an aligned map, docs/metrics.md. They are not in kJudgesMetrics because most of the simulator
/// includes that header.
inline constexpr auto kAlignedMapMetrics =
    std::to_array<std::string_view>({"aligned_corners_found", "aligned_map_precision", "map_shift_m"});

/// Returns the names of all figures of the judge, in the order of result tables.
inline std::vector<std::string_view> judge_metrics() {
  std::vector<std::string_view> names(kJudgesMetrics.begin(), kJudgesMetrics.end());
  names.insert(names.end(), kAlignedMapMetrics.begin(), kAlignedMapMetrics.end());
  return names;
}

}  // namespace hedgehop::sim
