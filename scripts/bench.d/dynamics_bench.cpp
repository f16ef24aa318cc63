#include <benchmark/benchmark.h>

#include "tests/sim/loop/outdoor_flight.h"

// One second in the air, without cameras: vehicle, wind with turbulence, all sensors, navigation filter, autopilot.
namespace hedgehop::sim {
namespace {

void one_second(benchmark::State& state, const dynamics::VehicleConfig& vehicle) {
  OutdoorFlight flight(vehicle);
  for (auto _ : state) flight.fly(1.0);
  constexpr double kRealTimeMs = 1000.0;
  state.counters["floor_ms"] = kRealTimeMs;
}

void HelicopterSecond(benchmark::State& state) { one_second(state, dynamics::helicopter::HelicopterConfig{}); }
BENCHMARK(HelicopterSecond)->Unit(benchmark::kMillisecond);

void MulticopterSecond(benchmark::State& state) { one_second(state, dynamics::multicopter::MulticopterConfig{}); }
BENCHMARK(MulticopterSecond)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
