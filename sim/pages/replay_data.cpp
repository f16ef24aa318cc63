#include "sim/pages/replay_data.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/flight/json_reader.h"
#include "sim/pages/plan.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMoverStepS = 0.1;  // motion is linear in between; faster turns are not shown

/// Rounds to four decimals: 0.1 mm, or 1e-4 of a quaternion component.
Json fine(double value) { return std::round(value * 1e4) / 1e4; }

void append(Json& list, const Eigen::Vector3d& v) {
  for (const double value : v) list.push_back(milli(value));
}

Json body(const Eigen::Isometry3d& X_NS, const Eigen::Vector3d& half_extents_m) {
  Json list = Json::array();
  append(list, X_NS.translation());
  const Eigen::Quaterniond q_NS(X_NS.rotation());
  for (const double part : {q_NS.x(), q_NS.y(), q_NS.z(), q_NS.w()}) list.push_back(fine(part));
  append(list, half_extents_m);
  return list;
}

Json mesh(const Eigen::Isometry3d& X_NS, const scenes::mesh::Polyhedron& polyhedron) {
  Json corners = Json::array(), faces = Json::array();
  for (const Eigen::Vector3d& p_S : polyhedron.corners) append(corners, X_NS * p_S);
  for (const auto& face : polyhedron.faces) {
    for (const uint32_t corner : face) faces.push_back(corner);
  }
  return {{"corners", corners}, {"faces", faces}};
}

Json no_bodies() {
  return {
      {"boxes", Json::array()}, {"cylinders", Json::array()}, {"spheres", Json::array()}, {"meshes", Json::array()}};
}

Json bodies(const std::vector<scenes::Solid>& solids) {
  using Shape = scenes::Solid::Shape;
  Json json = no_bodies();
  for (const scenes::Solid& solid : solids) {
    if (solid.shape == Shape::hull || solid.shape == Shape::surface) {
      json["meshes"].push_back(mesh(solid.X_WS, solid.polyhedron));
      continue;
    }
    const char* const list = solid.shape == Shape::box        ? "boxes"
                             : solid.shape == Shape::cylinder ? "cylinders"
                                                              : "spheres";
    json[list].push_back(body(solid.X_WS, solid.half_extents_m));
  }
  return json;
}

/// Returns the highest point above the center of a body, in W.
Eigen::Vector3d top_W(const scenes::Solid& solid) {
  Eigen::AlignedBox3d box;
  const auto add = [&](const Eigen::Vector3d& p_S) { box.extend(solid.X_WS * p_S); };
  for (const Eigen::Vector3d& corner : solid.polyhedron.corners) add(corner);
  if (solid.polyhedron.corners.empty()) {
    for (const double side : {-1.0, 1.0}) {
      for (int axis = 0; axis < 3; ++axis) add(side * solid.half_extents_m[axis] * Eigen::Vector3d::Unit(axis));
    }
  }
  return {box.center().x(), box.center().y(), box.min().z()};
}

Json labels(const std::vector<scenes::Solid>& solids) {
  Json json = Json::array();
  for (const scenes::Solid& solid : solids) {
    if (solid.name.empty()) continue;
    Json label = Json::array({solid.name});
    append(label, top_W(solid));
    json.push_back(label);
  }
  return json;
}

}  // namespace

Json replay_scene(const scenes::Scene& scene, double end_s) {
  Json json = bodies(scene.solids);
  json["has_ground"] = scene.has_ground;
  json["bounds"] = plan_data({.bounds_NE_m = scene.bounds_NE_m}, 0.0, 0.0).at("bounds");
  json["step_s"] = kMoverStepS;
  json["labels"] = labels(scene.solids);
  json["movers"] = Json::array();
  for (const scenes::Mover& mover : scene.movers) {
    Json path = Json::array();
    for (int i = 0; i <= std::ceil(end_s / kMoverStepS); ++i) append(path, scenes::p_WM(mover.motion, i * kMoverStepS));
    json["movers"].push_back({{"name", mover.name}, {"bodies", bodies(mover.solids)}, {"way", path}});
  }
  return json;
}

Json replay_hull(const std::vector<dynamics::HullPart>& hull) {
  Json json = no_bodies();
  for (const dynamics::HullPart& part : hull) {
    const bool is_box = part.shape == dynamics::HullPart::Shape::box;
    json[is_box ? "boxes" : "cylinders"].push_back(
        body(Eigen::Isometry3d(Eigen::Translation3d(part.center_B_m)), part.half_extents_m));
  }
  return json;
}

Json replay_statuses(const Table& decisions) {
  Json json = Json::array();
  const auto& t_s = decisions.numbers("t_s");
  const auto& status = decisions.words("status");
  for (size_t row = 0; row < decisions.rows(); ++row) {
    if (row == 0 || status[row] != status[row - 1]) json.push_back({milli(t_s[row]), status[row]});
  }
  return json;
}

Json replay_path(const Table& trajectory, size_t max_rows) {
  const size_t rows = trajectory.rows();
  const size_t stride = std::max<size_t>(1, (rows + max_rows - 2) / std::max<size_t>(1, max_rows - 1));
  std::vector<size_t> kept;
  for (size_t row = 0; row < rows; row += stride) kept.push_back(row);
  if (rows > 0 && kept.back() != rows - 1) kept.push_back(rows - 1);

  Json json;
  const auto pick = [&](const char* key, const std::vector<double>& values, Json (*number)(double)) {
    json[key] = Json::array();
    for (const size_t row : kept) json[key].push_back(number(values[row]));
  };
  for (const char* key : {"t_s", "north_m", "east_m", "down_m", "clearance_m"}) {
    pick(key, trajectory.numbers(key), milli);
  }
  for (const char* key : {"roll_rad", "pitch_rad", "yaw_rad"}) pick(key, trajectory.numbers(key), fine);
  std::vector<double> speed = trajectory.numbers("v_north_mps");
  const auto east = trajectory.numbers("v_east_mps"), down = trajectory.numbers("v_down_mps");
  for (size_t i = 0; i < rows; ++i) speed[i] = std::hypot(speed[i], east[i], down[i]);
  pick("speed_mps", speed, milli);
  return json;
}

}  // namespace hedgehop::sim
