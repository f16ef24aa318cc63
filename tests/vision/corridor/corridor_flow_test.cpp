#include "vision/corridor/corridor_flow.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/vision/camera/random_lenses.h"
#include "tests/vision/corridor/corridor_world.h"
#include "vision/corridor/corridor_space.h"

namespace hedgehop::vision::corridor {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// A point measured by flow; its other members are irrelevant.
WallPoint at(double x_m, double y_m, Region region, RejectionReason rejection = RejectionReason::none) {
  WallPoint point;
  point.p_CP_H = {x_m, y_m, 0.0};
  point.region = region;
  point.rejection = rejection;
  point.off_travel_rad = std::abs(std::atan2(y_m, x_m));  // in straight flight
  return point;
}

// Level flight north from a position in a corridor, and the ray pair of a fixed point.
struct LevelFlight {
  camera::Camera camera = whole_fisheye();
  Vector3d p_WC2 = {0.0, 0.0, -1.5};
  CameraMotion motion{looking_down().linear(), looking_down().linear(), Vector3d(0.08, 0.0, 0.0), 0.1, 1.5};

  flow::RayPair pair(const Vector3d& p_WP) const {
    flow::RayPair pair;
    const Vector3d p_WC1 = p_WC2 - motion.traveled_H;
    pair.before_C = (motion.R_HC1.transpose() * (p_WP - p_WC1)).normalized();
    pair.after_C = (motion.R_HC2.transpose() * (p_WP - p_WC2)).normalized();
    pair.before_px = camera.project(pair.before_C).value();
    pair.after_px = camera.project(pair.after_C).value();
    return pair;
  }
};

TEST(CorridorRegions, CoverExactlyThePrintedAngles) {
  const camera::Camera camera = whole_fisheye();
  const auto masks = region_masks(camera, looking_down(), {}, 0);
  const auto seen_in = [&](double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * pi / 180.0, e = elevation_deg * pi / 180.0;
    const Vector3d ray_B(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e));
    const auto px = camera.project(looking_down().linear().transpose() * ray_B).value();
    int found = -1;
    for (int k = 0; k < kRegions; ++k) {
      if (masks[static_cast<size_t>(k)].at<uint8_t>(static_cast<int>(std::lround(px.y())),
                                                    static_cast<int>(std::lround(px.x())))) {
        EXPECT_EQ(found, -1) << "in two regions";
        found = k;
      }
    }
    return found;
  };
  for (const double elevation_deg : {-22.0, -10.0, 2.0}) {
    for (const int side : {-1, 1}) {
      const int here = side < 0 ? kLeft : kRight;
      EXPECT_EQ(seen_in(side * 22.0, elevation_deg), kAhead);
      EXPECT_EQ(seen_in(side * 28.0, elevation_deg), here);
      EXPECT_EQ(seen_in(side * 102.0, elevation_deg), here);
      EXPECT_EQ(seen_in(side * 108.0, elevation_deg), -1);
    }
  }
  EXPECT_EQ(seen_in(60.0, -28.0), -1);
}

TEST(CorridorRegions, KeepClearOfTheLensRim) {
  const camera::Camera camera = whole_fisheye();
  constexpr int kRimPx = 10;
  const auto masks = region_masks(camera, looking_down(), {}, kRimPx);
  int inside = 0;
  for (const cv::Mat& mask : masks) {
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {
        if (!mask.at<uint8_t>(v, u)) continue;
        ++inside;
        for (const auto& [du, dv] : {std::pair{-kRimPx, 0}, {kRimPx, 0}, {0, -kRimPx}, {0, kRimPx}}) {
          EXPECT_TRUE(camera.unit_ray({u + du, v + dv})) << u << ' ' << v;
        }
      }
    }
  }
  EXPECT_GT(inside, 10'000);
}

TEST(CorridorRegions, RefuseAnEmptyBandOfElevations) {
  CorridorRegions upside_down;
  std::swap(upside_down.lowest_rad, upside_down.highest_rad);
  EXPECT_THROW(region_masks(whole_fisheye(), looking_down(), upside_down, 0), std::invalid_argument);
}

TEST(WallPoint, EqualsTheSimulatedPointForEveryRotation) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    LevelFlight flight;
    const auto turn = [&] {
      return Eigen::AngleAxisd(
                 uniform(random, -0.1, 0.1),
                 Vector3d(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)).normalized())
          .toRotationMatrix();
    };
    flight.motion.R_HC1 = turn() * flight.motion.R_HC1;
    flight.motion.R_HC2 = turn() * flight.motion.R_HC2;
    flight.motion.traveled_H += Vector3d(0.0, uniform(random, -0.02, 0.02), uniform(random, -0.02, 0.02));
    const double side = trial % 2 ? 1.0 : -1.0;
    const Vector3d p_WP(uniform(random, -0.2, 2.0), side * uniform(random, 0.4, 3.0), uniform(random, -1.45, -1.0));
    const WallPoint point = wall_point(flight.pair(p_WP), side > 0 ? kRight : kLeft, flight.camera, flight.motion, {});
    EXPECT_LT((point.p_CP_H - (p_WP - flight.p_WC2)).norm(), 1e-6);
    EXPECT_NE(point.rejection, RejectionReason::outlier);
  }
}

