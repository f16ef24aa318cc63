#include "sim/record/run_record.h"

#include <nlohmann/json.hpp>

#include "sim/flight/json_reader.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

Json line(const std::vector<Eigen::Vector2d>& places_NE) {
  Json places = Json::array();
  for (const Eigen::Vector2d& p : places_NE) places.push_back({milli(p.x()), milli(p.y())});
  return places;
}

Json place(const Eigen::Vector3d& p_W) { return {{"n", milli(p_W.x())}, {"e", milli(p_W.y())}, {"d", milli(p_W.z())}}; }

}  // namespace

Json map_data(const MapRecord& map) {
  Json json = {{"points", Json::array()}, {"corners", Json::array()}};
  for (const RecordedPoint& recorded : map.points) {
    Json point = place(recorded.p_W);
    const Eigen::Matrix3d& P = recorded.covariance_W;
    point["covariance"] = {brief(P(0, 0)), brief(P(0, 1)), brief(P(1, 1))};
    point["true"] = recorded.is_true ? Json(*recorded.is_true) : Json(nullptr);
    json["points"].push_back(point);
  }
  for (const RecordedCorner& recorded : map.corners) {
    Json corner = place(recorded.p_W);
    corner["counts"] = recorded.counts;
    corner["found"] = recorded.found;
    json["corners"].push_back(corner);
  }
  json["course"] = line(map.course_NE);
  json["paths"] = Json::array();
  for (const PlannedPath& path : map.paths) {
    json["paths"].push_back({{"t", milli(path.t_s)}, {"places", line(path.places_NE)}});
  }
  return json;
}

}  // namespace hedgehop::sim
