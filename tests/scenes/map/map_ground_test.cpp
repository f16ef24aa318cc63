#include "scenes/map/ground.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/map/fault_lines.h"
#include "scenes/map/map_trees.h"
#include "scenes/map/streets.h"
#include "scenes/map/traffic.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::IsEmpty;

const GeoPoint kGroundOrigin{47.0, 8.0};

/// Heights of a plane on a grid in degrees, in a file with any order of rows.
HeightSamples plane_samples(bool south_first) {
  HeightSamples samples{.rows = 41, .columns = 31, .samples = {}};
  const LocalPlane plane(kGroundOrigin);
  for (int row = 0; row < samples.rows; ++row) {
    for (int column = 0; column < samples.columns; ++column) {
      const double step = south_first ? row - 20 : 20 - row;
      const GeoPoint place{kGroundOrigin.latitude_deg + 1e-4 * step,
                           kGroundOrigin.longitude_deg + 1e-4 * (column - 15)};
      const Vector2d p_NE = plane.p_NE(place);
      samples.samples.push_back({place, 500.0 + 0.1 * p_NE.x() - 0.2 * p_NE.y()});
    }
  }
  return samples;
}

TEST(MapGround, APlaneInDegreesIsAPlaneInTheMap) {
  for (const bool south_first : {false, true}) {
    const Ground ground(plane_samples(south_first), LocalPlane(kGroundOrigin), {});
    for (const Vector2d& p_NE : {Vector2d(0, 0), Vector2d(31.3, -77.7), Vector2d(-150.2, 60.9), Vector2d(200.1, 99.0)})
      EXPECT_NEAR(ground.altitude_m(p_NE).value(), 0.1 * p_NE.x() - 0.2 * p_NE.y(), 1e-6) << p_NE.transpose();
    EXPECT_EQ(ground.altitude_m({300.0, 0.0}), std::nullopt);
  }
}

TEST(MapGround, TheOriginMayHaveAnAltitudeOfItsOwn) {
  const Ground ground(plane_samples(false), LocalPlane(kGroundOrigin), 490.0);
  EXPECT_NEAR(ground.altitude_m({0, 0}).value(), 10.0, 1e-9);
}

TEST(MapTrees, RowsHaveATreeEveryEightMetersAndTheirFaultsAreReported) {
  const LocalPlane plane(kGroundOrigin);
  OsmObjects objects;
  objects.tree_rows = {{"way 3", {{"height", "-1"}}, {{47.0, 8.0}, {47.0002, 8.0}}},  // 22.2 m
                       {"way 4", {}, {{47.0, 8.0}, {48.0, 8.0}}}};
  std::vector<std::string> faults;
  EXPECT_EQ(trees_of(objects, plane, 1, faults).size(), 3u);
  EXPECT_THAT(
      one_line_each(faults),
      ElementsAre("way 3: height='-1' cannot be read; valid: 1 to 130 m, such as 12.5, or in feet, such as 40 ft",
                  "way 4: points of it are more than 20 km apart"));
}

TEST(MapStreets, OnlyStreetsOnTheGroundAreDrawn) {
  const LocalPlane plane(kGroundOrigin);
  std::vector<std::string> faults;
  const auto street = [&](Tags tags) {
    return street_of({"way 2", std::move(tags), {{47.0, 8.0}, {47.001, 8.0}}}, plane, faults);
  };
  EXPECT_EQ(street({{"highway", "residential"}, {"width", "6.5"}}).value().width_m, 6.5);
  EXPECT_FALSE(street({{"highway", "proposed"}}));
  EXPECT_FALSE(street({{"highway", "primary"}, {"tunnel", "yes"}}));
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_FALSE(street({{"highway", "pedestrian"}, {"area", "yes"}}));
  EXPECT_FALSE(street({{"highway", "canal"}}));
  EXPECT_EQ(street({{"highway", "path"}, {"width", "1e6"}}).value().width_m, 1.5);
  EXPECT_THAT(faults, ElementsAre("way 2: an area with 'highway' is not drawn",
                                  "way 2: highway='canal' cannot be read; it is not drawn",
                                  "way 2: width='1e6' cannot be read; valid: 0.5 to 60 m, such as 12.5, or in feet, "
                                  "such as 40 ft"));
}

TEST(MapTraffic, CarsStayInTheRightLaneOnTheGround) {
  const Ground ground(plane_samples(false), LocalPlane(kGroundOrigin), {});
  const std::vector<Street> streets{{"way 2", {{-200, 0}, {200, 0}}, 8.0, true},
                                    {"way 3", {{0, 0}, {30, 0}}, 8.0, true}};
  std::vector<Mover> movers;
  add_traffic(streets, ground, {}, 5, 10.0, 1, movers);
  ASSERT_EQ(movers.size(), 1u);  // the other street is too short
  for (const double t_s : {0.0, 3.3, 20.0, 100.0}) {
    const Eigen::Vector3d p_W = p_WM(movers[0].motion, t_s), v_W = v_WM(movers[0].motion, t_s);
    EXPECT_NEAR(-p_W.z(), 0.1 * p_W.x() - 0.2 * p_W.y() + kStreetLiftM, 1e-6);
    EXPECT_NEAR(std::abs(p_W.y()), 2.0, 1e-9);
    EXPECT_GT(v_W.norm(), 5.9);
    EXPECT_LT(v_W.norm(), 10.1);
  }
}

}  // namespace
}  // namespace hedgehop::scenes::map
