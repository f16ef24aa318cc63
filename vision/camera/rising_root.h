#pragma once

#include <cmath>

namespace hedgehop::vision::camera {

/// Returns where a function that rises over [low, high] takes the value 0: Newton's steps, halving where one leaves the
/// interval still in question. @param f  (x) -> pair of value and slope; f(low) <= 0 <= f(high).
template <class Function>
double rising_root(const Function& f, double low, double high, double guess) {
  constexpr int kMaxSteps = 80;     // halving alone needs 60
  constexpr double kClose = 1e-13;  // the step after would be far below rounding
  double x = guess > low && guess < high ? guess : 0.5 * (low + high);
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [value, slope] = f(x);
    (value > 0.0 ? high : low) = x;
    double next = x - value / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double moved = std::abs(next - x);
    x = next;
    if (moved <= kClose * std::abs(x)) break;
  }
  return x;
}

}  // namespace hedgehop::vision::camera
