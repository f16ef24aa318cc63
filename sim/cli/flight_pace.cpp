#include "sim/cli/flight_pace.h"

#include <thread>
#include <utility>

namespace hedgehop::sim::cli {

FlightPace::FlightPace(double speed, PaceClock clock) : speed_(speed), clock_(std::move(clock)) {
  if (!clock_.wait_until) clock_.wait_until = [](PaceClock::Time due) { std::this_thread::sleep_until(due); };
  begin(0.0);
}

void FlightPace::begin(double t_s) {
  begun_ = clock_.now();
  begun_s_ = t_s;
}

void FlightPace::keep(double t_s) {
  using Seconds = std::chrono::duration<double>;
  const auto wall = std::chrono::duration_cast<PaceClock::Time::duration>(Seconds((t_s - begun_s_) / speed_));
  const PaceClock::Time due = begun_ + wall, now = clock_.now();
  if (due > now) {
    clock_.wait_until(due);
  } else if (Seconds(now - due).count() > kMaxLagS) {
    begin(t_s);
  }
}

}  // namespace hedgehop::sim::cli
