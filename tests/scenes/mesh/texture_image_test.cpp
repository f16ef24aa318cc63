#include "scenes/mesh/mesh_import.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace hedgehop::scenes::mesh {
namespace {

// An image with different colors at all pixels.
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

TEST(DecodeTexture, EqualsOpenCvForNetpbm) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    for (const int binary : {0, 1}) {
      std::vector<uint8_t> bytes;
      cv::imencode(type == CV_8UC1 ? ".pgm" : ".ppm", colors(type), bytes, {cv::IMWRITE_PXM_BINARY, binary});
      EXPECT_EQ(cv::norm(decode_texture(bytes), as_opencv(bytes), cv::NORM_INF), 0.0) << type << " " << binary;
    }
  }
  const std::string text = "P3 # one pixel\n1 1\n# of fifteen\n15\n0 5 15\n";
  const cv::Mat one = decode_texture({reinterpret_cast<const uint8_t*>(text.data()), text.size()});
  ASSERT_EQ(one.size(), cv::Size(1, 1));
  EXPECT_EQ(one.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 85, 255));
}

TEST(DecodeTexture, IsEmptyForOtherData) {
  const std::vector<uint8_t> png = encoded(".png", colors(CV_8UC3)), jpeg = encoded(".jpg", colors(CV_8UC3));
  EXPECT_TRUE(decode_texture({}).empty());
  EXPECT_TRUE(decode_texture(std::span(png).first(4)).empty());
  EXPECT_TRUE(decode_texture(std::span(png).first(png.size() / 2)).empty());
  EXPECT_TRUE(decode_texture(std::span(jpeg).first(20)).empty());
  EXPECT_TRUE(decode_texture(encoded(".bmp", colors(CV_8UC3))).empty());
  for (const std::string text : {"P3", "P3 1 1 255\n9 8", "P3 -1 1 255 0", "P6 2 2 255\nabc",
                                 "P3 1 1 99999999999 0 0 0", "P6 999999999 999999999 255\nabc", "P3 1 1 15 16 0 0"}) {
    EXPECT_TRUE(decode_texture({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).empty()) << text;
  }
  // A header with a size of 4e18 pixels.
  std::vector<uint8_t> vast = png;
  std::fill_n(vast.begin() + 16, 8, uint8_t{0x7f});
  EXPECT_TRUE(decode_texture(vast).empty());
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
