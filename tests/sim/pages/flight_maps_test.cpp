#include "sim/pages/flight_maps.h"

#include <gmock/gmock.h>

#include <random>

#include "scenes/generators.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

std::optional<FlownPath> flight(const scenes::SceneConfig& scene, uint64_t seed) {
  return FlownPath{.scene = scene, .seed = seed, .p_NE_m = {{0.0, 0.0}, {1.0, 2.0}}};
}
scenes::SceneConfig small_city() {
  scenes::worlds::UrbanConfig city;
  city.extent_m = 100.0;
  city.texture_size_px = 64;
  return city;
}
scenes::SceneConfig small_room() {
  scenes::worlds::RoomConfig room;
  room.texture_size_px = 64;
  return room;
}

TEST(FlightMaps, FlightsShareAMapIfAndOnlyIfTheirScenesHaveEqualSolids) {
  std::vector<std::optional<FlownPath>> flights;
  for (const uint64_t seed : {1u, 2u, 1u, 3u}) flights.push_back(flight(small_city(), seed));
  flights.emplace_back();  // a flight without a folder
  for (uint64_t seed = 1; seed <= 12; ++seed) flights.push_back(flight(small_room(), seed));
  const FlightMaps maps = flight_maps(flights);
  ASSERT_EQ(maps.map_of.size(), flights.size());
  EXPECT_FALSE(maps.map_of[4]);
  const auto solids = [](const FlownPath& f) {
    std::vector<Eigen::Vector3d> places;
    for (const auto& solid : scenes::make_scene(f.scene, stream_seed(f.seed, kSceneStream)).solids) {
      places.push_back(solid.X_WS.translation());
      places.push_back(solid.half_extents_m);
    }
    return places;
  };
  for (size_t i = 0; i < flights.size(); ++i) {
    for (size_t k = i + 1; k < flights.size(); ++k) {
      if (!flights[i] || !flights[k]) continue;
      ASSERT_TRUE(maps.map_of[i] && maps.map_of[k]);
      EXPECT_EQ(maps.map_of[i] == maps.map_of[k], solids(*flights[i]) == solids(*flights[k])) << i << ", " << k;
    }
  }
}

TEST(FlightMaps, OmitsScenesBeyondTheLimit) {
  std::vector<std::optional<FlownPath>> flights;
  for (uint64_t seed = 1; seed <= 30; ++seed) flights.push_back(flight(small_city(), seed));
  const FlightMaps maps = flight_maps(flights);
  EXPECT_EQ(maps.plans.size(), 24u);
  EXPECT_TRUE(maps.map_of[23]);
  EXPECT_FALSE(maps.map_of[24]);
}

TEST(PathsData, StepsAddUpToThePathWithinHalfACentimeter) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> step(0.0, 3.0);
  FlownPath path{.scene = small_room(), .seed = 1, .p_NE_m = {{-120.004, 300.0}}};
  while (path.p_NE_m.size() < 300)
    path.p_NE_m.emplace_back(path.p_NE_m.back() + Eigen::Vector2d(step(random), step(random)));
  const std::vector<std::optional<FlownPath>> flights = {path};
  const auto steps = paths_data(flight_maps(flights), flights).at("path").at(0).get<std::vector<int64_t>>();
  ASSERT_EQ(steps.size(), 2 * path.p_NE_m.size());
  int64_t north_cm = 0, east_cm = 0;
  for (size_t i = 0; i < path.p_NE_m.size(); ++i) {
    north_cm += steps[2 * i];
    east_cm += steps[2 * i + 1];
    EXPECT_NEAR(0.01 * static_cast<double>(north_cm), path.p_NE_m[i].x(), 0.005 + 1e-9);
    EXPECT_NEAR(0.01 * static_cast<double>(east_cm), path.p_NE_m[i].y(), 0.005 + 1e-9);
  }
}

}  // namespace
}  // namespace hedgehop::sim
