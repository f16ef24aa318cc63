#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.h"
#include "sim/flight/flight.h"

namespace hedgehop::sim {

/// Returns a synthetic, plausible flight across a city, for tests of files and reports.
/// @param seconds  length, > 0. @param seed  of its noise and its city.
Flight fake_flight(double seconds, uint64_t seed);

/// Returns the city of fake_flight(): boxes on the ground.
std::vector<scenes::Solid> fake_city(uint64_t seed);

}  // namespace hedgehop::sim
