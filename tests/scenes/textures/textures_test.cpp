// Properties that optic flow requires of every texture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/generators.h"
#include "scenes/textures/city_textures.h"
#include "scenes/textures/facade_textures.h"
#include "scenes/textures/room_textures.h"
#include "scenes/textures/street_textures.h"

namespace hedgehop::scenes::textures {
namespace {

constexpr int kSize = 512;

cv::Mat1f grey(const cv::Mat& image) {
  cv::Mat1f result(image.size());
  for (int r = 0; r < image.rows; ++r) {
    for (int c = 0; c < image.cols; ++c) {
      const auto pixel = image.at<cv::Vec3b>(r, c);
      result(r, c) = static_cast<float>(pixel[0] + pixel[1] + pixel[2]) / 3.0f;
    }
  }
  return result;
}

cv::Mat1f halved(const cv::Mat1f& image) {
  cv::Mat1f result(image.rows / 2, image.cols / 2);
  for (int r = 0; r < result.rows; ++r) {
    for (int c = 0; c < result.cols; ++c) {
      result(r, c) = 0.25f * (image(2 * r, 2 * c) + image(2 * r + 1, 2 * c) + image(2 * r, 2 * c + 1) +
                              image(2 * r + 1, 2 * c + 1));
    }
  }
  return result;
}

// Standard deviation of the detail lost by each halving of the resolution: one value per octave, finest first.
std::vector<double> octave_deviations(cv::Mat1f image, int octaves) {
  std::vector<double> result;
  for (int k = 0; k < octaves; ++k) {
    const cv::Mat1f coarse = halved(image);
    double square = 0.0;
    for (int r = 0; r < image.rows; ++r) {
      for (int c = 0; c < image.cols; ++c) square += std::pow(image(r, c) - coarse(r / 2, c / 2), 2);
    }
    result.push_back(std::sqrt(square / static_cast<double>(image.total())));
    image = coarse;
  }
  return result;
}

double step_between(const cv::Mat1f& left, int left_column, const cv::Mat1f& right, int right_column) {
  double sum = 0.0;
  for (int r = 0; r < left.rows; ++r) sum += std::abs(left(r, left_column) - right(r, right_column));
  return sum / left.rows;
}

// Returns the maximum difference between adjacent columns inside an image.
double roughest_step(const cv::Mat1f& image) {
  double worst = 0.0;
  for (int c = 0; c + 1 < image.cols; ++c) worst = std::max(worst, step_between(image, c, image, c + 1));
  return worst;
}

double correlation(const cv::Mat1f& a, const cv::Mat1f& b) {
  cv::Scalar mean_a, dev_a, mean_b, dev_b;
  cv::meanStdDev(a, mean_a, dev_a);
  cv::meanStdDev(b, mean_b, dev_b);
  return (a.dot(b) / static_cast<double>(a.total()) - mean_a[0] * mean_b[0]) / (dev_a[0] * dev_b[0]);
}

std::vector<cv::Mat> all_images() {
  std::vector<cv::Mat> images = city_textures(kSize, 21, true).images.images();
  for (auto paper : {WallPaper::stripes, WallPaper::brick, WallPaper::damask, WallPaper::plaster}) {
    for (cv::Mat& image : paint_room_walls(paper, kSize, 3, 22)) images.push_back(image);
  }
  for (auto paint : {paint_parquet, paint_carpet, paint_ceiling, paint_shelves, paint_drawers})
    images.push_back(paint(kSize, 23));
  return images;
}

TEST(Images, HaveContrastInEveryOctaveFromOnePixelToAnEighthOfTheImage) {
  constexpr double kWeakest = 2.0;  // of 255: several times the noise of a camera
  const std::vector<cv::Mat> images = all_images();
  for (size_t k = 0; k < images.size(); ++k) {
    const std::vector<double> octaves = octave_deviations(grey(images[k]), 6);
    for (size_t octave = 0; octave < octaves.size(); ++octave) {
      EXPECT_GT(octaves[octave], kWeakest) << "image " << k << ", wavelength " << (2 << octave) << " px";
    }
  }
}

TEST(Images, TileSideways) {
  const std::vector<cv::Mat> images = all_images();
  for (size_t k = 0; k < images.size(); ++k) {
    const cv::Mat1f image = grey(images[k]);
    EXPECT_LE(step_between(image, kSize - 1, image, 0), roughest_step(image)) << "image " << k;
  }
}

TEST(Images, OfGroundTileBothWays) {
  const CityTextures city = city_textures(kSize, 24, true);
  const std::vector<cv::Mat> images = city.images.images();
  for (uint32_t k : {city.streets[0], city.streets[1], city.lots[0], city.lots[1], city.lots[2], city.grass, city.field,
                     city.roofs[0]}) {
    const cv::Mat1f rotated = grey(images[k]).t();
    EXPECT_LE(step_between(rotated, kSize - 1, rotated, 0), roughest_step(rotated)) << "image " << k;
  }
}

TEST(Images, FacadeVariantsContinueEachOtherAndDiffer) {
  for (const FacadeStyle& style : facade_styles()) {
    const std::vector<cv::Mat> variants = paint_facades(style, kSize, 2, 25);
    const cv::Mat1f a = grey(variants[0]), b = grey(variants[1]);
    const cv::Mat1f a_turned = a.t(), b_turned = b.t();
    EXPECT_LE(step_between(a, kSize - 1, b, 0), roughest_step(a));
    EXPECT_LE(step_between(a_turned, kSize - 1, b_turned, 0), roughest_step(a_turned));
    EXPECT_GT(cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total()), 4.0);
  }
}

TEST(Images, OfFacadesDoNotRepeatFromBayToBay) {
  // A facade shifted by whole bays and floors must differ, so that flow does not match the next window.
  constexpr double kMaxAlike = 0.85;
  for (const FacadeStyle& style : facade_styles()) {
    const cv::Mat1f image = grey(paint_facades(style, kSize, 1, 26)[0]);
    for (int bay = 1; bay < style.bays; ++bay) {
      const int shift = static_cast<int>(std::lround(static_cast<double>(kSize) * bay / style.bays));
      cv::Mat1f moved(image.size());
      image.colRange(0, kSize - shift).copyTo(moved.colRange(shift, kSize));
      image.colRange(kSize - shift, kSize).copyTo(moved.colRange(0, shift));
      EXPECT_LT(correlation(image, moved), kMaxAlike);
    }
  }
}

TEST(Images, AreOneSquareSizeAndNeitherBlackNorWhite) {
  for (const SceneConfig& config : {SceneConfig(worlds::UrbanConfig{}), SceneConfig(worlds::RoomConfig{})}) {
    for (const cv::Mat& image : make_scene(config, 27).textures.images()) {
      ASSERT_EQ(image.type(), CV_8UC3);
      ASSERT_EQ(image.size(), cv::Size(512, 512));
      const double mean = cv::mean(grey(image))[0];
      EXPECT_GT(mean, 55.0);
      EXPECT_LT(mean, 205.0);
    }
  }
}

}  // namespace
}  // namespace hedgehop::scenes::textures
