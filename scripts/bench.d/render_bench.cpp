#include <benchmark/benchmark.h>

#include <numbers>
#include <opencv2/core.hpp>

#include "scenes/generators.h"
#include "sim/render/renderer.h"

namespace hedgehop::sim {
namespace {

constexpr int kCameras = 5, kSide_px = 400;  // [Garratt2009] sec. 3.2
constexpr double kPi = std::numbers::pi;

// X_BC of a camera that looks forward in the body.
Eigen::Isometry3d forward() {
  Eigen::Isometry3d X_BC = Eigen::Isometry3d::Identity();
  X_BC.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return X_BC;
}

// Left, right, front, rear and down.
Eigen::Isometry3d mount(int camera) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  if (camera == 4) return AngleAxisd(-kPi / 2, Vector3d::UnitY()) * forward();
  const double headings[] = {-kPi / 2, kPi / 2, 0.0, kPi};
  return AngleAxisd(headings[camera], Vector3d::UnitZ()) * forward();
}

void draw_five(benchmark::State& state, const scenes::Scene& scene, bool only_down, Channel channel) {
  Renderer renderer(scene);
  const auto camera = vision::PinholeCamera::from_fov(kSide_px, kSide_px, kPi / 2);
  cv::Mat picture;
  double north_m = -130.0;
  for (auto _ : state) {
    north_m = north_m < 110.0 ? north_m + 0.5 : -130.0;
    for (int i = 0; i < kCameras; ++i) {
      const Eigen::Isometry3d X_WB(Eigen::Translation3d(north_m, 80.0, -10.0));
      renderer.draw({camera, X_WB * mount(only_down ? 4 : i), channel}, picture);
      benchmark::DoNotOptimize(picture.data);
    }
  }
}

void FiveCamerasInTheCity(benchmark::State& state) {
  draw_five(state, scenes::make_scene(scenes::UrbanConfig{}, 1), false, static_cast<Channel>(state.range(0)));
}
BENCHMARK(FiveCamerasInTheCity)->Unit(benchmark::kMillisecond)->DenseRange(0, 2)->ArgName("grey0_color1_depth2");

// As many pixels of one textured plane: nothing hidden behind anything, nothing to choose.
void FiveCamerasInTheCityFloor(benchmark::State& state) {
  scenes::Scene plane;
  cv::Mat texture(512, 512, CV_8UC3);
  cv::randu(texture, 0, 255);
  plane.textures = {texture};
  scenes::Mesh mesh;
  mesh.material = "opaque";
  for (const auto& [north, east] : {std::pair{-1.f, -1.f}, {-1.f, 1.f}, {1.f, 1.f}, {1.f, -1.f}}) {
    scenes::Vertex corner;
    corner.p_W = {300.f * north, 300.f * east, 0.f};
    corner.uv = {60.f * north, 60.f * east};
    mesh.vertices.push_back(corner);
  }
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.chunks = {{Eigen::AlignedBox3f(mesh.vertices[0].p_W, mesh.vertices[2].p_W), 0, 6, false}};
  plane.meshes = {mesh};
  draw_five(state, plane, true, static_cast<Channel>(state.range(0)));
}
BENCHMARK(FiveCamerasInTheCityFloor)->Unit(benchmark::kMillisecond)->DenseRange(0, 2)->ArgName("grey0_color1_depth2");

}  // namespace
}  // namespace hedgehop::sim

BENCHMARK_MAIN();
