#include "scenes/mesh/mesh_import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
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

// WebP is without loss.
std::vector<uint8_t> encoded(const std::string& kind, const cv::Mat& image) {
  std::vector<uint8_t> bytes;
  const std::vector<int> lossless{cv::IMWRITE_WEBP_QUALITY, 101};  // above 100
  cv::imencode(kind, image, bytes, kind == ".webp" ? lossless : std::vector<int>());
  return bytes;
}

// Returns the kinds that this build reads; TIFF and WebP are optional.
std::vector<std::string> readable(std::vector<std::string> kinds) {
  std::erase_if(kinds, [](const std::string& kind) {
    return (kind == ".tiff" && !HEDGEHOP_READS_TIFF) || (kind == ".webp" && !HEDGEHOP_READS_WEBP);
  });
  return kinds;
}

cv::Mat as_opencv(const std::vector<uint8_t>& bytes) {
  cv::Mat rgb;
  cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), rgb, cv::COLOR_BGR2RGB);
  return rgb;
}

TEST(DecodeTexture, EqualsOpenCvForPng) {
  for (const int type : {CV_8UC1, CV_8UC3}) {
    const std::vector<uint8_t> bytes = encoded(".png", colors(type));
    const cv::Mat image = decode_texture(bytes);
    ASSERT_EQ(image.type(), CV_8UC3);
    EXPECT_EQ(cv::norm(image, as_opencv(bytes), cv::NORM_INF), 0.0) << type;
  }
}

TEST(DecodeTexture, KeepsTheColorsOfPngWith16BitsOrGamma) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4}) {
    const std::vector<uint8_t> bytes = encoded(".png", colors(type));
    const cv::Mat expected = decode_texture(bytes);
    cv::Mat wide;
    colors(type).convertTo(wide, CV_16U, 257.0);  // 255 becomes 65535
    EXPECT_EQ(cv::norm(decode_texture(encoded(".png", wide)), expected, cv::NORM_INF), 0.0) << type;
    // A gamma of 1, behind the header.
    constexpr std::array<uint8_t, 16> kGamma{0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 1, 0x86, 0xa0, 0x31, 0xe8, 0x96, 0x5f};
    std::vector<uint8_t> with_gamma = bytes;
    with_gamma.insert(with_gamma.begin() + 33, kGamma.begin(), kGamma.end());
    EXPECT_EQ(cv::norm(decode_texture(with_gamma), expected, cv::NORM_INF), 0.0) << type;
  }
}

TEST(DecodeTexture, KeepsTheAlphaOfPngBmpAndWebp) {
  cv::Mat bgra, rgba;
  cv::max(colors(CV_8UC4), cv::Scalar::all(1), bgra);  // WebP drops the color of pixels without alpha
  cv::cvtColor(bgra, rgba, cv::COLOR_BGRA2RGBA);
  for (const std::string& kind : readable({".png", ".webp"})) {
    const cv::Mat image = decode_texture(encoded(kind, bgra));
    ASSERT_EQ(image.type(), CV_8UC4) << kind;
    EXPECT_EQ(cv::norm(image, rgba, cv::NORM_INF), 0.0) << kind;
  }
  // A BMP of 32 bits with a mask for alpha, from top to bottom.
  const std::array<uint32_t, 31> header{0x4d42,       0,      0,    122,       108, 53, static_cast<uint32_t>(-37),
                                        1 | 32 << 16, 3,      0,    0,         0,   0,  0,
                                        0xff0000,     0xff00, 0xff, 0xff000000};
  std::vector<uint8_t> bmp;
  for (size_t i = 0; i < header.size(); ++i) {
    for (int k = 0; k < (i == 0 ? 2 : 4); ++k) bmp.push_back(static_cast<uint8_t>(header[i] >> 8 * k));
  }
  bmp.resize(122);
  bmp.insert(bmp.end(), bgra.datastart, bgra.dataend);
  EXPECT_EQ(cv::norm(decode_texture(bmp), rgba, cv::NORM_INF), 0.0);
}

