#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/scenario/formula.h"

namespace hedgehop::sim {

/// Signals sampled together, every `dt_s`.
struct SampledSignals {
  double dt_s = 0.01;  ///< > 0
  size_t samples = 0;  ///< of every signal
  std::map<std::string, std::vector<double>, std::less<>> numbers;
  std::vector<std::string> status;  ///< empty where no formula asks for it
};

/// How far a formula is from not holding, of each sample: >= 0 where it holds. A comparison's is the difference of its
/// sides, a status' is infinite.
struct Robustness {
  std::vector<double> value;
  std::vector<size_t> decisive;  ///< the sample whose signals gave the value; of equals the first
  size_t comparisons = 0;        ///< made to find them
};

/// The robustness of a formula, in time linear in samples and in the formula's length. Intervals are cut at the last
/// sample: `always` over nothing holds (infinity), `eventually` and `until` over nothing do not. What is not a number
/// fails its comparison.
/// Source: [DonzeMaler2010] sec. on quantitative semantics; [DonzeFerrereMaler2013] sec. on until; windows by
/// [Lemire2006] sec. on the streaming algorithm, from the end. Differs: of f until g, f need not hold at the time of g.
/// @param signals  hold every signal of the formula. Throws std::out_of_range for another.
Robustness robustness(const Formula& formula, const SampledSignals& signals);

}  // namespace hedgehop::sim
