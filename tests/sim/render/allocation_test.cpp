// Not with the address sanitizer, which replaces operator new itself.
#ifndef __SANITIZE_ADDRESS__

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/sim/render/small_world.h"
#include "tests/sim/render/tested_renderer.h"

namespace {
std::atomic<size_t> allocations = 0;
}

// Not inlined, because the compiler would report new paired with free. cv::Mat allocates its header by operator new, so
// its images are counted, too.
[[gnu::noinline]] void* operator new(size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto unit = static_cast<size_t>(alignment);
  if (void* const memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }

namespace hedgehop::sim {
namespace {

TEST(Renderer, AllocatesNoMemoryForLaterImagesOfACamera) {
  const SmallWorld city = small_city(8, 91);
  Renderer plain = make_renderer(city.scene);
  Renderer shaded = make_renderer(city.scene, Culling::frustum_and_horizon, Shadows::sun);
  vision::camera::PinholeLens bent{90, 90, 60, 45};
  bent.k1 = -0.1;
  const std::array<vision::camera::Camera, 3> cameras = {
      vision::camera::PinholeCamera::from_fov(120, 90, 1.2), vision::camera::Camera(120, 90, bent),
      vision::camera::Camera(120, 90, vision::camera::FisheyeLens{35, 35, 60, 45})};
  constexpr size_t kChannels = 5;
  std::array<cv::Mat, kChannels> images;
  const auto draw_some = [&](uint64_t seed) {
    std::mt19937_64 random(seed);
    for (size_t i = 0; i < 120; ++i) {
      const size_t channel = i % kChannels;
      CameraView view{cameras[i % 3], random_pose(random, 150.0, 60.0, 0.7), static_cast<ImageChannel>(channel)};
      view.samples = i / 15 % 2 == 0 ? 1 : 4;  // 15 images have all pairs of camera and channel
      (i / 30 % 2 == 0 ? plain : shaded).draw(view, images[channel]);
    }
  };
  draw_some(92);  // Mesa also compiles the shaders here
  const size_t before = allocations;
  draw_some(93);
  EXPECT_EQ(allocations - before, 0u);
}

}  // namespace
}  // namespace hedgehop::sim

#endif
