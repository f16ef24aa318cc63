#include "dynamics/identification/frequency_response.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/fields/quantities.h"

namespace hedgehop::dynamics::identification {
namespace {

using Complex = std::complex<double>;

constexpr double kMinCoherence = 0.6;

/// Returns the Fourier kernel of a window: weight(t) exp(-j w t), with the weight of Hann or 1.
Eigen::VectorXcd windowed_kernel(Eigen::Index samples, double w_radps, double step_s, bool hann) {
  Eigen::VectorXcd kernel(samples);
  for (Eigen::Index i = 0; i < samples; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
    const double weight = hann ? 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * share) : 1.0;
    kernel[i] = std::polar(weight, -w_radps * step_s * static_cast<double>(i));
  }
  return kernel;
}

/// Sums of the products of spectra over all windows.
struct Spectra {
  Eigen::MatrixXcd uu, yu;
  Eigen::VectorXd yy;
};

void add_windows(const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& states, double w_radps, double step_s,
                 Spectra& sums) {
  constexpr double kPeriods = 40.0;
  constexpr Eigen::Index kHops = 5;  // per window: 80 % overlap
  const double period_samples = 2.0 * std::numbers::pi / (w_radps * step_s);
  const auto wanted = static_cast<Eigen::Index>(std::lround(kPeriods * period_samples));
  const bool whole = wanted > inputs.rows() / 2;  // the record begins and ends at the trim: no window is needed
  const Eigen::Index samples = whole ? inputs.rows() : wanted;
  const Eigen::VectorXcd kernel = windowed_kernel(samples, w_radps, step_s, !whole);
  for (Eigen::Index begin = 0; begin + samples <= inputs.rows(); begin += std::max<Eigen::Index>(samples / kHops, 1)) {
    const Eigen::VectorXcd u = inputs.middleRows(begin, samples).transpose() * kernel;
    const Eigen::VectorXcd y = states.middleRows(begin, samples).transpose() * kernel;
    sums.uu += u * u.adjoint();
    sums.yu += y * u.adjoint();
    sums.yy += y.cwiseAbs2();
  }
}

/// Returns yu uu^-1, with inputs scaled to equal power.
Eigen::MatrixXcd solved(const Spectra& s) {
  const Eigen::VectorXd power = s.uu.diagonal().real().cwiseMax(1e-300);
  const Eigen::VectorXcd scale = power.cwiseSqrt().cwiseInverse().cast<Complex>();
  const Eigen::MatrixXcd uu = scale.asDiagonal() * s.uu * scale.asDiagonal();
  const Eigen::MatrixXcd yu = s.yu * scale.asDiagonal();
  return uu.adjoint().fullPivLu().solve(yu.adjoint()).adjoint() * scale.asDiagonal();
}

}  // namespace

std::vector<double> log_spaced(double from, double to, size_t count) {
  std::vector<double> values;
  for (size_t i = 0; i < count; ++i) {
    values.push_back(from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(count - 1)));
  }
  return values;
}

FrequencyResponse identified_response(std::span<const Record> records, const std::vector<double>& frequencies_radps) {
  const Eigen::Index inputs = records[0].inputs.cols(), states = records[0].states.cols();
  FrequencyResponse out{frequencies_radps, {}, {}};
  out.coherence.resize(static_cast<Eigen::Index>(frequencies_radps.size()), states);
  for (size_t i = 0; i < frequencies_radps.size(); ++i) {
    Spectra sums{Eigen::MatrixXcd::Zero(inputs, inputs), Eigen::MatrixXcd::Zero(states, inputs),
                 Eigen::VectorXd::Zero(states)};
    for (const Record& record : records) {
      add_windows(record.inputs, record.states, frequencies_radps[i], record.step_s, sums);
    }
    const Eigen::MatrixXcd response = solved(sums);
    const Eigen::VectorXd explained = (response * sums.uu * response.adjoint()).diagonal().real();
    out.coherence.row(static_cast<Eigen::Index>(i)) =
        (explained.array() / sums.yy.array().max(1e-300)).min(1.0).transpose();
    out.responses.push_back(response);
  }
  return out;
}

FrequencyResponse linear_response(const control::LinearSystem& linear, const std::vector<double>& frequencies_radps) {
  const Eigen::Index size = linear.A.rows();
  FrequencyResponse out{frequencies_radps, {}, {}};
  out.coherence = Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(frequencies_radps.size()), size);
  for (const double w : frequencies_radps) {
    const Eigen::MatrixXcd M = Complex(0.0, w) * Eigen::MatrixXcd::Identity(size, size) - linear.A.cast<Complex>();
    out.responses.push_back(M.partialPivLu().solve(Eigen::MatrixXcd(linear.B.cast<Complex>())));
  }
  return out;
}

double mismatch(const FrequencyResponse& measured, const FrequencyResponse& model, Eigen::Index state,
                Eigen::Index input) {
  constexpr double kPhaseWeight = 0.01745, kCost = 20.0;
  double sum = 0.0, count = 0.0;
  for (size_t i = 0; i < measured.responses.size(); ++i) {
    const double coherence = measured.coherence(static_cast<Eigen::Index>(i), state);
    if (coherence < kMinCoherence) continue;
    const Complex ratio = measured.responses[i](state, input) / model.responses[i](state, input);
    const double gain_db = 20.0 * std::log10(std::abs(ratio)), phase_deg = std::arg(ratio) * kDegPerRad;
    const double weight = 1.58 * (1.0 - std::exp(-coherence));
    sum += weight * weight * (gain_db * gain_db + kPhaseWeight * phase_deg * phase_deg);
    count += 1.0;
  }
  return count > 0.0 ? kCost * sum / count : std::nan("");
}

}  // namespace hedgehop::dynamics::identification
