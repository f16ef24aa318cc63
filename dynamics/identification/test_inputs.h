#pragma once

/// Inputs of flight tests: the deviation of a control from its trim over time.
namespace hedgehop::dynamics::identification {

/// Returns `size` from start_s on, else 0.
double step_input(double size, double start_s, double t_s);

/// Returns `size` for width_s from start_s on, then -size for the same time, else 0.
double doublet_input(double size, double start_s, double width_s, double t_s);

/// A frequency sweep that spends more time at low frequencies. It begins at time 0; its last 2 % fade out.
struct FrequencySweep {
  double from_radps = 0.3, to_radps = 30.0;  ///< 0 < from < to
  double duration_s = 105.0;
  double size = 1.0;  ///< amplitude
};
/// Source: [TischlerRemple2006] sec. 5, computer-generated sweeps, with C_1 = 4 and C_2 = 0.0187.
double sweep_input(const FrequencySweep& sweep, double t_s);

}  // namespace hedgehop::dynamics::identification
