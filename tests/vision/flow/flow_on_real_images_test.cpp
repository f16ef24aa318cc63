#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "tests/vision/real_data.h"
#include "vision/flow/flow_field.h"
#include "vision/flow/image_interpolation_flow.h"

/// Real image pairs with measured flow (Middlebury, Baker et al. 2011).
namespace hedgehop::vision::flow {
namespace {

cv::Mat read_flow(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  float magic = 0.0f;
  int32_t width = 0, height = 0;
  file.read(reinterpret_cast<char*>(&magic), 4);
  file.read(reinterpret_cast<char*>(&width), 4);
  file.read(reinterpret_cast<char*>(&height), 4);
  cv::Mat flow(height, width, CV_32FC2);
  file.read(reinterpret_cast<char*>(flow.data), static_cast<std::streamsize>(flow.total() * 8));
  return file && magic == 202021.25f ? flow : cv::Mat();
}

struct Case {
  std::string name;
  double median_px, mean_px;  ///< error that patches of 32 px must keep below
  friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }
};

class FlowOnRealImages : public testing::TestWithParam<Case> {};

TEST_P(FlowOnRealImages, IsCloseToTheTrueMeanFlowOfEachPatch) {
  const std::filesystem::path folder = kRealData / "flow" / GetParam().name;
  HEDGEHOP_NEEDS_REAL_DATA(folder / "gt.flo");
  const cv::Mat older = cv::imread((folder / "frame1.png").string(), cv::IMREAD_GRAYSCALE);
  const cv::Mat newer = cv::imread((folder / "frame2.png").string(), cv::IMREAD_GRAYSCALE);
  const cv::Mat truth = read_flow(folder / "gt.flo");
  ASSERT_TRUE(!older.empty() && older.size() == newer.size() && older.size() == truth.size());

  ImageInterpolationConfig config;
  config.patch_px = 32;
  config.margin_px = 16;
  config.rows = 12;
  config.cols = 16;
  ImageInterpolationFlow flow(config, older.cols, older.rows);
  flow.update(older);
  const FlowField& field = flow.update(newer);
  ASSERT_GT(field.valid_share(), 0.75);

  std::vector<double> errors;
  double sum = 0.0;
  for (const FlowVector& vector : field.vectors) {
    if (!vector.valid) continue;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    int known = 0;
    for (int v = static_cast<int>(vector.center_px.y()) - 15; v <= vector.center_px.y() + 16; ++v) {
      for (int u = static_cast<int>(vector.center_px.x()) - 15; u <= vector.center_px.x() + 16; ++u) {
        const cv::Vec2f& at = truth.at<cv::Vec2f>(v, u);
        if (std::abs(at[0]) > 1e9f || std::abs(at[1]) > 1e9f) continue;
        mean += Eigen::Vector2d(at[0], at[1]);
        ++known;
      }
    }
    if (known < 512) continue;
    errors.push_back((vector.flow_px - mean / known).norm());
    sum += errors.back();
  }
  ASSERT_FALSE(errors.empty());
  std::nth_element(errors.begin(), errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2), errors.end());
  const double median_px = errors[errors.size() / 2], mean_px = sum / static_cast<double>(errors.size());
  RecordProperty("median_error_px", std::to_string(median_px));
  RecordProperty("mean_error_px", std::to_string(mean_px));
  RecordProperty("valid_share", std::to_string(field.valid_share()));
  EXPECT_LT(median_px, GetParam().median_px);
  EXPECT_LT(mean_px, GetParam().mean_px);
}

INSTANTIATE_TEST_SUITE_P(Middlebury, FlowOnRealImages,
                         testing::Values(Case{"RubberWhale", 0.2, 0.4}, Case{"Grove2", 0.16, 0.3}),
                         [](const auto& instance) { return instance.param.name; });

TEST(DrawFlow, DrawsVectorsAndNoOtherPixels) {
  cv::Mat image(60, 60, CV_8UC3, cv::Scalar(9, 9, 9));
  FlowField field;
  field.rows = 1;
  field.cols = 2;
  field.vectors = {{{15, 30}, {2, 0}, true}, {{45, 30}, {0, 0}, false}};
  draw_flow(field, 5.0, image);
  EXPECT_NE(image.at<cv::Vec3b>(30, 22), cv::Vec3b(9, 9, 9));  // half way along the drawn vector
  EXPECT_EQ(image.at<cv::Vec3b>(30, 30), cv::Vec3b(9, 9, 9));
  EXPECT_GT(image.at<cv::Vec3b>(30, 45)[0], image.at<cv::Vec3b>(30, 45)[1] + 50);  // a red dot
  EXPECT_EQ(image.at<cv::Vec3b>(5, 5), cv::Vec3b(9, 9, 9));
}

}  // namespace
}  // namespace hedgehop::vision::flow
