#include "vision/camera/wide_lenses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <sstream>

#include "tests/vision/camera/random_lenses.h"
#include "tests/vision/real_data.h"

namespace hedgehop::vision::camera {
namespace {

const std::filesystem::path kCalibrations = kRealData / "ocam";
constexpr double kOcamRoundTripPx = 0.05;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// OCamCalib's own projection (its world2cam), by the inverse polynomial. Row and column, px.
Eigen::Vector2d world_to_camera(const OcamCalibration& o, const Eigen::Vector3d& ray_O) {
  const double theta = std::atan2(ray_O.z(), ray_O.head<2>().norm());
  double rho = 0.0, power = 1.0;
  for (const double coefficient : o.inverse) {
    rho += coefficient * power;
    power *= theta;
  }
  const Eigen::Vector2d xy = rho * ray_O.head<2>().normalized();
  return {o.c * xy.x() + o.d * xy.y() + o.center_row_px, o.e * xy.x() + xy.y() + o.center_col_px};
}

class RealCalibration : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = kCalibrations / GetParam() / "calib_results.txt";
    HEDGEHOP_NEEDS_REAL_DATA(file);
    calibration_ = parse_ocam_calibration(text_of(file));
  }
  OcamCalibration calibration_;
};

TEST_P(RealCalibration, RoundTripOverTheImageIsBelowATwentiethPixel) {
  const Camera camera(calibration_);
  size_t shown = 0;
  double worst_px = 0.0, worst_by_inverse_px = 0.0;
  for (int row = 0; row < camera.height_px; row += 3) {
    for (int col = 0; col < camera.width_px; col += 3) {
      const std::optional<Eigen::Vector3d> ray = camera.unit_ray(Eigen::Vector2d(col, row));
      if (!ray) continue;
      ++shown;
      worst_px = std::max(worst_px, (camera.project(*ray).value() - Eigen::Vector2d(col, row)).norm());
      // The file's inverse polynomial is fitted within the image, up to about 100 deg.
      if (std::acos(ray->z()) > 93.0 * std::numbers::pi / 180.0 || ray->head<2>().norm() == 0.0) continue;
      const Eigen::Vector3d ray_O(ray->y(), ray->x(), -ray->z());
      worst_by_inverse_px =
          std::max(worst_by_inverse_px, (world_to_camera(calibration_, ray_O) - Eigen::Vector2d(row, col)).norm());
    }
  }
  RecordProperty("worst_px", std::to_string(worst_px));
  RecordProperty("worst_by_inverse_px", std::to_string(worst_by_inverse_px));
  EXPECT_GT(shown, static_cast<size_t>(camera.width_px) * static_cast<size_t>(camera.height_px) / 9 * 7 / 10);
  EXPECT_LT(worst_px, 1e-6);
  EXPECT_LT(worst_by_inverse_px, kOcamRoundTripPx);
}

INSTANTIATE_TEST_SUITE_P(All, RealCalibration, testing::Values("board", "lobby"));

/// Rows of numbers of a file with a header line.
std::vector<std::vector<double>> read_table(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(stream, line)) {
    for (char& letter : line) letter = letter == ',' ? ' ' : letter;
    std::istringstream words(line);
    rows.emplace_back(std::istream_iterator<double>(words), std::istream_iterator<double>());
  }
  return rows;
}

// Corners of a chessboard in real images and the poses of the board reproduce the published mean errors.
TEST(OcamLens, ReprojectsAChessboardAsWellAsPublished) {
  const std::filesystem::path folder = kCalibrations / "board";
  HEDGEHOP_NEEDS_REAL_DATA(folder / "corners.csv");
  const Camera camera(parse_ocam_calibration(text_of(folder / "calib_results.txt")));
  const std::map<int, double> published_px = {{1, 0.2680}, {2, 0.2265}, {6, 0.2056}, {11, 0.1899}, {13, 0.1825}};
  std::map<int, std::pair<double, int>> errors;
  for (const std::vector<double>& row : read_table(folder / "corners.csv")) {
    ASSERT_EQ(row.size(), 6u);
    const auto pixel = camera.project({row[4], row[3], -row[5]});
    ASSERT_TRUE(pixel.has_value());
    auto& [sum, count] = errors[static_cast<int>(row[0])];
    sum += (*pixel - Eigen::Vector2d(row[2], row[1])).norm();
    ++count;
  }
  ASSERT_EQ(errors.size(), published_px.size());
  for (const auto& [view, error] : errors) {
    EXPECT_NEAR(error.first / error.second, published_px.at(view), 2e-3) << "view " << view;
  }
}

