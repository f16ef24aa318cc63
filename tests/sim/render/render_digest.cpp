// Prints one number for all pixels of some views of a small city: for comparing processes. One argument: osmesa or egl.
#include <cstdio>
#include <exception>
#include <string_view>

#include "tests/sim/render/small_world.h"

namespace {

void print_digest(hedgehop::sim::ContextKind context) {
  using namespace hedgehop;
  const sim::SmallWorld city = sim::small_city(5, 81);
  sim::Renderer renderer(city.scene, sim::Culling::frustum_and_horizon, context);
  std::mt19937_64 random(82);
  cv::Mat picture;
  uint64_t digest = 0xcbf29ce484222325u;  // FNV-1a
  for (int view = 0; view < 12; ++view) {
    const auto channel = static_cast<sim::Channel>(view % 3);
    renderer.draw({vision::PinholeCamera::from_fov(200, 150, 1.2), sim::random_pose(random, 80.0, 40.0, 0.8), channel},
                  picture);
    for (size_t i = 0; i < picture.total() * picture.elemSize(); ++i)
      digest = (digest ^ picture.data[i]) * 0x100000001b3u;
  }
  std::printf("%016lx\n", static_cast<unsigned long>(digest));
}

}  // namespace

int main(int argc, char** argv) {
  using hedgehop::sim::ContextKind;
  try {
    print_digest(argc > 1 && std::string_view(argv[1]) == "egl" ? ContextKind::egl : ContextKind::osmesa);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
