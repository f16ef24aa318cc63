#include "sim/record/image_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {
namespace {

TEST(ImageFile, PngIsReadBackUnchanged) {
  const TemporaryFolder folder;
  for (const int type : {CV_8UC1, CV_8UC3, CV_16UC1, CV_16UC3}) {
    cv::Mat image(41, 67, type);
    cv::RNG random(3);
    random.fill(image, cv::RNG::UNIFORM, 0, CV_MAT_DEPTH(type) == CV_16U ? 65536 : 256);
    const std::filesystem::path file = folder.path() / "image.png";
    write_png(file, image(cv::Rect(3, 2, 60, 35)));  // rows that do not follow each other
    cv::Mat back = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(back.type(), type);
    if (back.channels() == 3) cv::cvtColor(back, back, cv::COLOR_BGR2RGB);
    EXPECT_EQ(cv::norm(back, image(cv::Rect(3, 2, 60, 35)), cv::NORM_INF), 0.0);
  }
}

TEST(ImageFile, TiffIsReadBackUnchanged) {
  const TemporaryFolder folder;
  cv::Mat depth_m(41, 67, CV_32FC1);
  cv::RNG random(4);
  random.fill(depth_m, cv::RNG::UNIFORM, 0.0, 12'000.0);
  depth_m.at<float>(5, 7) = std::numeric_limits<float>::infinity();
  depth_m.at<float>(6, 7) = std::numeric_limits<float>::quiet_NaN();
  const std::filesystem::path file = folder.path() / "depth.tiff";
  const cv::Mat written = depth_m(cv::Rect(3, 2, 60, 35));  // rows that do not follow each other
  write_tiff(file, written);
  const cv::Mat back = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(back.type(), CV_32FC1);
  ASSERT_EQ(back.size(), written.size());
  for (int row = 0; row < back.rows; ++row) EXPECT_EQ(std::memcmp(back.ptr(row), written.ptr(row), 4 * 60), 0) << row;
}

TEST(ImageFile, LabelsBeyondSixteenBitsAreErrors) {
  cv::Mat labels(2, 2, CV_32SC1, cv::Scalar(65'535));
  EXPECT_EQ(labels_16bit(labels).at<uint16_t>(1, 1), 65'535);
  labels.at<int>(1, 0) = 65'536;
  EXPECT_THROW(labels_16bit(labels), std::runtime_error);
}

TEST(ImageFile, DepthInMillimetersIsZeroBeyondItsRangeInTheSkyAndIfUnknown) {
  const cv::Mat depth_m = (cv::Mat_<float>(1, 6) << 0.0014f, 1.2344f, 65.5f, 65.6f,
                           std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN());
  const cv::Mat expected_mm = (cv::Mat_<uint16_t>(1, 6) << 1, 1234, 65'500, 0, 0, 0);
  const cv::Mat mm = depth_mm(depth_m);
  ASSERT_EQ(mm.type(), CV_16UC1);
  EXPECT_EQ(cv::norm(mm, expected_mm, cv::NORM_INF), 0.0) << mm;
}

TEST(ImageFile, ErrorsNameTheFile) {
  const cv::Mat image(4, 4, CV_8UC1, cv::Scalar(0));
  EXPECT_THAT([&] { write_png("/no/such/folder/a.png", image); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("/no/such/folder/a.png")));
  EXPECT_THROW(write_png("a.png", cv::Mat(4, 4, CV_32FC1)), std::invalid_argument);
}

/// Smooth colors have the error of quality 90; red and blue are not exchanged.
TEST(ImageFile, JpegIsReadBack) {
  cv::Mat image(64, 96, CV_8UC3);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) image.at<cv::Vec3b>(y, x) = cv::Vec3b(200, uint8_t(2 * x), uint8_t(3 * y));
  }
  const std::string bytes = jpeg_of(image, 90);
  cv::Mat back = cv::imdecode(std::vector<uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  cv::cvtColor(back, back, cv::COLOR_BGR2RGB);
  EXPECT_LT(cv::norm(back, image, cv::NORM_INF), 12.0);
  EXPECT_LT(cv::norm(back, image, cv::NORM_L1) / static_cast<double>(3 * image.total()), 2.0);
}

}  // namespace
}  // namespace hedgehop::sim
