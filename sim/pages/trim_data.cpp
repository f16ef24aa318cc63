#include "sim/pages/trim_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

Json empty_panel(const dynamics::Quantity& quantity) {
  return {{"section", "Trim of level flight"},
          {"title", quantity.group},
          {"unit", quantity.unit},
          {"note", ""},
          {"lowest", nullptr},
          {"highest", nullptr},
          {"limits", Json::array()},
          {"speed_mps", Json::array()},
          {"series", Json::array()}};
}

/// Returns the plot of a quantity, and creates it for the first quantity of a group.
Json& panel_of(Json& panels, const dynamics::Quantity& quantity) {
  for (Json& panel : panels) {
    if (panel["title"] == quantity.group && panel["unit"] == quantity.unit) return panel;
  }
  return panels.emplace_back(empty_panel(quantity));
}

}  // namespace

Json trim_data(const std::string& vehicle, const std::vector<TrimPoint>& points,
               const std::vector<double>& missing_mps) {
  Json panels = Json::array();
  for (size_t i = 0; i < points.front().flight.quantities.size(); ++i) {
    const dynamics::Quantity& quantity = points.front().flight.quantities[i];
    Json series = {{"label", fmt::format("{}, {}", quantity.meaning, quantity.name)}, {"role", ""}};
    for (const TrimPoint& point : points) series["values"].push_back(point.flight.quantities[i].value);
    panel_of(panels, quantity)["series"].push_back(std::move(series));
  }
  for (Json& panel : panels) {
    for (const TrimPoint& point : points) panel["speed_mps"].push_back(point.speed_mps);
  }
  Json notes = {"Steady level flight without wind; forward speeds are positive, heading north."};
  if (!missing_mps.empty()) notes.push_back(fmt::format("No steady flight at {} m/s.", fmt::join(missing_mps, ", ")));
  return {{"title", "Trim of " + vehicle}, {"notes", notes}, {"panels", panels}};
}

}  // namespace hedgehop::sim
