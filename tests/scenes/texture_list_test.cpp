#include "scenes/texture_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>

#include "scenes/generators.h"

namespace hedgehop::scenes {
namespace {

cv::Mat grey(int size_px, int level) { return cv::Mat(size_px, size_px, CV_8UC3, cv::Scalar::all(level)); }

TEST(TextureList, PaintsOnFirstUseOnceForAllCopiesAndThreads) {
  std::atomic<int> painted = 0;
  TextureList list(8);
  EXPECT_EQ(list.add([&] { return ++painted, grey(8, 1); }), 0u);
  EXPECT_EQ(list.add(2, [&] { return ++painted, std::vector<cv::Mat>{grey(8, 2), grey(8, 3)}; }), 1u);
  EXPECT_EQ(list.add([] { return grey(8, 4); }), 3u);
  const TextureList copy = list;
  EXPECT_EQ(copy.size(), 4u);
  EXPECT_EQ(painted, 0);

  std::vector<std::jthread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([&] { copy.images(); });
  threads.clear();
  EXPECT_EQ(painted, 2);
  const std::vector<cv::Mat> images = list.images(), of_copy = copy.images();
  for (size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(images[k].at<cv::Vec3b>(0, 0), cv::Vec3b::all(static_cast<uint8_t>(k + 1)));
    EXPECT_EQ(images[k].data, of_copy[k].data);
  }
}

TEST(TextureList, RejectsTexturesOfOtherForms) {
  using Images = std::vector<cv::Mat>;
  for (const Images& images : {Images{grey(8, 0), grey(4, 0)}, Images{grey(6, 0)}, Images{cv::Mat(8, 4, CV_8UC3)},
                               Images{cv::Mat(8, 8, CV_8UC1)}}) {
    EXPECT_THROW(TextureList{images}, std::invalid_argument);
  }
  TextureList list(8);
  list.add([] { return grey(4, 0); });
  EXPECT_THROW(list.images(), std::invalid_argument);
}

TEST(TextureList, OfASceneHasItsSizeBeforeItIsPainted) {
  const Scene city = make_scene(worlds::UrbanConfig{.extent_m = 60.0, .texture_size_px = 64}, 1);
  EXPECT_EQ(city.textures.size_px(), 64);
  EXPECT_EQ(city.textures.size(), city.textures.images().size());
}

}  // namespace
}  // namespace hedgehop::scenes
