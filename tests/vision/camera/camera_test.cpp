#include "vision/camera/camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "tests/vision/camera/random_lenses.h"

namespace hedgehop::vision::camera {
namespace {

constexpr double kRoundTripPx = 1e-6;
constexpr double kOpenCvPx = 1e-9;

struct RoundTrips {
  size_t shown = 0;  ///< pixels that show a ray
  double worst_px = 0.0;
  double worst_length = 0.0;
};

/// Projects the ray of every pixel.
RoundTrips round_trips(const Camera& camera) {
  RoundTrips found;
  for (int row = 0; row < camera.height_px; ++row) {
    for (int col = 0; col < camera.width_px; ++col) {
      const Eigen::Vector2d pixel(col, row);
      const std::optional<Eigen::Vector3d> ray = camera.unit_ray(pixel);
      if (!ray) continue;
      ++found.shown;
      found.worst_length = std::max(found.worst_length, std::abs(ray->norm() - 1.0));
      const std::optional<Eigen::Vector2d> back = camera.project(7.0 * *ray);
      const double error_px = back ? (*back - pixel).norm() : std::numeric_limits<double>::infinity();
      found.worst_px = std::max(found.worst_px, error_px);
    }
  }
  return found;
}

TEST(Camera, ProjectInvertsUnitRayOverTheImage) {
  std::mt19937_64 random(101);
  for (int trial = 0; trial < 12; ++trial) {
    for (const Camera& camera : {random_distorted_pinhole(random), random_rational_pinhole(random),
                                 random_fisheye(random), random_unified(random), random_double_sphere(random)}) {
      check(camera);
      const RoundTrips found = round_trips(camera);
      EXPECT_LT(found.worst_px, kRoundTripPx) << camera.lens_name() << ", trial " << trial;
      EXPECT_LT(found.worst_length, 1e-14);
      EXPECT_GT(found.shown, 38'400u) << camera.lens_name() << ", trial " << trial;
    }
  }
  EXPECT_LT(round_trips(Camera(parse_ocam_calibration(kSmallCalibration))).worst_px, kRoundTripPx);
}

TEST(Camera, ManyPointsHaveTheBitsOfSingleProjections) {
  std::mt19937_64 random(107);
  for (const Camera& camera :
       {random_distorted_pinhole(random), random_fisheye(random), Camera(parse_ocam_calibration(kSmallCalibration))}) {
    std::vector<Eigen::Vector3d> points_C = {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), kNoPixel.homogeneous()};
    while (points_C.size() < 150)
      points_C.emplace_back(Eigen::Vector3d::NullaryExpr([&] { return uniform(random, -1.0, 1.0); }));
    const std::vector<Eigen::Vector2d> pixels = camera.project_each(points_C);
    ASSERT_EQ(pixels.size(), points_C.size());
    for (size_t i = 0; i < points_C.size(); ++i) {
      const std::optional<Eigen::Vector2d> pixel = camera.project(points_C[i]);
      EXPECT_EQ(pixel.has_value(), !pixels[i].hasNaN()) << camera.lens_name() << ", point " << i;
      if (pixel) {
        EXPECT_EQ(*pixel, pixels[i]) << camera.lens_name() << ", point " << i;
      }
    }
  }
}

TEST(Camera, RaysOfDifferentPixelsDiffer) {
  // A lens that folds back within the image has no rays there, because pixels would be ambiguous.
  PinholeLens folding{200, 200, 160, 120};
  folding.k1 = -0.6;
  const Camera camera(320, 240, folding);
  const RoundTrips found = round_trips(camera);
  EXPECT_LT(found.worst_px, kRoundTripPx);
  EXPECT_LT(found.shown, 320u * 240u);
  // r (1 - 0.6 r^2) has its maximum at r = 1 / sqrt(1.8).
  const double fold = 1.0 / std::sqrt(1.8);
  EXPECT_TRUE(camera.project({fold - 1e-6, 0, 1}).has_value());
  EXPECT_FALSE(camera.project({fold + 1e-6, 0, 1}).has_value());
  EXPECT_FALSE(camera.project({5.0, 0, 1}).has_value());
}

TEST(Camera, DistortedPinholeProjectsLikeOpenCv) {
  std::mt19937_64 random(102);
  size_t compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const Camera camera = random_distorted_pinhole(random);
    const auto& lens = std::get<PinholeLens>(camera.lens);
    const cv::Matx33d K(lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1);
    const std::vector<double> D = {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3};
    for (int i = 0; i < 100; ++i) {
      const double z_m = uniform(random, 0.1, 50.0);
      const Eigen::Vector3d p_C(z_m * uniform(random, -0.7, 0.7), z_m * uniform(random, -0.6, 0.6), z_m);
      const std::optional<Eigen::Vector2d> pixel = camera.project(p_C);
      if (!pixel) continue;
      std::vector<cv::Point2d> expected;
      cv::projectPoints(std::vector<cv::Point3d>{{p_C.x(), p_C.y(), p_C.z()}}, cv::Vec3d(), cv::Vec3d(), K, D,
                        expected);
      ++compared;
      ASSERT_NEAR(pixel->x(), expected[0].x, kOpenCvPx);
      ASSERT_NEAR(pixel->y(), expected[0].y, kOpenCvPx);
    }
  }
  EXPECT_GT(compared, 3000u);
}

/// The distorted radius first grows faster than the angle, then turns back.
TEST(Camera, PincushionThatTurnsHasARayForEachPixelBeforeTheTurn) {
  for (const auto& [k1, k2] : {std::pair(0.5, -0.3), std::pair(0.3, -0.08), std::pair(1.0, -1.0)}) {
    const Camera camera(
        160, 160,
        PinholeLens{.focal_x_px = 60, .focal_y_px = 60, .center_u_px = 80, .center_v_px = 80, .k1 = k1, .k2 = k2});
    // 1 + 3 k1 r^2 + 5 k2 r^4 = 0 at the turn.
    const double turn = std::sqrt((-3.0 * k1 - std::sqrt(9.0 * k1 * k1 - 20.0 * k2)) / (10.0 * k2));
    for (int i = 1; i < 100; ++i) {
      const double r = 0.01 * i * turn;
      const auto ray = camera.unit_ray({80.0 + 60.0 * r * (1.0 + k1 * r * r + k2 * r * r * r * r), 80.0});
      ASSERT_TRUE(ray) << k1 << ": " << i << " % of the radius of the turn";
      EXPECT_NEAR(ray->x() / ray->z(), r, 1e-8);
    }
  }
}

TEST(Camera, ReportsTheShareOfAnImagePastTheTurnOfItsPolynomial) {
  PinholeLens wide{857.48, 876.72, 968.06, 556.37};  // of an action camera
  wide.k1 = -0.2576;
  wide.k2 = 0.0877;
  wide.p1 = -2.6e-4;
  wide.p2 = -5.9e-4;
  wide.k3 = -0.0152;
  const Camera camera(1920, 1080, wide);
  size_t black = 0, all = 0;
  for (int row = 0; row < camera.height_px; row += 3) {
    for (int col = 0; col < camera.width_px; col += 3, ++all) black += camera.unit_ray({col, row}) ? 0 : 1;
  }
  EXPECT_GT(share_past_turn(camera), 0.05);
  EXPECT_NEAR(share_past_turn(camera), static_cast<double>(black) / static_cast<double>(all), 0.005);
  EXPECT_EQ(share_past_turn({640, 480, PinholeLens{300, 300, 320, 240, -0.05}}), 0.0);
  EXPECT_EQ(share_past_turn({640, 480, FisheyeLens{60, 60, 320, 240}}), 0.0);  // its image circle is inside the image
  EXPECT_GT(
      share_past_turn(
          {640, 480, FisheyeLens{200, 200, 320, 240, -0.1, 0, 0, 0, FisheyeLens{1, 1, 0, 0, -0.1}.growth_limit_rad()}}),
      0.1);
}

// OpenCV's fisheye is limited to the front hemisphere.
TEST(Camera, FisheyeProjectsLikeOpenCv) {
  std::mt19937_64 random(103);
  for (int trial = 0; trial < 40; ++trial) {
    const Camera camera = random_fisheye(random);
    const auto& lens = std::get<FisheyeLens>(camera.lens);
    const cv::Matx33d K(lens.focal_x_px, 0, lens.center_u_px, 0, lens.focal_y_px, lens.center_v_px, 0, 0, 1);
    const cv::Vec4d D(lens.k1, lens.k2, lens.k3, lens.k4);
    for (int i = 0; i < 100; ++i) {
      const double z_m = uniform(random, 0.1, 50.0);
      const Eigen::Vector3d p_C(z_m * uniform(random, -8, 8), z_m * uniform(random, -8, 8), z_m);
      std::vector<cv::Point2d> expected;
      cv::fisheye::projectPoints(std::vector<cv::Point3d>{{p_C.x(), p_C.y(), p_C.z()}}, expected, cv::Vec3d(),
                                 cv::Vec3d(), K, D);
      const std::optional<Eigen::Vector2d> pixel = camera.project(p_C);
      if (std::atan2(p_C.head<2>().norm(), z_m) >= lens.limit_rad) {
        EXPECT_FALSE(pixel.has_value());
        continue;
      }
      ASSERT_TRUE(pixel.has_value());
      ASSERT_NEAR(pixel->x(), expected[0].x, kOpenCvPx);
      ASSERT_NEAR(pixel->y(), expected[0].y, kOpenCvPx);
    }
  }
}

TEST(Camera, EquidistantFisheyeExceeds180Degrees) {
  const double half_rad = 97.5 * std::numbers::pi / 180.0;
  const double focal_px = fisheye_focal_px({}, 600, 2.0 * half_rad);
  const Camera camera(600, 600, FisheyeLens{focal_px, focal_px, 299.5, 299.5});
  // The image's left border, at -0.5 px, is 97.5 deg to the left.
  const std::optional<Eigen::Vector2d> edge = camera.project({-std::sin(half_rad), 0.0, std::cos(half_rad)});
  ASSERT_TRUE(edge.has_value());
  EXPECT_NEAR(edge->x(), -0.5, 1e-9);
  EXPECT_NEAR(edge->y(), 299.5, 1e-9);
  for (const double angle_rad : {0.1, 1.0, 1.5707963, 1.7, 3.0}) {
    const auto pixel = camera.project(Eigen::Vector3d(0.0, std::sin(angle_rad), std::cos(angle_rad)));
    ASSERT_TRUE(pixel.has_value());
    EXPECT_NEAR(pixel->y(), 299.5 + focal_px * angle_rad, 1e-9);
  }
  EXPECT_FALSE(camera.project({0, 0, -1}).has_value());
  EXPECT_FALSE(camera.project({0, 0, 0}).has_value());
}

TEST(Camera, FisheyeHasNoRaysBeyondItsLimit) {
  FisheyeLens lens{100, 100, 159.5, 119.5};
  lens.limit_rad = 1.2;
  const Camera camera(320, 240, lens);
  EXPECT_TRUE(camera.unit_ray({159.5 + 119.9, 119.5}).has_value());
  EXPECT_FALSE(camera.unit_ray({159.5 + 120.1, 119.5}).has_value());
  EXPECT_TRUE(camera.project({std::tan(1.199), 0, 1}).has_value());
  EXPECT_FALSE(camera.project({std::tan(1.201), 0, 1}).has_value());
}

TEST(Camera, EqualsThePinholeItIsMadeFrom) {
  const PinholeCamera pinhole{101, 77, 80.0, 90.0, 44.0, 33.0};
  const Camera camera = pinhole;
  std::mt19937_64 random(104);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p_C(uniform(random, -9, 9), uniform(random, -9, 9), uniform(random, -1, 9));
    const auto a = camera.project(p_C), b = pinhole.project(p_C);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR((*a - *b).norm() / (1.0 + b->norm()), 0.0, 1e-14);
    }
  }
  EXPECT_EQ(Camera(camera.pinhole()), camera);
  EXPECT_NEAR((camera.unit_ray({10, 20})->hnormalized() - pinhole.ray_at_unit_depth({10, 20}).hnormalized()).norm(),
              0.0, 1e-15);
}

