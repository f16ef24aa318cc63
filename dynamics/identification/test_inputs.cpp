#include "dynamics/identification/test_inputs.h"

#include <algorithm>
#include <cmath>

namespace hedgehop::dynamics::identification {

double step_input(double size, double start_s, double t_s) { return t_s >= start_s ? size : 0.0; }

double doublet_input(double size, double start_s, double width_s, double t_s) {
  const double since_s = t_s - start_s;
  if (since_s < 0.0 || since_s >= 2.0 * width_s) return 0.0;
  return since_s < width_s ? size : -size;
}

double sweep_input(const FrequencySweep& sweep, double t_s) {
  const double T = sweep.duration_s;
  if (t_s < 0.0 || t_s >= T) return 0.0;
  constexpr double kC1 = 4.0, kC2 = 0.0187, kFadeShare = 0.02;
  // The integral of the frequency w = w_from + C_2 (exp(C_1 t / T) - 1) (w_to - w_from).
  const double stretched_s = kC2 * (T / kC1 * (std::exp(kC1 * t_s / T) - 1.0) - t_s);
  const double phase = sweep.from_radps * t_s + (sweep.to_radps - sweep.from_radps) * stretched_s;
  const double fade = std::min(1.0, (T - t_s) / (kFadeShare * T));
  return sweep.size * fade * std::sin(phase);
}

}  // namespace hedgehop::dynamics::identification
