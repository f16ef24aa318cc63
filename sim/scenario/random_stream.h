#pragma once

#include <cstdint>
#include <string_view>

namespace hedgehop::sim {

/// Seed of one named random stream of a flight: equal names and run seeds give equal seeds, different names unrelated
/// ones, so that adding a stream disturbs no other. FNV-1a of the name, mixed with the run's seed by splitmix64.
uint64_t stream_seed(uint64_t run_seed, std::string_view stream_name);

/// Streams named in one place, so that a report can regenerate the scene of a flight.
inline constexpr std::string_view kSceneStream = "scene";

}  // namespace hedgehop::sim
