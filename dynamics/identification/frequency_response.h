#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "dynamics/control/lqr.h"
#include "dynamics/identification/trimmed_flight.h"

/// Frequency responses from records of flights, and those of linear models.
namespace hedgehop::dynamics::identification {

struct FrequencyResponse {
  std::vector<double> frequencies_radps;
  std::vector<Eigen::MatrixXcd> responses;  ///< of each frequency: states x inputs
  Eigen::MatrixXd coherence;                ///< frequencies x states, 0 to 1: share that the inputs explain linearly
};

/// Returns `count` frequencies, evenly spaced in their logarithm.
std::vector<double> log_spaced(double from, double to, size_t count);

/// Returns the frequency responses of all states to all inputs. The records begin and end at the trim. Their inputs
/// together must be independent: two sweeps of each input, also if feedback moves the other inputs.
/// Sources: cross spectra of overlapped Hann windows, [TischlerRemple2006] sec. 7; records with feedback, sec. 8;
/// several inputs, sec. 9. Differs: the window of a frequency has 40 of its periods; if that is more than half a
/// record, it is the whole record without a taper, whose ratio of spectra is exact.
FrequencyResponse identified_response(std::span<const Record> records, const std::vector<double>& frequencies_radps);

/// Returns the closed form (jw I - A)^-1 B at each frequency, with coherence 1.
FrequencyResponse linear_response(const control::LinearSystem& linear, const std::vector<double>& frequencies_radps);

/// Returns the mean weighted mismatch of two responses of one state to one input; below 100 the models agree well,
/// below 50 their differences are hardly noticeable. Frequencies with a coherence below 0.6 do not count. Source:
/// [TischlerRemple2006] sec. 11, the cost function of transfer functions.
double mismatch(const FrequencyResponse& measured, const FrequencyResponse& model, Eigen::Index state,
                Eigen::Index input);

}  // namespace hedgehop::dynamics::identification
