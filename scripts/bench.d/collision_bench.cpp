#include <benchmark/benchmark.h>

#include <cmath>
#include <random>

#include "sim/collision/proximity.h"

namespace hedgehop::sim {
namespace {

using dynamics::HullPart;

scenes::Scene blocks(int side) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  scenes::Scene scene;
  for (int i = 0; i < side * side; ++i) {
    scenes::Solid solid;
    solid.half_extents_m = {4.0 + 5.0 * u(random), 4.0 + 5.0 * u(random), 5.0 + 15.0 * u(random)};
    solid.X_WS = Eigen::Translation3d(30.0 * (i % side), 30.0 * (i / side), -solid.half_extents_m.z()) *
                 Eigen::AngleAxisd(3.0 * u(random), Eigen::Vector3d::UnitZ());
    scene.solids.push_back(solid);
  }
  return scene;
}

// A flight down a street, one query a physics tick at 10 m/s and 500 Hz.
void fly(benchmark::State& state, const scenes::Scene& scene) {
  CollisionWorld world(scene, {{HullPart::Shape::cylinder, {0.0, 0.0, -0.5}, {0.9, 0.9, 0.05}},
                               {HullPart::Shape::box, {0.1, 0.0, 0.0}, {0.5, 0.2, 0.25}},
                               {HullPart::Shape::box, {-0.9, 0.0, -0.1}, {0.6, 0.05, 0.05}}});
  double north_m = 0.0;
  for (auto _ : state) {
    north_m = std::fmod(north_m + 0.02, 300.0);
    const Eigen::Isometry3d X_WB = Eigen::Translation3d(north_m, 15.0, -12.0) *
                                   Eigen::AngleAxisd(0.2 * std::sin(north_m), Eigen::Vector3d::UnitX());
    benchmark::DoNotOptimize(world.query(X_WB, 200.0, 0.0));
  }
}

void Proximity(benchmark::State& state) { fly(state, blocks(static_cast<int>(state.range(0)))); }
BENCHMARK(Proximity)->Arg(10)->Arg(100);

// The hull and a single building: the cost without a search among obstacles.
void ProximityFloor(benchmark::State& state) { fly(state, blocks(1)); }
BENCHMARK(ProximityFloor);

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
