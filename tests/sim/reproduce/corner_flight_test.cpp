#include "sim/reproduce/corner_flight.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <tuple>

#include "sim/reproduce/landmark_flights.h"

namespace hedgehop::sim {
namespace {

using Eigen::Vector3d;

vision::landmarks::LandmarkMapConfig config_of(vision::landmarks::LandmarkCoordinates coordinates) {
  vision::landmarks::LandmarkMapConfig config;
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

const char* name_of(vision::landmarks::LandmarkCoordinates coordinates) {
  return coordinates == vision::landmarks::LandmarkCoordinates::cartesian ? "ground" : "inverse_depth";
}

class ThesisFlight : public testing::TestWithParam<std::tuple<Asked, vision::landmarks::LandmarkCoordinates>> {};
INSTANTIATE_TEST_SUITE_P(LandmarkMap, ThesisFlight,
                         testing::Combine(testing::Values(Asked{"cube_lateral", cube_lateral_flight(), 30.0},
                                                          Asked{"highrise_lateral", highrise_lateral_flight(), 50.0},
                                                          Asked{"highrise_forward", highrise_forward_flight(), 100.0}),
                                          testing::Values(vision::landmarks::LandmarkCoordinates::cartesian,
                                                          vision::landmarks::LandmarkCoordinates::inverse_depth)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param).name + "_" + name_of(std::get<1>(instance.param));
                         });

TEST_P(ThesisFlight, FindsAllCornersInTheRequiredTimeWithoutFalseLandmarks) {
  const auto& [asked, coordinates] = GetParam();
  std::string times_s;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const CornerFlightResult result = fly_past_corners(asked.flight, config_of(coordinates), seed);
    EXPECT_LE(result.converged_s, asked.converged_s) << "seed " << seed;
    EXPECT_EQ(result.landmarks, asked.flight.corners_W.size()) << "seed " << seed;
    times_s += std::to_string(result.converged_s).substr(0, 4) + " ";
  }
  RecordProperty("converged_s", times_s);
}

class Consistency : public testing::TestWithParam<vision::landmarks::LandmarkCoordinates> {};
INSTANTIATE_TEST_SUITE_P(LandmarkMap, Consistency,
                         testing::Values(vision::landmarks::LandmarkCoordinates::cartesian,
                                         vision::landmarks::LandmarkCoordinates::inverse_depth),
                         [](const auto& instance) { return name_of(instance.param); });

// One landmark of each of 50 flights: the sum of their squared normalized errors is chi-square of 150 degrees of
// freedom.
TEST_P(Consistency, NormalizedErrorsLieWithinTheirChiSquareBounds) {
  constexpr double kLeast = 99.4, kMost = 213.7;  // 0.05 % and 99.95 % of chi-square with 150 degrees of freedom
  CornerFlight flight = highrise_lateral_flight();
  flight.duration_s = 60.0;
  std::map<int, double> sum_at_s;
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    const size_t corner = static_cast<size_t>(seed) % flight.corners_W.size();
    fly_past_corners(flight, config_of(GetParam()), seed,
                     [&](double t_s, const vision::landmarks::LandmarkMap& map, const auto& id_of) {
                       for (const int at_s : {10, 20, 40, 60}) {
                         if (std::abs(t_s - at_s) > 1e-6) continue;
                         const auto found = std::ranges::find(map.landmarks(), id_of.at(corner),
                                                              &vision::landmarks::MappedLandmark::id);
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

TEST(LandmarkFlights, ErrorsOfTheWholeMapEndWithinThreePercent) {
  const Columns columns = cube_lateral_errors();
  for (const std::string& name : landmark_error_columns()) EXPECT_EQ(columns.at(name).size(), 1001U) << name;
  EXPECT_GT(columns.at("ground_percent").front(), 3.0);
  EXPECT_LT(columns.at("ground_percent").back(), 3.0);
  EXPECT_LT(columns.at("inverse_depth_percent").back(), 3.0);
}

// A cube of 18 m has twelve edges of 18 m, drawn between the corners that lie next to one another.
TEST(LandmarkFlights, OutlineOfTheCubeHasTwelveEdgesOfItsSide) {
  const Columns columns = cube_lateral_map();
  for (const std::string& name : landmark_map_columns()) ASSERT_EQ(columns.at(name).size(), 36U) << name;
  for (size_t i = 0; i < 36; i += 3) {
    Vector3d side;
    int axis = 0;
    for (const char* name : {"true_north_m", "true_east_m", "true_altitude_m"}) {
      side[axis++] = columns.at(name)[i + 1] - columns.at(name)[i];
      EXPECT_TRUE(std::isnan(columns.at(name)[i + 2]));
    }
    EXPECT_NEAR(side.norm(), 18.0, 1e-9);
    EXPECT_NEAR(side.cwiseAbs().maxCoeff(), 18.0, 1e-9);
  }
}

}  // namespace
}  // namespace hedgehop::sim
