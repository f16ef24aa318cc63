#include "sim/pages/plan_data.h"

#include <nlohmann/json.hpp>

#include "sim/record/json_number.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

/// How far above or below the flown band a solid may lie and still be drawn as an obstacle: a vehicle's half height.
constexpr double kLevelMarginM = 1.0;

const char* word(Level level) {
  switch (level) {
    case Level::below:
      return "below";
    case Level::beside:
      return "beside";
    case Level::above:
      return "above";
  }
  return "";
}

}  // namespace

nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m) {
  Json json;
  json["bounds"] = Json::array();
  if (!plan.bounds_NE_m.isEmpty()) {
    const Eigen::Vector2d low = plan.bounds_NE_m.min(), high = plan.bounds_NE_m.max();
    json["bounds"] = {milli(low.x()), milli(high.x()), milli(low.y()), milli(high.y())};
  }
  json["footprints"] = Json::array();
  for (const Footprint& footprint : plan.footprints) {
    Json corners = Json::array();
    for (const Eigen::Vector2d& p : footprint.corners_NE_m) corners.push_back({milli(p.x()), milli(p.y())});
    json["footprints"].push_back({{"name", footprint.name},
                                  {"level", word(level(footprint, lowest_m, highest_m, kLevelMarginM))},
                                  {"bottom", milli(footprint.bottom_m)},
                                  {"top", milli(footprint.top_m)},
                                  {"corners", corners}});
  }
  json["movers"] = Json::array();
  for (const MoverPath& mover : plan.movers) {
    Json path = Json::array();
    for (const Eigen::Vector2d& p : mover.corners_NE_m) path.push_back({milli(p.x()), milli(p.y())});
    json["movers"].push_back({{"name", mover.name}, {"radius", milli(mover.radius_m)}, {"way", path}});
  }
  return json;
}

}  // namespace hedgehop::sim
