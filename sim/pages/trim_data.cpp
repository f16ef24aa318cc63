#include "sim/pages/trim_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

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

void add_limit(Json& panel, const std::string& label, const std::optional<double>& value) {
  if (!value) return;
  const Json limit = {{"label", label}, {"value", std::round(*value * 1e4) / 1e4}};
  if (std::ranges::find(panel["limits"], limit) == panel["limits"].end()) panel["limits"].push_back(limit);
}

/// Returns the plot of the margins to all limits.
Json margin_panel(const std::vector<TrimPoint>& points) {
  Json panel = empty_panel({"", "%", 0.0, "Margins to the limits", ""});
  panel["note"] = "share of the travel or of the limit that remains";
  panel["limits"] = {{{"label", "limit"}, {"value", 0}}};
  for (size_t i = 0; i < points.front().flight.quantities.size(); ++i) {
    const dynamics::Quantity& quantity = points.front().flight.quantities[i];
    if (!quantity.has_limit()) continue;
    Json series = {{"label", fmt::format("{}, {}", quantity.meaning, quantity.name)}, {"role", ""}};
    for (const TrimPoint& point : points) series["values"].push_back(point.flight.quantities[i].margin_percent());
    panel["series"].push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Json trim_data(const std::string& vehicle, const std::vector<TrimPoint>& points,
               const std::vector<double>& missing_mps) {
  Json panels = Json::array();
  for (size_t i = 0; i < points.front().flight.quantities.size(); ++i) {
    const dynamics::Quantity& quantity = points.front().flight.quantities[i];
    Json series = {{"label", fmt::format("{}, {}", quantity.meaning, quantity.name)}, {"role", ""}};
    for (const TrimPoint& point : points) series["values"].push_back(point.flight.quantities[i].value);
    Json& panel = panel_of(panels, quantity);
    panel["series"].push_back(std::move(series));
    add_limit(panel, "lower limit", quantity.lowest);
    add_limit(panel, "upper limit", quantity.highest);
  }
  if (Json margins = margin_panel(points); !margins["series"].empty()) panels.push_back(std::move(margins));
  for (Json& panel : panels) {
    for (const TrimPoint& point : points) panel["speed_mps"].push_back(point.speed_mps);
  }
  Json notes = {"Steady level flight without wind; forward speeds are positive, heading north."};
  if (!missing_mps.empty()) notes.push_back(fmt::format("No steady flight at {} m/s.", fmt::join(missing_mps, ", ")));
  for (const TrimPoint& point : points) {
    if (const auto beyond = point.flight.beyond(); !beyond.empty()) {
      notes.push_back(fmt::format("Not flyable at {} m/s: {}.", point.speed_mps, fmt::join(beyond, "; ")));
    }
  }
  return {{"title", "Trim of " + vehicle}, {"notes", notes}, {"panels", panels}};
}

}  // namespace hedgehop::sim
