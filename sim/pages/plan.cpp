#include "sim/pages/plan.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "sim/flight/json_reader.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

// Corners of a body with the plan outline of the solid; for round bodies, evenly spaced points of the outline.
std::vector<Eigen::Vector3d> corners_W(const scenes::Solid& solid) {
  using Shape = scenes::Solid::Shape;
  std::vector<Eigen::Vector3d> corners;
  if (solid.shape == Shape::hull || solid.shape == Shape::surface) {
    for (const Eigen::Vector3d& p_S : solid.polyhedron.corners) corners.push_back(solid.X_WS * p_S);
  } else if (solid.shape == Shape::box) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1, (corner & 4) != 0 ? 1 : -1);
      corners.push_back(solid.X_WS * solid.half_extents_m.cwiseProduct(sign));
    }
  } else {
    constexpr int kRound = 32;
    const bool is_ball = solid.shape == Shape::sphere;
    for (int k = 0; k < kRound; ++k) {
      const double turn = 2.0 * std::numbers::pi * k / kRound;
      const Eigen::Vector3d out = solid.half_extents_m.x() * Eigen::Vector3d(std::cos(turn), std::sin(turn), 0.0);
      for (const double end : {-1.0, 1.0}) {
        const Eigen::Vector3d along(0.0, 0.0, end * solid.half_extents_m.z());
        corners.push_back(is_ball ? solid.X_WS.translation() + out : solid.X_WS * (out + along));
      }
    }
  }
  return corners;
}

SolidOutline footprint(const scenes::Solid& solid) {
  std::vector<cv::Point2f> corners;
  for (const Eigen::Vector3d& p_W : corners_W(solid)) {
    corners.emplace_back(static_cast<float>(p_W.x()), static_cast<float>(p_W.y()));
  }
  const Eigen::AlignedBox3d box_W = scenes::bounds_W(solid);
  std::vector<cv::Point2f> outline;
  cv::convexHull(corners, outline);

  SolidOutline result{.name = solid.name, .bottom_m = -box_W.max().z(), .top_m = -box_W.min().z()};
  for (const cv::Point2f& p : outline) result.corners_NE_m.emplace_back(p.x, p.y);
  return result;
}

/// Maximum vertical distance of a solid at flight altitude from the flown altitudes: half the height of a vehicle.
constexpr double kLevelMarginM = 1.0;

const char* word(AltitudeRelation relation) {
  switch (relation) {
    case AltitudeRelation::below:
      return "below";
    case AltitudeRelation::at_altitude:
      return "at_altitude";
    case AltitudeRelation::above:
      return "above";
  }
  return "";
}

}  // namespace

std::vector<SolidOutline> solid_outlines(const std::vector<scenes::Solid>& solids) {
  std::vector<SolidOutline> result;
  result.reserve(solids.size());
  std::ranges::transform(solids, std::back_inserter(result), footprint);
  return result;
}

std::vector<MoverPath> mover_paths(const std::vector<scenes::Mover>& movers) {
  std::vector<MoverPath> paths;
  for (const scenes::Mover& mover : movers) {
    MoverPath& path = paths.emplace_back(MoverPath{.name = mover.name});
    for (const Eigen::Vector3d& corner_W : scenes::path_W(mover.motion))
      path.corners_NE_m.push_back(corner_W.head<2>());
    for (const SolidOutline& part : solid_outlines(mover.solids)) {
      for (const Eigen::Vector2d& corner : part.corners_NE_m) path.radius_m = std::max(path.radius_m, corner.norm());
    }
  }
  return paths;
}

ScenePlan scene_plan(const scenes::Scene& scene) {
  return {solid_outlines(scene.solids), mover_paths(scene.movers), scene.bounds_NE_m};
}

AltitudeRelation altitude_relation(const SolidOutline& footprint, double lowest_m, double highest_m, double margin_m) {
  if (footprint.top_m < lowest_m - margin_m) return AltitudeRelation::below;
  if (footprint.bottom_m > highest_m + margin_m) return AltitudeRelation::above;
  return AltitudeRelation::at_altitude;
}

nlohmann::ordered_json plan_data(const ScenePlan& plan, double lowest_m, double highest_m) {
  Json json;
  json["bounds"] = Json::array();
  if (!plan.bounds_NE_m.isEmpty()) {
    const Eigen::Vector2d low = plan.bounds_NE_m.min(), high = plan.bounds_NE_m.max();
    json["bounds"] = {milli(low.x()), milli(high.x()), milli(low.y()), milli(high.y())};
  }
  json["footprints"] = Json::array();
  for (const SolidOutline& footprint : plan.outlines) {
    Json corners = Json::array();
    for (const Eigen::Vector2d& p : footprint.corners_NE_m) corners.push_back({milli(p.x()), milli(p.y())});
    json["footprints"].push_back({{"name", footprint.name},
                                  {"level", word(altitude_relation(footprint, lowest_m, highest_m, kLevelMarginM))},
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
