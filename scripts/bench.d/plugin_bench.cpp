#include <benchmark/benchmark.h>

#include "sim/plugin/foreign_module.h"
#include "sim/scenario/avoidance_choice.h"

namespace hedgehop::sim {
namespace {

void decide(benchmark::State& state, const AvoidanceConfig& config) {
  const auto module = make_module(config);
  module->reset({.cameras = {}, .limits = {.speed_mps = 5.0, .acceleration_mps2 = 2.0, .radius_m = 0.5}, .seed = 1});
  avoidance::Observation observation;
  observation.goal.p_WG = {100.0, 0.0, -10.0};
  for (auto _ : state) {
    observation.t_ns += 20'000'000;
    benchmark::DoNotOptimize(module->update(observation));
  }
}

// One decision of a trivial module from a shared library.
void PluginDecision(benchmark::State& state) {
  PluginConfig config{.plugin = HEDGEHOP_BENCH_PLUGIN, .module = "go_to_goal"};
  config.parameters.kind = Node::Kind::map;
  decide(state, AvoidanceConfig::Choice{config});
}
BENCHMARK(PluginDecision)->Unit(benchmark::kMicrosecond);

// The same module, built in.
void PluginDecisionFloor(benchmark::State& state) { decide(state, AvoidanceConfig()); }
BENCHMARK(PluginDecisionFloor)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