TEST(WallPoint, ReportsTheReasonOfRejection) {
  const LevelFlight flight;
  const Vector3d wall(0.5, 1.2, -1.4);
  FlowLimits limits;
  const auto rejection = [&](const flow::RayPair& pair) {
    return wall_point(pair, kRight, flight.camera, flight.motion, limits).rejection;
  };
  EXPECT_EQ(rejection(flight.pair(wall)), RejectionReason::none);
  EXPECT_EQ(rejection(flight.pair({1.5, 1.2, -0.05})), RejectionReason::floor);

  const flow::RayPair good = flight.pair(wall);
  const double flow_radps = wall_point(good, kRight, flight.camera, flight.motion, limits).flow_radps;
  limits.fastest_radps = 0.99 * flow_radps;
  EXPECT_EQ(rejection(good), RejectionReason::too_fast);
  limits = {};
  limits.slowest_radps = 1.01 * flow_radps;
  EXPECT_EQ(rejection(good), RejectionReason::too_slow);
  limits = {};

  // A wrong match moves in the opposite direction along the circle, which is tangential but impossible.
  flow::RayPair backwards = good;
  backwards.after_px = 2.0 * good.before_px - good.after_px;
  backwards.after_C = flight.camera.unit_ray(backwards.after_px).value();
  EXPECT_EQ(rejection(backwards), RejectionReason::outlier);
  // A match that moves toward the center is rejected by the published filter.
  flow::RayPair inwards = good;
  const Eigen::Vector2d radius = good.before_px - flight.camera.project(Vector3d::UnitZ()).value();
  inwards.after_px = good.before_px - 4.0 * radius.normalized();
  inwards.after_C = flight.camera.unit_ray(inwards.after_px).value();
  limits = {};
  limits.stray_rad = pi;
  EXPECT_EQ(rejection(inwards), RejectionReason::off_tangent);
  EXPECT_EQ(rejection(backwards), RejectionReason::none);
}

TEST(SideDistance, IsTheMedianOfTheAcceptedPointsOfItsSide) {
  std::vector<WallPoint> points = {at(0, 1.0, kRight), at(1, 2.0, kRight),
                                   at(2, 9.0, kRight), at(0, -3.0, kLeft),
                                   at(0, -5.0, kLeft), at(0, 0.1, kRight, RejectionReason::too_fast),
                                   at(2, 0.2, kAhead)};
  EXPECT_EQ(side_distance(points, kRight, 1).distance_m, 2.0);
  EXPECT_EQ(side_distance(points, kRight, 1).count, 3);
  EXPECT_EQ(side_distance(points, kLeft, 1).distance_m, 4.0);
  EXPECT_TRUE(std::isnan(side_distance(points, kLeft, 3).distance_m));
  EXPECT_TRUE(std::isnan(side_distance({}, kLeft, 0).distance_m));
}

