#pragma once

#include <array>
#include <string_view>

#include "sim/flight/flight.h"
#include "sim/record/table.h"

namespace hedgehop::sim {

/// Returns the columns of trajectory.csv, with units in their names: one row per control tick. Unknown values are NaN.
/// The clearance is +inf without obstacles.
Table trajectory_columns(const Flight& flight);

/// Returns the columns of decisions.csv: one row per decision. Six columns of every module, then the signals of the
/// module.
Table decision_columns(const Flight& flight);

/// Number of columns of decisions.csv before the signals of the module.
inline constexpr size_t kCommonDecisionColumns = 6;
/// The columns of decisions.csv with words.
inline constexpr std::array<std::string_view, 1> kDecisionWords = {"status"};

}  // namespace hedgehop::sim
