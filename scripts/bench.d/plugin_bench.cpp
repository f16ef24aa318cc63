#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "sim/plugin/foreign_module.h"
#include "sim/scenario/avoidance_choice.h"

namespace hedgehop::sim {
namespace {

/// Decisions on images of 640 x 480 px, grey.
void decide(benchmark::State& state, bool in_process) {
  PluginConfig config{.plugin = HEDGEHOP_BENCH_PLUGIN, .module = "first_pixel", .in_process = in_process};
  config.parameters.kind = Node::Kind::map;
  const auto module = make_module(AvoidanceConfig::Choice{config});
  vision::camera::PinholeCamera lens;
  lens.width_px = 640;
  lens.height_px = 480;
  module->reset({.cameras = {{.role = "front", .model = lens, .rate_hz = 50.0}},
                 .limits = {.speed_mps = 5.0, .acceleration_mps2 = 2.0, .radius_m = 0.5},
                 .seed = 1});
  std::vector<avoidance::CameraFrame> frames = {{"front", 0, cv::Mat(480, 640, CV_8UC1, cv::Scalar(80))}};
  avoidance::Observation observation;
  observation.goal.p_WG = {100.0, 0.0, -10.0};
  observation.frames = frames;
  for (auto _ : state) {
    frames[0].t_ns = observation.t_ns += 20'000'000;
    benchmark::DoNotOptimize(module->update(observation));
  }
}

// One decision of a module in its own process: the copy of the image, the messages and the switches of processes.
void PluginDecision(benchmark::State& state) { decide(state, false); }
BENCHMARK(PluginDecision)->Unit(benchmark::kMicrosecond)->UseRealTime();

// The same module in the simulator's process.
void InProcessDecision(benchmark::State& state) { decide(state, true); }
BENCHMARK(InProcessDecision)->Unit(benchmark::kMicrosecond)->UseRealTime();

// A message of the same size to another process and back: two switches of processes.
void PluginDecisionFloor(benchmark::State& state) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0) return state.SkipWithError("no socket");
  std::array<char, 256> message{};
  const pid_t echo = ::fork();
  if (echo == 0) {
    ::close(ends[0]);
    for (ssize_t got; (got = ::read(ends[1], message.data(), message.size())) > 0;) {
      if (::write(ends[1], message.data(), static_cast<size_t>(got)) < 0) break;
    }
    ::_exit(0);
  }
  ::close(ends[1]);
  for (auto _ : state) {
    if (::write(ends[0], message.data(), message.size()) < 0) break;
    if (::recv(ends[0], message.data(), message.size(), MSG_WAITALL) <= 0) break;
  }
  ::close(ends[0]);
  ::waitpid(echo, nullptr, 0);
}
BENCHMARK(PluginDecisionFloor)->Unit(benchmark::kMicrosecond)->UseRealTime();

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
