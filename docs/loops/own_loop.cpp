// A custom loop that steps the simulation and gives the commands. It flies toward the scenario's goal at 0.5 m/s and
// stops if the true clearance to obstacles is 1 m or less.
//   own_loop SCENARIO.yaml [KEY.PATH=VALUE]...
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "sim/simulation/simulation.h"

using namespace hedgehop;

namespace {

void fly(const std::string& file, const std::vector<std::string>& overrides) {
  sim::Simulation simulation(sim::load_flight(file, overrides));
  while (!simulation.over()) {
    const avoidance::Observation seen = simulation.seen();
    const Eigen::Vector2d way_NE = (seen.goal.p_WG - seen.navigation.p_WB_est).head<2>().normalized();
    const double speed_mps = simulation.proximity().obstacle_clearance_m > 1.0 ? 0.5 : 0.0;
    simulation.step(avoidance::VelocityCommand{speed_mps * way_NE, -seen.goal.p_WG.z(), seen.goal.heading_rad});
  }
  const sim::FlightResult result = simulation.result().result;
  std::printf("%s after %.2f s, %.3f m from the nearest obstacle; trajectory %s\n",
              std::string(sim::to_string(result.outcome)).c_str(), result.flight_time_s,
              result.closest_obstacle.distance_m, result.trajectory_hash.c_str());
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fprintf(stderr, "usage: own_loop SCENARIO.yaml [KEY.PATH=VALUE]...\n");
    return 2;
  }
  try {
    fly(words[1], {words + 2, words + count});
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 2;
  }
}
