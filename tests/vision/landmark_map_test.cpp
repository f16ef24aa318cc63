#include "vision/landmark_map.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <stdexcept>

#include "scenes/highrise.h"
#include "tests/vision/landmark_flight.h"
#include "tests/vision/random_lenses.h"

namespace hedgehop::vision {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

LandmarkMapConfig config_of(LandmarkCoordinates coordinates) {
  LandmarkMapConfig config;
  config.start.coordinates = coordinates;
  return config;
}

/// A flight of the thesis with the time it must converge in.
struct Asked {
  std::string name;
  CornerFlight flight;
  double converged_s;
  friend std::ostream& operator<<(std::ostream& out, const Asked& asked) { return out << asked.name; }
};

Asked cube_lateral() {
  const scenes::HighriseConfig cube{.layout = scenes::HighriseConfig::Layout::cube};
  return {"cube_lateral", lateral_flight(scenes::highrise_corners(cube), {0, 0, -9}), 30.0};
}
Asked skyline_lateral() {
  return {"skyline_lateral", lateral_flight(scenes::highrise_corners({.scale = 0.5}), {0, 0, -7}), 50.0};
}
Asked skyline_forward() { return {"skyline_forward", forward_flight(scenes::highrise_corners({})), 100.0}; }

const char* name_of(LandmarkCoordinates coordinates) {
  return coordinates == LandmarkCoordinates::cartesian ? "ground" : "inverse_depth";
}

class ThesisFlight : public testing::TestWithParam<std::tuple<Asked, LandmarkCoordinates>> {};
INSTANTIATE_TEST_SUITE_P(
    LandmarkMap, ThesisFlight,
    testing::Combine(testing::Values(cube_lateral(), skyline_lateral(), skyline_forward()),
                     testing::Values(LandmarkCoordinates::cartesian, LandmarkCoordinates::inverse_depth)),
    [](const auto& instance) { return std::get<0>(instance.param).name + "_" + name_of(std::get<1>(instance.param)); });

TEST_P(ThesisFlight, FindsEveryCornerInTheTimeAskedAndNothingElse) {
  const auto& [asked, coordinates] = GetParam();
  std::string times_s;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const CornerFlightResult result = fly(asked.flight, config_of(coordinates), seed);
    EXPECT_LE(result.converged_s, asked.converged_s) << "seed " << seed;
    EXPECT_EQ(result.landmarks, asked.flight.corners_W.size()) << "seed " << seed;
    times_s += std::to_string(result.converged_s).substr(0, 4) + " ";
  }
  RecordProperty("converged_s", times_s);
}

class Consistency : public testing::TestWithParam<LandmarkCoordinates> {};
INSTANTIATE_TEST_SUITE_P(LandmarkMap, Consistency,
                         testing::Values(LandmarkCoordinates::cartesian, LandmarkCoordinates::inverse_depth),
                         [](const auto& instance) { return name_of(instance.param); });

// One landmark of each of 50 flights: the sum of their squared normalised errors is chi-square of 150 degrees of
// freedom.
TEST_P(Consistency, NormalisedErrorsLieWithinTheirChiSquareBounds) {
  constexpr double kLeast = 99.4, kMost = 213.7;  // 0.05 % and 99.95 % of chi-square with 150 degrees of freedom
  CornerFlight flight = skyline_lateral().flight;
  flight.duration_s = 60.0;
  std::map<int, double> sum_at_s;
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    const size_t corner = static_cast<size_t>(seed) % flight.corners_W.size();
    fly(flight, config_of(GetParam()), seed, [&](double t_s, const LandmarkMap& map, const auto& id_of) {
      for (const int at_s : {10, 20, 40, 60}) {
        if (std::abs(t_s - at_s) > 1e-6) continue;
        const auto found = std::ranges::find(map.landmarks(), id_of.at(corner), &MappedLandmark::id);
        ASSERT_NE(found, map.landmarks().end());
        const Vector3d error = position_W(found->landmark) - flight.corners_W[corner];
        sum_at_s[at_s] += error.dot(covariance_W(found->landmark).inverse() * error);
      }
    });
  }
  ASSERT_EQ(sum_at_s.size(), 4U);
  for (const auto& [at_s, sum] : sum_at_s) {
    EXPECT_GT(sum, kLeast) << at_s << " s";
    EXPECT_LT(sum, kMost) << at_s << " s";
  }
}

