#pragma once

#include <chrono>
#include <opencv2/core.hpp>
#include <string>

#include "sim/cli/flight_pace.h"
#include "sim/cli/view_server.h"
#include "sim/flight/flight.h"
#include "sim/flight/result_io.h"
#include "sim/simulation/simulation.h"

namespace hedgehop::sim::cli {

/// Shows a flight in browsers while it is flown (`run --view`). It reads the simulation and never changes it. With a
/// viewer, the flight is at most as fast as real time, and waits while the viewer pauses.
class LiveView {
 public:
  /// Prints the address and waits at most 10 s for a browser. Throws PagesAbsent, and std::runtime_error if there is no
  /// server.
  explicit LiveView(const Simulation& simulation);

  /// Sends the state after each decision. @param status  of the module. @param module_image  its image, RGB, or empty.
  void show(Simulation& simulation, const std::string& status, const cv::Mat& module_image);
  /// Sends the result.
  void end(const RunInfo& info, const FlightResult& result);

 private:
  using Clock = std::chrono::steady_clock;
  void keep_pace(double t_s);

  ViewServer server_;
  std::string states_;  ///< not sent yet
  Clock::time_point sent_;
  FlightPace pace_;
};

}  // namespace hedgehop::sim::cli