TEST(DecodeTexture, EqualsOpenCvForBmpTiffAndWebp) {
  for (const std::string& kind : readable({".bmp", ".tiff", ".webp"})) {
    for (const int type : {CV_8UC1, CV_8UC3}) {
      const std::vector<uint8_t> bytes = encoded(kind, colors(type));
      const cv::Mat image = decode_texture(bytes);
      ASSERT_EQ(image.type(), CV_8UC3) << kind;
      EXPECT_EQ(cv::norm(image, as_opencv(bytes), cv::NORM_INF), 0.0) << kind << " " << type;
    }
  }
}

// A TGA image of 2 x 2 pixels: red, green; blue, white. @param kind  2 color, 10 color in runs.
std::vector<uint8_t> tga(uint8_t kind, uint8_t descriptor, const std::vector<uint8_t>& data) {
  std::vector<uint8_t> bytes{0, 0, kind, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, descriptor};
  bytes.insert(bytes.end(), data.begin(), data.end());
  return bytes;
}

TEST(DecodeTexture, ReadsTgaOfBothOrigins) {
  const std::vector<uint8_t> red{0, 0, 255}, green{0, 255, 0}, blue{255, 0, 0}, white{255, 255, 255};
  const auto joined = [](std::initializer_list<std::vector<uint8_t>> parts) {
    std::vector<uint8_t> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  };
  const std::vector<uint8_t> from_top = tga(2, 0x20, joined({red, green, blue, white})),
                             from_bottom = tga(2, 0, joined({blue, white, red, green})),
                             in_runs = tga(10, 0x20, joined({{1}, red, green, {0x81}, blue}));
  for (const auto& bytes : {from_top, from_bottom, in_runs}) {
    const cv::Mat image = decode_texture(bytes);
    ASSERT_EQ(image.size(), cv::Size(2, 2));
    EXPECT_EQ(image.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 0, 0));
    EXPECT_EQ(image.at<cv::Vec3b>(0, 1), cv::Vec3b(0, 255, 0));
    EXPECT_EQ(image.at<cv::Vec3b>(1, 0), cv::Vec3b(0, 0, 255));
  }
  EXPECT_TRUE(decode_texture(tga(2, 0, red)).empty());
  EXPECT_TRUE(decode_texture(tga(10, 0, {0x83, 1})).empty());
}

TEST(DecodeTexture, RefusesMoreThan8192Pixels) {
  EXPECT_EQ(decode_texture(encoded(".png", cv::Mat(1, 8192, CV_8UC3, cv::Scalar(1, 2, 3)))).cols, 8192);
  for (const std::string& kind : readable({".png", ".jpg", ".bmp", ".ppm", ".tiff", ".webp"})) {
    const cv::Mat wide(1, 8193, CV_8UC3, cv::Scalar(1, 2, 3));
    const std::vector<uint8_t> bytes = encoded(kind, wide);
    EXPECT_THAT([&] { decode_texture(bytes); },
                testing::ThrowsMessage<std::invalid_argument>("it has 8193 x 1 px; valid: at most 8192 x 8192"))
        << kind;
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
  for (const char* kind : {".bmp", ".tiff", ".webp"}) {
    const std::vector<uint8_t> bytes = encoded(kind, colors(CV_8UC3));
    EXPECT_TRUE(decode_texture(std::span(bytes).first(bytes.size() / 2)).empty()) << kind;
  }
  EXPECT_TRUE(decode_texture(encoded(".jp2", colors(CV_8UC3))).empty());
  for (const std::string text :
       {"P3", "P3 1 1 255\n9 8", "P3 -1 1 255 0", "P6 2 2 255\nabc", "P3 1 1 99999999999 0 0 0", "P3 1 1 15 16 0 0"}) {
    EXPECT_TRUE(decode_texture({reinterpret_cast<const uint8_t*>(text.data()), text.size()}).empty()) << text;
  }
  // A header with a size of 4e18 pixels.
  std::vector<uint8_t> vast = png;
  std::fill_n(vast.begin() + 16, 8, uint8_t{0x7f});
  EXPECT_TRUE(decode_texture(vast).empty());
}

}  // namespace
}  // namespace hedgehop::scenes::mesh
