// Prints a hash of all pixels of several views of a small city, and of every example world, in every channel, with and
// without shadows and multisampling. Tests compare the hashes of different processes. Argument: osmesa, egl or tiles.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string_view>
#include <vector>

#include "scenes/generators.h"
#include "sim/libm/random.h"
#include "sim/scenario/scenario.h"
#include "tests/sim/render/small_world.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kChannels = 5;

class Digest {
 public:
  void add(const cv::Mat& image) {
    for (size_t i = 0; i < image.total() * image.elemSize(); ++i) {
      hash_.add(image.data[i]);
    }
  }
  void print(const std::string& what) const {
    std::printf("%016lx %s\n", static_cast<unsigned long>(hash_.value()), what.c_str());
  }

 private:
  Fnv1a hash_;
};

void draw_small_city(RendererKind kind, Shadows shadows, Digest& digest) {
  const SmallWorld city = small_city(5, 81);
  Renderer renderer(city.scene, Culling::frustum_and_horizon, kind, shadows);
  const std::vector<vision::camera::Camera> cameras = {
      vision::camera::PinholeCamera::from_fov(200, 150, 1.2),
      vision::camera::Camera(120, 90, vision::camera::FisheyeLens{35, 35, 60, 45})};
  std::mt19937_64 random(82);
  cv::Mat image;
  for (size_t i = 0; i < 20; ++i) {
    CameraView view{cameras[i % 2], random_pose(random, 80.0, 40.0, 0.8), static_cast<ImageChannel>(i % kChannels)};
    view.next.X_WC = random_pose(random, 80.0, 40.0, 0.8);
    view.samples = i < 10 ? 1 : 4;
    renderer.draw(view, image);
    digest.add(image);
  }
}

void draw_world(const std::filesystem::path& file, RendererKind kind, Shadows shadows, Digest& digest) {
  const std::vector<std::string> overrides = {"scene.texture_size=64"};
  const Scenario scenario = load_scenario(file, overrides);
  Renderer renderer(scenes::make_scene(scenario.scene, scenario.seed), Culling::frustum_and_horizon, kind, shadows);
  const vision::camera::Camera camera = vision::camera::PinholeCamera::from_fov(120, 90, 1.4);
  cv::Mat image;
  for (size_t i = 0; i < kChannels; ++i) {
    const Eigen::Vector3d p_WC(scenario.start.north_m, scenario.start.east_m, -scenario.start.altitude_m);
    CameraView view{camera, look_at(p_WC, p_WC + Eigen::Vector3d(1.0, 0.1, 0.1)), static_cast<ImageChannel>(i)};
    view.next.X_WC = look_at(p_WC, p_WC + Eigen::Vector3d(1.0, 0.2, 0.1));
    view.next.t_s = 0.1;
    view.samples = shadows == Shadows::sun ? 4 : 1;
    renderer.draw(view, image);
    digest.add(image);
  }
}

void print_digests(RendererKind kind) {
  std::vector<std::filesystem::path> worlds;
  for (const auto& entry : std::filesystem::directory_iterator(HEDGEHOP_SOURCE_DIR "/configs/worlds")) {
    worlds.push_back(entry.path());
  }
  std::ranges::sort(worlds);
  for (const char* flown : {"garratt2009_city_0.yaml", "garratt2009_room_0.yaml"}) {
    worlds.push_back(std::filesystem::path(HEDGEHOP_SOURCE_DIR "/configs") / flown);
  }
  for (const Shadows shadows : {Shadows::none, Shadows::sun}) {
    const std::string suffix = shadows == Shadows::sun ? " with shadows" : "";
    Digest city;
    draw_small_city(kind, shadows, city);
    city.print("small city" + suffix);
    for (const std::filesystem::path& file : worlds) {
      Digest world;
      draw_world(file, kind, shadows, world);
      world.print(file.stem().string() + suffix);
    }
  }
}

}  // namespace
}  // namespace hedgehop::sim

int main(int argc, char** argv) {
  using hedgehop::sim::RendererKind;
  try {
    const std::string_view name = argc > 1 ? argv[1] : "osmesa";
    hedgehop::sim::print_digests(name == "egl"     ? RendererKind::egl
                                 : name == "tiles" ? RendererKind::tiles
                                                   : RendererKind::osmesa);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
