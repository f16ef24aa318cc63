#pragma once

#include "sim/flight/flight.h"
#include "sim/scenario/scenario.h"
#include "sim/verdict/robustness.h"

namespace hedgehop::sim {

/// A flight's signals at its control ticks, as formula_signals() lists them: true, but for the estimate's error. The
/// closest approaches, found on every physics tick, count at the control tick before them, so that
/// `always (clearance >= c)` agrees with the check `min_clearance`.
SampledSignals flight_signals(const Scenario& scenario, const Flight& flight);

/// Whether a formula holds of a flight from its start, by how much, and when that was decided.
CheckResult evaluate_formula(const FormulaCheck& check, const Scenario& scenario, const Flight& flight);

}  // namespace hedgehop::sim
