#include "sim/batch/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

double log_choose(int64_t n, int64_t k) {
  const auto log_factorial = [](int64_t m) { return std::lgamma(static_cast<double>(m) + 1.0); };
  return log_factorial(n) - log_factorial(k) - log_factorial(n - k);
}

/// Returns the probability that Student's |t| is at most `t`. [AbramowitzStegun1964] eq. (26.7.3), (26.7.4).
double student_within(double t, int64_t freedom) {
  const double theta = std::atan(t / std::sqrt(static_cast<double>(freedom)));
  const double sine = std::sin(theta), square = std::cos(theta) * std::cos(theta);
  const bool odd = freedom % 2 == 1;
  double term = odd ? std::cos(theta) : 1.0, sum = freedom == 1 ? 0.0 : term;
  for (int64_t k = odd ? 3 : 2; k <= freedom - 2; k += 2) {
    term *= static_cast<double>(k - 1) / static_cast<double>(k) * square;
    sum += term;
  }
  return odd ? 2.0 / std::numbers::pi * (theta + sine * sum) : sine * sum;
}

}  // namespace

double student_factor(int64_t samples, double confidence) {
  double low = 0.0, high = 1e6;
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (student_within(middle, samples - 1) < confidence ? low : high) = middle;
  }
  return high;
}

Interval wilson_interval(Count count, double confidence) {
  if (count.trials == 0) return {0.0, 1.0};
  const double n = static_cast<double>(count.trials), p = count.rate();
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / (1.0 + z * z / n);
  // At the ends the formula is exact but for rounding.
  return {count.successes == 0 ? 0.0 : middle - half, count.successes == count.trials ? 1.0 : middle + half};
}

Interval newcombe_difference(Count first, Count second, double confidence) {
  const Interval a = wilson_interval(first, confidence), b = wilson_interval(second, confidence);
  const double p = first.rate(), q = second.rate();
  return {p - q - std::hypot(p - a.low, b.high - q), p - q + std::hypot(a.high - p, q - b.low)};
}

double fisher_lower_tail(Count first, Count second) {
  const int64_t successes = first.successes + second.successes;
  const int64_t trials = first.trials + second.trials;
  double tail = 0.0;
  for (int64_t k = std::max<int64_t>(0, successes - second.trials); k <= first.successes; ++k) {
    tail += std::exp(log_choose(first.trials, k) + log_choose(second.trials, successes - k) -
                     log_choose(trials, successes));
  }
  return std::min(tail, 1.0);
}

}  // namespace hedgehop::sim
