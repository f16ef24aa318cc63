#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/flight/flight.h"
#include "sim/scenario/formula.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// Signals sampled every `dt_s`.
struct SampledSignals {
  double dt_s = 0.01;  ///< > 0
  size_t samples = 0;  ///< of every signal
  std::map<std::string, std::vector<double>, std::less<>> numbers;
  std::vector<std::string> status;  ///< empty if no formula uses it
};

/// Robustness of a formula at each sample: its margin, >= 0 if it holds. That of a comparison is the difference of its
/// sides, that of a status is +-infinity.
struct Robustness {
  std::vector<double> value;
  std::vector<size_t> decisive;  ///< sample that determined the value; the first of equal ones
  size_t comparisons = 0;        ///< count, as a measure of cost
};

/// Returns the robustness of a formula, in time linear in the samples and the length of the formula. Intervals end at
/// the last sample: over an empty interval, `always` holds (infinity), `eventually` and `until` do not. A comparison
/// with NaN counts against the whole formula: it fails, and so does its negation.
/// Source: [DonzeMaler2010] sec. on quantitative semantics; [DonzeFerrereMaler2013] sec. on until; windows by
/// [Lemire2006] sec. on the streaming algorithm, from the end. Differs: in f until g, f need not hold at the time of g.
/// @param signals  must contain every signal of the formula; otherwise throws std::out_of_range.
Robustness robustness(const Formula& formula, const SampledSignals& signals);

/// Returns the signals of a flight at its control ticks, as formula_signals() lists them. All are true values; NaN if
/// unknown: `goal_distance` without a goal, `tracking_error` without a commanded velocity. The closest approaches, from
/// every physics tick, count at the control tick before, so that `always (clearance >= c)` agrees with the check
/// `min_clearance`.
SampledSignals flight_signals(const Scenario& scenario, const Flight& flight);

/// Returns whether a formula holds from the start of a flight, its robustness, and the time that determined it.
CheckResult evaluate_formula(const FormulaCheck& check, const Scenario& scenario, const Flight& flight);

}  // namespace hedgehop::sim
