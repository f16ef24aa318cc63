#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "scenes/map/building_body.h"
#include "scenes/map/fault_lines.h"
#include "scenes/map/footprint_shape.h"
#include "scenes/map/tags.h"

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

TEST(LocalPlane, TheOppositeSideOfTheEarthIsFarAway) {
  const LocalPlane plane(kOrigin);
  for (const GeoPoint& place : {GeoPoint{-47.0, -172.0}, {-46.999, -172.001}, {90.0, 0.0}, {0.0, 8.0}})
    EXPECT_GT(plane.p_NE(place).norm(), 1e6);
}

/// Reads one tag as a length.
std::optional<double> length_m(const std::string& text, Lines& faults) {
  const std::string name = "way 1";
  const Tags tags{{"height", text}};
  return TagReader(name, tags, faults).length_m("height", 0.1, 1500.0);
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
  for (const std::string text :
       {"tall", "-3", "12,5", "3 storeys", "", "1e9", "nan", "inf", "0", "1501", "99999999999999999999", "0x10"}) {
    Lines faults;
    EXPECT_EQ(length_m(text, faults), std::nullopt);
    EXPECT_THAT(faults, ElementsAre("way 1: height='" + text +
                                    "' cannot be read; valid: 0.1 to 1500 m, such as 12.5, or in feet, such as 40 ft"));
  }
}

TEST(MapTags, ReportsFitIntoOneLine) {
  Lines faults;
  EXPECT_EQ(length_m("a\nb\x1b" + std::string(1000, 'c'), faults), std::nullopt);
  EXPECT_EQ(faults.at(0).find_first_of("\n\x1b"), std::string::npos);
  EXPECT_LT(faults[0].size(), 200u);
}

TEST(MapTags, DirectionsAreDegreesOrPointsOfTheCompass) {
  const std::string name = "way 1";
  Lines faults;
  const auto direction_deg = [&](const std::string& text) {
    const Tags tags{{"roof:direction", text}};
    return TagReader(name, tags, faults).direction_deg("roof:direction");
  };
  EXPECT_EQ(direction_deg("117.5"), 117.5);
  EXPECT_EQ(direction_deg("N"), 0.0);
  EXPECT_EQ(direction_deg("SW"), 225.0);
  EXPECT_EQ(direction_deg("WNW"), 292.5);
  EXPECT_THAT(faults, IsEmpty());
  for (const std::string text : {"-1", "361", "north", ""}) EXPECT_EQ(direction_deg(text), std::nullopt);
  EXPECT_EQ(faults.size(), 4u);
}

TEST(MapFaults, EachObjectHasOneLine) {
  EXPECT_THAT(one_line_each({"way 1: a", "node 1: b", "way 1: c", "way 1: a", "way 12: d: e"}),
              ElementsAre("way 1: a; c", "node 1: b", "way 12: d: e"));
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
  for (const Tags& tags : {Tags{{"building:levels", "-2"}}, Tags{{"building:levels", "2000"}}, Tags{{"height", "-4"}},
                           Tags{{"height", "nan"}}, Tags{{"height", "8849"}}}) {
    Lines own;
    EXPECT_EQ(building(tags, own).height_m, 6.0);
    EXPECT_EQ(own.size(), 1u);
  }
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

TEST(MapBuildings, OutlinesWithoutAUsableAreaAreLeftOutAndReported) {
  const MapBuilding flat{.name = "way 1", .footprints = {}, .height_m = 9.0};
  PlanRing star;  // closed, with 6000 corners
  for (int i = 0; i < 6000; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 6000.0, radius_m = i % 2 == 0 ? 50.0 : 40.0;
    star.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  for (const Footprint& footprint : {Footprint{{{0, 0}, {10, 0}, {20, 0}}, {}},
                                     Footprint{{{0, 0}, {1e-4, 0}, {0, 1e-4}}, {}}, Footprint{star, {}}}) {
    Lines faults;
    EXPECT_TRUE(body_of(footprint, flat, faults).hulls.empty());
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_THAT(faults[0], testing::StartsWith("way 1: left out, since its outline has "));
  }
}

TEST(MapBuildings, AnOutlineThatTouchesItselfIsReported) {
  const MapBuilding flat{.name = "way 1", .footprints = {}, .height_m = 9.0};
  Lines faults;
  const Footprint far_hole{{{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{{40, 0}, {40, 5}, {45, 5}, {45, 0}}}};
  body_of(far_hole, flat, faults);
  EXPECT_THAT(faults, ElementsAre("way 1: its outline touches itself, so its roof is not complete"));
}

}  // namespace
}  // namespace hedgehop::scenes::map