/// A map seen by a camera that stands still.
class StandingCamera : public testing::Test {
 protected:
  std::vector<int64_t> see(const std::vector<Vector2d>& corners_px) { return map_.update(corners_px, pose_, kFrame_s); }

  LandmarkMapConfig config_{.misses = 5, .young_misses = 2, .confirm = 3};
  PinholeCamera camera_ = PinholeCamera::from_fov(640, 480, std::numbers::pi / 6.0);
  CameraPose pose_{looking_at({-40, 0, -40}, {0, 0, 0}), 0.1, 1e-4};
  LandmarkMap map_{config_, camera_};
};
using LandmarkMapOfAStandingCamera = StandingCamera;

TEST_F(LandmarkMapOfAStandingCamera, GivesACornerSeenAgainItsNumber) {
  const auto first = see({{100, 100}, {500, 300}});
  const auto again = see({{500, 300}, {100, 100}});
  EXPECT_EQ(again, (std::vector<int64_t>{first[1], first[0]}));
  EXPECT_EQ(map_.landmarks().size(), 2U);
}

TEST_F(LandmarkMapOfAStandingCamera, BeginsALandmarkForAnUnknownCorner) {
  see({{100, 100}});
  const auto ids = see({{100, 100}, {400, 200}});
  EXPECT_NE(ids[0], ids[1]);
  EXPECT_EQ(map_.landmarks().size(), 2U);
}

TEST_F(LandmarkMapOfAStandingCamera, ForgetsAConfirmedLandmarkAfterSoManyMisses) {
  for (int i = 0; i < config_.confirm; ++i) see({{320, 240}});
  for (int i = 1; i < config_.misses; ++i) {
    see({});
    EXPECT_EQ(map_.landmarks().size(), 1U) << i;
  }
  see({});
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(LandmarkMapOfAStandingCamera, ForgetsAYoungLandmarkSooner) {
  see({{320, 240}});
  for (int i = 0; i < config_.young_misses; ++i) see({});
  EXPECT_TRUE(map_.landmarks().empty());
}

TEST_F(LandmarkMapOfAStandingCamera, KeepsALandmarkThatIsOutOfView) {
  for (int i = 0; i < config_.confirm; ++i) see({{320, 240}});
  pose_.X_WC_est = looking_at({-40, 0, -40}, {-80, 0, 0});
  for (int i = 0; i < 3 * config_.misses; ++i) see({});
  EXPECT_EQ(map_.landmarks().size(), 1U);
}

TEST(LandmarkMap, RefusesABadConfig) {
  const PinholeCamera camera = PinholeCamera::from_fov(64, 64, 1.0);
  const auto refuse = [&](auto change) {
    LandmarkMapConfig config;
    change(config);
    EXPECT_THROW(LandmarkMap(config, camera), std::invalid_argument);
  };
  refuse([](LandmarkMapConfig& c) { c.start.ground_sigma = 0; });
  refuse([](LandmarkMapConfig& c) { c.start.nearest_m = -1; });
  refuse([](LandmarkMapConfig& c) { c.start.beyond_horizon_m = NAN; });
  refuse([](LandmarkMapConfig& c) { c.pixel_sigma_px = 0; });
  refuse([](LandmarkMapConfig& c) { c.position_sigma_m = -1; });
  refuse([](LandmarkMapConfig& c) { c.attitude_sigma_rad = NAN; });
  refuse([](LandmarkMapConfig& c) { c.drift_m_rt_s = -1; });
  refuse([](LandmarkMapConfig& c) { c.gate = 0; });
  refuse([](LandmarkMapConfig& c) { c.misses = 0; });
  refuse([](LandmarkMapConfig& c) { c.young_misses = 0; });
  refuse([](LandmarkMapConfig& c) { c.confirm = 0; });
}

}  // namespace
}  // namespace hedgehop::vision
