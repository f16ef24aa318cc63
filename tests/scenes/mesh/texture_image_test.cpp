#include "scenes/mesh/texture_image.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace hedgehop::scenes::mesh {
namespace {

// Colors that differ everywhere.
cv::Mat colors(int type) {
  cv::Mat image(37, 53, type);
  cv::RNG random(7);
  random.fill(image, cv::RNG::UNIFORM, 0, type == CV_16UC3 ? 65536 : 256);
  return image;
}

std::vector<uint8_t> encoded(const std::string& kind, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  cv::imencode(kind, image, bytes);
  return bytes;
}

cv::Mat as_opencv(const std::vector<uint8_t>& bytes) {
  cv::Mat rgb;
  cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

TEST(DecodeTexture, EqualsOpenCvForPng) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    const std::vector<uint8_t> bytes = encoded(".png", colors(type));
    const cv::Mat image = decode_texture(bytes);
    ASSERT_EQ(image.type(), CV_8UC3);
    EXPECT_EQ(cv::norm(image, as_opencv(bytes), cv::NORM_INF), 0.0) << type;
  }
}

TEST(DecodeTexture, EqualsOpenCvForJpeg) {
  cv::Mat smooth;
  cv::GaussianBlur(colors(CV_8UC3), smooth, {5, 5}, 1.5);
  cv::Mat grey;
  cv::cvtColor(smooth, grey, cv::COLOR_BGR2GRAY);
  for (const cv::Mat& image : {smooth, grey}) {
    const std::vector<uint8_t> bytes = encoded(".jpg", image);
    EXPECT_EQ(cv::norm(decode_texture(bytes), as_opencv(bytes), cv::NORM_INF), 0.0) << image.channels();
  }
}

TEST(DecodeTexture, IsEmptyForWhatIsNoImage) {
  const std::vector<uint8_t> png = encoded(".png", colors(CV_8UC3)), jpeg = encoded(".jpg", colors(CV_8UC3));
  EXPECT_TRUE(decode_texture({}).empty());
  EXPECT_TRUE(decode_texture(std::span(png).first(4)).empty());
  EXPECT_TRUE(decode_texture(std::span(png).first(png.size() / 2)).empty());
  EXPECT_TRUE(decode_texture(std::span(jpeg).first(20)).empty());
  EXPECT_TRUE(decode_texture(encoded(".bmp", colors(CV_8UC3))).empty());
  // A header that promises 4e18 pixels.
  std::vector<uint8_t> vast = png;
  std::fill_n(vast.begin() + 16, 8, uint8_t{0x7f});
  EXPECT_TRUE(decode_texture(vast).empty());
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
