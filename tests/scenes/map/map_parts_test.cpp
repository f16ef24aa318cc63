#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "scenes/map/building_body.h"
#include "scenes/map/footprint_shape.h"
#include "scenes/map/ground.h"
#include "scenes/map/streets.h"
#include "scenes/map/tags.h"
#include "scenes/map/traffic.h"

namespace hedgehop::scenes::map {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::IsEmpty;
using Lines = std::vector<std::string>;

const GeoPoint kOrigin{47.0, 8.0};

TEST(LocalPlane, AgreesWithAProjectionOfProj) {
  // gdaltransform -s_srs EPSG:4326 -t_srs "+proj=tmerc +lat_0=47 +lon_0=8 +k=1 +ellps=WGS84" (PROJ 9.1)
  constexpr double kOtherProjectionM = 5e-3;  // of third order in the distance of 5 km
  const LocalPlane plane(kOrigin);
  const auto expect = [&](const GeoPoint& place, double north_m, double east_m) {
    EXPECT_NEAR(plane.p_NE(place).x(), north_m, kOtherProjectionM);
    EXPECT_NEAR(plane.p_NE(place).y(), east_m, kOtherProjectionM);
  };
  expect({47.04, 8.03}, 4447.28609, 2279.97653);
  expect({46.97, 7.95}, -3333.90286, -3804.92792);
  expect({47.0, 8.06}, 1.74747, 4563.35984);
}

TEST(LocalPlane, BoundsContainTheRadius) {
  const LocalPlane plane({60.0, 8.0});
  const GeoBounds bounds = plane.bounds(5000.0);
  EXPECT_GT(plane.p_NE(bounds.northeast).minCoeff(), 5000.0);
  EXPECT_LT(plane.p_NE(bounds.southwest).maxCoeff(), -5000.0);
}

/// Reads one tag as a length.
std::optional<double> length_m(const std::string& text, Lines& faults) {
  const std::string name = "way 1";
  const Tags tags{{"height", text}};
  return TagReader(name, tags, faults).length_m("height");
}

TEST(MapTags, LengthsHaveMetersOrFeet) {
  Lines faults;
  EXPECT_EQ(length_m("12", faults), 12.0);
  EXPECT_EQ(length_m("12.5 m", faults), 12.5);
  EXPECT_EQ(length_m("7m", faults), 7.0);
  EXPECT_DOUBLE_EQ(length_m("40 ft", faults).value(), 12.192);
  EXPECT_DOUBLE_EQ(length_m("40'6\"", faults).value(), 12.3444);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MapTags, OtherLengthsAreReportedWithTheId) {
  for (const std::string text : {"tall", "-3", "12,5", "3 storeys", "", "1e9", "nan"}) {
    Lines faults;
    EXPECT_EQ(length_m(text, faults), std::nullopt);
    EXPECT_THAT(faults, ElementsAre("way 1: height='" + text +
                                    "' cannot be read; valid: a length in m, such as 12.5, or in feet, such as 40 ft"));
  }
}

/// Returns the area of a rectangle, of about 20 m by 10 m, with tags.
OsmArea rectangle(Tags tags) {
  return {"way 1", std::move(tags), {{{{47.0, 8.0}, {47.0, 8.000263}, {47.00009, 8.000263}, {47.00009, 8.0}}, {}}}};
}

MapBuilding building(Tags tags, Lines& faults) {
  return building_of(rectangle(std::move(tags)), LocalPlane(kOrigin), {}, faults);
}

TEST(MapBuildings, HeightsComeFromTagsLevelsAndDefaults) {
  Lines faults;
  EXPECT_EQ(building({}, faults).height_m, 6.0);
  EXPECT_EQ(building({{"height", "17.3"}}, faults).height_m, 17.3);
  EXPECT_EQ(building({{"building:levels", "4"}}, faults).height_m, 12.0);
  EXPECT_EQ(building({{"building:levels", "4"}, {"height", "14"}}, faults).height_m, 14.0);
  const MapBuilding gabled = building({{"height", "9"}, {"roof:shape", "gabled"}, {"roof:height", "3"}}, faults);
  EXPECT_EQ(gabled.eaves_m(), 6.0);
  const MapBuilding levels =
      building({{"building:levels", "2"}, {"roof:shape", "hipped"}, {"roof:levels", "1"}}, faults);
  EXPECT_EQ(levels.eaves_m(), 6.0);
  EXPECT_EQ(levels.height_m, 9.0);
  EXPECT_EQ(building({{"height", "9"}, {"building:min_level", "1"}}, faults).min_height_m, 3.0);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MapBuildings, TagsThatCannotBeReadAreReportedAndReplaced) {
  Lines faults;
  EXPECT_EQ(building({{"height", "high"}, {"building:levels", "3"}}, faults).height_m, 9.0);
  EXPECT_EQ(building({{"roof:shape", "onion"}}, faults).roof, RoofShape::flat);
  EXPECT_EQ(building({{"height", "3"}, {"min_height", "4"}}, faults).min_height_m, 0.0);
  EXPECT_EQ(faults.size(), 3u);
}

double volume_m3(const mesh::Polyhedron& body) {
  double six_m3 = 0.0;  // divergence theorem
  for (const auto& [a, b, c] : body.faces) six_m3 += body.corners[a].dot(body.corners[b].cross(body.corners[c]));
  return six_m3 / 6.0;
}

double volume_m3(const BuildingBody& body) {
  double sum = 0.0;
  for (const mesh::Polyhedron& hull : body.hulls) sum += volume_m3(hull);
  return sum;
}

/// Height, roof and outline of a building of 20 m (north) by 10 m, 9 m high with a roof of 3 m.
BuildingBody body(RoofShape roof, Lines& faults, Footprint footprint = {{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {}}) {
  const MapBuilding building{.name = "way 1", .footprints = {}, .height_m = 9.0, .roof = roof, .roof_height_m = 3.0};
  return body_of(footprint, building, faults);
}

TEST(MapBuildings, RoofsHaveTheVolumesOfTheirShapes) {
  Lines faults;
  const double base = 20.0 * 10.0, walls = 6.0 * base;
  constexpr double kRounding = 1e-9;
  EXPECT_NEAR(volume_m3(body(RoofShape::gabled, faults)), walls + base * 3.0 / 2.0, kRounding);
  EXPECT_NEAR(volume_m3(body(RoofShape::skillion, faults)), walls + base * 3.0 / 2.0, kRounding);
  EXPECT_NEAR(volume_m3(body(RoofShape::pyramidal, faults)), walls + base * 3.0 / 3.0, kRounding);
  // A hipped roof is a gabled one over the ridge of 10 m, and a pyramid over the two ends of 5 m each.
  EXPECT_NEAR(volume_m3(body(RoofShape::hipped, faults)), walls + 100.0 * 3.0 / 2.0 + 100.0 * 3.0 / 3.0, kRounding);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MapBuildings, ConcaveOutlinesAndCourtyardsAreFilledExactly) {
  Lines faults;
  const MapBuilding flat{.name = "way 1", .footprints = {}, .height_m = 9.0};
  const Footprint l_shape{{{0, 0}, {20, 0}, {20, 4}, {6, 4}, {6, 10}, {0, 10}}, {}};
  EXPECT_NEAR(volume_m3(body_of(l_shape, flat, faults)), 9.0 * (20 * 4 + 6 * 6), 1e-9);
  const Footprint courtyards{{{0, 0}, {30, 0}, {30, 20}, {0, 20}},
                             {{{4, 4}, {4, 16}, {12, 16}, {12, 4}}, {{16, 4}, {16, 16}, {26, 16}, {26, 4}}}};
  EXPECT_EQ(area_m2(courtyards), 600.0 - 96.0 - 120.0);
  EXPECT_NEAR(volume_m3(body_of(courtyards, flat, faults)), 9.0 * 384.0, 1e-9);
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MapBuildings, ARoofThatDoesNotFitIsFlatAndReported) {
  Lines faults;
  const BuildingBody found =
      body(RoofShape::gabled, faults, {{{0, 0}, {20, 0}, {20, 4}, {6, 4}, {6, 10}, {0, 10}}, {}});
  EXPECT_NEAR(volume_m3(found), 9.0 * 116.0, 1e-9);
  EXPECT_THAT(faults, ElementsAre("way 1: its outline does not fit its roof:shape; drawn flat"));
}

TEST(MapBuildings, SlopesOfAnIrregularOutlineBulgeOutwards) {
  Lines faults;
  const BuildingBody found = body(RoofShape::gabled, faults, {{{0, 0}, {20, 1}, {23, 12}, {-1, 9}}, {}});
  ASSERT_EQ(found.hulls.size(), 1u);
  for (const auto& [a, b, c] : found.hulls[0].faces) {
    const auto& p = found.hulls[0].corners;
    const Eigen::Vector3d out = (p[b] - p[a]).cross(p[c] - p[a]).normalized();
    for (const Eigen::Vector3d& corner : p) EXPECT_LE(out.dot(corner - p[a]), 1e-9);
  }
}

TEST(MapBuildings, CornersOnALineAreNoCorners) {
  EXPECT_EQ(simplified({{0, 0}, {10, 0}, {20, 0}, {20, 10}, {20, 10}, {10, 10.0005}, {0, 10}}).size(), 4u);
  EXPECT_THAT(simplified({{0, 0}, {10, 0}, {20, 0}}), IsEmpty());
}

/// Heights of a plane on a grid in degrees, in a file with any order of rows.
HeightSamples plane_samples(bool south_first) {
  HeightSamples samples{.rows = 41, .columns = 31, .samples = {}};
  const LocalPlane plane(kOrigin);
  for (int row = 0; row < samples.rows; ++row) {
    for (int column = 0; column < samples.columns; ++column) {
      const double step = south_first ? row - 20 : 20 - row;
      const GeoPoint place{kOrigin.latitude_deg + 1e-4 * step, kOrigin.longitude_deg + 1e-4 * (column - 15)};
      const Vector2d p_NE = plane.p_NE(place);
      samples.samples.push_back({place, 500.0 + 0.1 * p_NE.x() - 0.2 * p_NE.y()});
    }
  }
  return samples;
}

TEST(MapGround, APlaneInDegreesIsAPlaneInTheMap) {
  for (const bool south_first : {false, true}) {
    const Ground ground(plane_samples(south_first), LocalPlane(kOrigin), {});
    for (const Vector2d& p_NE : {Vector2d(0, 0), Vector2d(31.3, -77.7), Vector2d(-150.2, 60.9), Vector2d(200.1, 99.0)})
      EXPECT_NEAR(ground.altitude_m(p_NE).value(), 0.1 * p_NE.x() - 0.2 * p_NE.y(), 1e-6) << p_NE.transpose();
    EXPECT_EQ(ground.altitude_m({300.0, 0.0}), std::nullopt);
  }
}

TEST(MapGround, TheOriginMayHaveAnAltitudeOfItsOwn) {
  const Ground ground(plane_samples(false), LocalPlane(kOrigin), 490.0);
  EXPECT_NEAR(ground.altitude_m({0, 0}).value(), 10.0, 1e-9);
}

TEST(MapStreets, OnlyStreetsOnTheGroundAreDrawn) {
  const LocalPlane plane(kOrigin);
  Lines faults;
  const auto street = [&](Tags tags) {
    return street_of({"way 2", std::move(tags), {{47.0, 8.0}, {47.001, 8.0}}}, plane, faults);
  };
  EXPECT_EQ(street({{"highway", "residential"}, {"width", "6.5"}}).value().width_m, 6.5);
  EXPECT_FALSE(street({{"highway", "proposed"}}));
  EXPECT_FALSE(street({{"highway", "primary"}, {"tunnel", "yes"}}));
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_FALSE(street({{"highway", "pedestrian"}, {"area", "yes"}}));
  EXPECT_THAT(faults, ElementsAre("way 2: an area with 'highway' is not drawn"));
}

TEST(MapTraffic, CarsStayInTheRightLaneOnTheGround) {
  const Ground ground(plane_samples(false), LocalPlane(kOrigin), {});
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