std::string refusal(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Camera, RejectsConversionToPinholeForOtherLenses) {
  std::mt19937_64 random(105);
  EXPECT_THAT(refusal([&] { random_fisheye(random).pinhole(); }), testing::HasSubstr("got a fisheye"));
  EXPECT_THAT(refusal([&] { random_distorted_pinhole(random).pinhole(); }), testing::HasSubstr("distorted pinhole"));
  EXPECT_THAT(refusal([] { Camera(parse_ocam_calibration(kSmallCalibration)).pinhole(); }),
              testing::HasSubstr("OCamCalib"));
}

TEST(Camera, CheckRejectsInvalidCameras) {
  const PinholeLens good{100, 100, 10, 10};
  EXPECT_EQ(refusal([&] { check({20, 20, good}); }), "");
  EXPECT_THAT(refusal([&] { check({0, 20, good}); }), testing::HasSubstr("at least one pixel"));
  EXPECT_THAT(refusal([&] { check({20, 20, PinholeLens{0, 100, 10, 10}}); }), testing::HasSubstr("focal"));
  EXPECT_THAT(refusal([&] {
                check({20, 20, PinholeLens{100, 100, std::nan(""), 10}});
              }),
              testing::HasSubstr("not finite"));
  FisheyeLens folding{100, 100, 10, 10, -0.3};
  EXPECT_THAT(refusal([&] { check({20, 20, folding}); }), testing::HasSubstr("folds back"));
  EXPECT_NEAR(folding.growth_limit_rad(), 1.0 / std::sqrt(0.9), 2e-4);
  EXPECT_THAT(refusal([&] { fisheye_focal_px(folding, 20, 3.0); }), testing::HasSubstr("cannot show"));
  EXPECT_THAT(refusal([&] {
                check({20, 20, FisheyeLens{0.2, 0.2, 10, 10}});
              }),
              testing::HasSubstr("smaller than a pixel"));
}

}  // namespace
}  // namespace hedgehop::vision::camera
