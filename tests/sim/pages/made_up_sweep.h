#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "sim/batch/flight_table.h"
#include "sim/config/whole_file.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// A sweep of synthetic flights: each odd one collides; clearance and time are random.
inline std::vector<FlightRecord> made_up(int count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> clearance(0.1, 5.0), time(10.0, 60.0);
  std::vector<FlightRecord> records;
  for (int i = 0; i < count; ++i) {
    FlightRecord record{.status = FlightRecord::Status::flown};
    record.order = {.id = "flights/" + std::to_string(i),
                    .group = "point p" + std::to_string(i) + " gain",
                    .scenario = "room.yaml"};
    record.order.seed = static_cast<uint64_t>(i % 4);
    const bool collides = i % 2 == 1;
    FlightResult& result = record.result.emplace().flight;
    result.outcome = collides ? Outcome::collided : Outcome::reached;
    result.flight_time_s = time(random);
    result.closest_obstacle.distance_m = collides ? 0.0 : clearance(random);
    result.checks = {{.name = "no_collision", .passed = !collides, .value = 1.0, .limit = 0.0, .unit = "m"}};
    records.push_back(record);
  }
  return records;
}

/// Writes the table of the flights and, for each flight, a scenario and a straight path.
inline void write_sweep(const std::filesystem::path& folder, const std::vector<FlightRecord>& records) {
  std::filesystem::create_directories(folder);
  std::vector<double> point, gain;
  const std::string scenario = to_yaml(load_scenario(HEDGEHOP_SOURCE_DIR "/configs/garratt2009_room_0_light.yaml"));
  for (size_t i = 0; i < records.size(); ++i) {
    point.push_back(static_cast<double>(i));
    gain.push_back(0.5 * static_cast<double>(i / 4));
    const std::filesystem::path flight = folder / records[i].order.id;
    std::filesystem::create_directories(flight);
    write_file_whole(flight / "scenario.yaml", scenario);
    write_file_whole(flight / "trajectory.csv", "north_m,east_m,down_m\n0,0,-1\n1," + std::to_string(i) + ",-1\n");
  }
  write_file_whole(folder / "sweep.csv", flight_table(records, {{.name = "point", .values = point, .whole = true},
                                                                {.name = "avoidance.gain", .values = gain}})
                                             .csv());
}

}  // namespace hedgehop::sim
