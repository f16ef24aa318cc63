#include "sim/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace hedgehop::sim::cli {

FlightProgress::FlightProgress(std::string name) : name_(std::move(name)), terminal_(isatty(STDERR_FILENO) == 1) {}

void FlightProgress::show(double t_s, double duration_s, double goal_distance_m) {
  const int tenths = static_cast<int>(10.0 * t_s / duration_s);
  if (!terminal_ && tenths <= tenths_shown_) return;
  tenths_shown_ = tenths;
  const std::string goal = std::isnan(goal_distance_m) ? "" : fmt::format(", {:.0f} m to the goal", goal_distance_m);
  const std::string line = fmt::format("{}: {:.0f} s flown of at most {:.0f} s{}", name_, t_s, duration_s, goal);
  if (terminal_) {
    fmt::print(stderr, "\r\033[K{}", line);
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
}

void FlightProgress::close() {
  if (terminal_) fmt::print(stderr, "\r\033[K");
}

}  // namespace hedgehop::sim::cli
