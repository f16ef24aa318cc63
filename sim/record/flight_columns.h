#pragma once

#include <array>
#include <string_view>

#include "sim/flight/flight.h"
#include "sim/record/column_table.h"

namespace hedgehop::sim {

/// The columns of trajectory.csv, units in their names: one row per control tick. A field is NaN where it is unknown,
/// +inf for a clearance to nothing.
ColumnTable trajectory_columns(const Flight& flight);

/// The columns of decisions.csv: one row per decision. Six columns that every module has, then the module's signals.
ColumnTable decision_columns(const Flight& flight);

/// So many columns of decisions.csv come before the module's signals.
inline constexpr size_t kCommonDecisionColumns = 6;
/// The columns of decisions.csv that hold words.
inline constexpr std::array<std::string_view, 1> kDecisionWords = {"status"};

}  // namespace hedgehop::sim