TEST(CenteringError, GoesFromMinusOneAtTheRightWallToOneAtTheLeft) {
  EXPECT_EQ(centering_error(2.5, 0.0), -1.0);
  EXPECT_EQ(centering_error(0.0, 2.5), 1.0);
  EXPECT_EQ(centering_error(1.25, 1.25), 0.0);
  EXPECT_EQ(middle_offset_m(0.5, 3.5), 1.5);  // 4 m wide, 1.5 m left of the centerline
  EXPECT_NEAR(centering_error(0.5, 3.5), 1.5 / 2.0, 1e-15);
  EXPECT_TRUE(std::isnan(centering_error(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}

TEST(CenteringError, DoesNotDependOnTheAssumedSpeed) {
  std::mt19937_64 random(9);
  for (const double scale : {1.0, 0.1, 40.0}) {
    std::vector<WallPoint> points;
    LevelFlight flight;
    for (int i = 0; i < 200; ++i) {
      const double east_m = i % 2 ? 1.9 : -0.6;
      const flow::RayPair pair = flight.pair({uniform(random, -0.2, 1.0), east_m, uniform(random, -1.5, -1.2)});
      CameraMotion assumed = flight.motion;
      assumed.traveled_H *= scale;
      assumed.height_m *= scale;
      points.push_back(wall_point(pair, i % 2 ? kRight : kLeft, flight.camera, assumed, {}));
    }
    const double left_m = side_distance(points, kLeft, 10).distance_m,
                 right_m = side_distance(points, kRight, 10).distance_m;
    EXPECT_NEAR(centering_error(left_m, right_m), (1.9 - 0.6) / 2.5, 1e-6) << scale;
  }
}

TEST(GapAhead, FindsThePillarThatTheMedianMisses) {
  std::vector<WallPoint> points;
  std::mt19937_64 random(4);
  for (int i = 0; i < 400; ++i)
    points.push_back(at(uniform(random, -0.4, 2.0), i % 2 ? 1.25 : -1.25, i % 2 ? kRight : kLeft));
  for (int i = 0; i < 30; ++i) points.push_back(at(1.4, 0.5 + 0.02 * i, kAhead));
  EXPECT_EQ(side_distance(points, kRight, 1).distance_m, 1.25);
  const Gap gap = gap_ahead(points, {});
  EXPECT_EQ(gap.left_m, 1.25);
  EXPECT_GE(gap.right_m, 0.5);
  EXPECT_LT(gap.right_m, 0.85);
}

TEST(GapAhead, IsNotReducedByAFewWrongPoints) {
  std::vector<WallPoint> points;
  std::mt19937_64 random(6);
  for (int i = 0; i < 400; ++i) {
    const double side = i % 2 ? 1.0 : -1.0, aside_m = uniform(random, 0, 1) > 0.08 ? 1.25 : 0.6;
    points.push_back(at(uniform(random, -0.4, 2.0), side * aside_m, kAhead));
  }
  const Gap gap = gap_ahead(points, {});
  EXPECT_EQ(gap.left_m, 1.25);
  EXPECT_EQ(gap.right_m, 1.25);
}

TEST(GapAhead, IgnoresPointsAlmostStraightAhead) {
  std::vector<WallPoint> points(20, at(0.5, 1.0, kRight));
  points.insert(points.end(), 20, at(1.5, 0.2, kAhead));
  EXPECT_EQ(gap_ahead(points, {}).right_m, 1.0);
  GapConfig all;
  all.least_rad = 0.0;
  EXPECT_EQ(gap_ahead(points, all).right_m, 0.2);
}

TEST(GapAhead, IsUnknownWithoutPoints) {
  const std::vector<WallPoint> points(20, at(0.5, 1.0, kRight));
  EXPECT_TRUE(std::isnan(gap_ahead(points, {}).left_m));
  EXPECT_EQ(gap_ahead(points, {}).right_m, 1.0);
}

TEST(TimeToContact, IsTwoOverTheDivergenceOfFlowStraightAhead) {
  // A wall across the path at 2 m, approached at 0.8 m/s; divergence of the flow by differences on the unit sphere.
  const double dt_s = 1e-3, range_m = 2.0, v_mps = 0.8, small_rad = 0.01;
  const Vector3d traveled(v_mps * dt_s, 0, 0);
  const auto ray = [&](double y, double z, double x_m) { return Vector3d(x_m, range_m * y, range_m * z).normalized(); };
  const auto flow = [&](double y, double z) -> Vector3d {
    return (ray(y, z, range_m - v_mps * dt_s) - ray(y, z, range_m)) / dt_s;
  };
  const double divergence_per_s =
      (flow(small_rad, 0).y() - flow(-small_rad, 0).y() + flow(0, small_rad).z() - flow(0, -small_rad).z()) /
      (2.0 * small_rad);
  const double found_s =
      time_to_contact_s(ray(small_rad, 0, range_m), ray(small_rad, 0, range_m - v_mps * dt_s), traveled, dt_s);
  EXPECT_NEAR(found_s, 2.0 / divergence_per_s, 2e-3);
  EXPECT_NEAR(found_s, range_m / v_mps - dt_s, 1e-9);
}

TEST(FreeTime, CountsOnlyPointsInThePathOfTheBody) {
  std::vector<WallPoint> points;
  for (int i = 0; i < 8; ++i) {
    points.push_back(at(2.0, 0.05 * i, kAhead));
    points.back().contact_s = 2.0 + 0.1 * i;
    points.push_back(at(0.5, 0.6 + 0.05 * i, kAhead));
    points.back().contact_s = 0.5;
  }
  EXPECT_NEAR(free_time_s(points, {1, 0}, 0.4, 3), 2.2, 1e-12);
  EXPECT_NEAR(free_time_s(points, {1, 0}, 2.0, 3), 0.5, 1e-12);
  EXPECT_EQ(free_time_s(points, {1, 0}, 0.12, 4), std::numeric_limits<double>::infinity());
  EXPECT_EQ(free_time_s(points, {-1, 0}, 0.4, 3), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace hedgehop::vision::corridor