TEST(OcamLens, TurnsRowsAndColumnsIntoRightAndDown) {
  const OcamCalibration calibration = parse_ocam_calibration(kSmallCalibration);
  const Camera camera(calibration);
  EXPECT_EQ(camera.width_px, 752);
  EXPECT_EQ(camera.height_px, 480);
  const Eigen::Vector2d center(374.5, 241.25);
  EXPECT_NEAR((camera.unit_ray(center).value() - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_GT(camera.unit_ray({600, 241}).value().x(), 0.5);
  EXPECT_GT(camera.unit_ray({374, 400}).value().y(), 0.3);
  // The definition, evaluated for one pixel.
  const double row = 100.0, col = 650.0;
  const double det = 0.9985 + 0.0004 * 0.0003, dr = row - 241.25, dc = col - 374.5;
  const double x = (dr - 0.0004 * dc) / det, y = (0.0003 * dr + 0.9985 * dc) / det, rho = std::hypot(x, y);
  const double f = -220.0 + 1.6e-3 * rho * rho - 2.1e-6 * std::pow(rho, 3) + 8.0e-9 * std::pow(rho, 4);
  const Eigen::Vector3d expected = Eigen::Vector3d(y, x, -f).normalized();
  EXPECT_NEAR((camera.unit_ray({col, row}).value() - expected).norm(), 0.0, 1e-12);
}

TEST(OcamLens, ExceedsNinetyDegreesOffAxis) {
  const Camera camera(parse_ocam_calibration(kSmallCalibration));
  const Eigen::Vector3d left = camera.unit_ray({0, 241.25}).value();
  EXPECT_GT(std::acos(left.z()) * 180.0 / std::numbers::pi, 95.0);
  EXPECT_NEAR(camera.project(9.0 * left).value().x(), 0.0, 1e-9);
}

std::string ocam_refusal(const std::string& text) {
  try {
    Camera camera(parse_ocam_calibration(text));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  return text.replace(text.find(old), old.size(), replacement);
}

TEST(OcamLens, ReportsTheReasonForInvalidCalibrations) {
  const std::string good = kSmallCalibration;
  EXPECT_EQ(ocam_refusal(good), "");
  EXPECT_THAT(ocam_refusal(""), testing::HasSubstr("ends before its direct polynomial"));
  EXPECT_THAT(ocam_refusal(good.substr(0, good.size() - 8)), testing::HasSubstr("ends before its image size"));
  EXPECT_THAT(ocam_refusal(with(good, "5 -2.2", "6 -2.2")), testing::HasSubstr("must count the coefficients"));
  EXPECT_THAT(ocam_refusal(with(good, "241.25 374.5", "241.25 x")), testing::HasSubstr("expected numbers"));
  EXPECT_THAT(ocam_refusal(with(good, "241.25 374.5", "241.25")), testing::HasSubstr("expected 2 numbers, got 1"));
  EXPECT_THAT(ocam_refusal(with(good, "-2.2e+02", "2.2e+02")), testing::HasSubstr("begin below 0"));
  EXPECT_THAT(ocam_refusal(with(good, "480 752", "480 -752")), testing::HasSubstr("image size"));
  EXPECT_THAT(ocam_refusal(with(good, "0.9985 0.0004", "-0.9985 0.0004")), testing::HasSubstr("mirror"));
}

}  // namespace
}  // namespace hedgehop::vision::camera
