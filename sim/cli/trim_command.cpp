#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/steady_flight.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/plot_file.h"
#include "sim/cli/vehicle_commands.h"
#include "sim/cli/vehicle_files.h"
#include "sim/config/utf8.h"
#include "sim/flight/words.h"
#include "sim/pages/report_page.h"
#include "sim/pages/trim_data.h"

namespace hedgehop::sim::cli {
namespace {

using Json = nlohmann::ordered_json;

Json trim_row_json(const TrimPoint& row) {
  Json json{{"V_mps", row.speed_mps}};
  Json margins = Json::object();
  for (const dynamics::Quantity& q : row.flight.quantities) {
    json[q.name] = q.value;
    if (q.has_limit()) margins[q.name] = q.margin_percent();
  }
  const std::vector<std::string> beyond = row.flight.beyond();
  json["margin_percent"] = std::move(margins);
  json["within_limits"] = beyond.empty();
  json["beyond"] = beyond;
  return json;
}

void print_trim_csv(const std::vector<TrimPoint>& rows) {
  std::vector<std::string> heads{"V_mps"}, margins;
  for (const dynamics::Quantity& q : rows.front().flight.quantities) {
    heads.push_back(q.name);
    if (q.has_limit()) margins.push_back(q.name + "_margin_percent");
  }
  fmt::print("{},{},beyond\n", fmt::join(heads, ","), fmt::join(margins, ","));
  for (const TrimPoint& row : rows) {
    std::string cells = fmt::format("{}", row.speed_mps), margin_cells;
    for (const dynamics::Quantity& q : row.flight.quantities) {
      cells += fmt::format(",{}", q.value);
      if (q.has_limit()) margin_cells += fmt::format(",{}", q.margin_percent());
    }
    fmt::print("{}{},\"{}\"\n", cells, margin_cells, fmt::join(row.flight.beyond(), "; "));
  }
}

/// A column of the table: two lines of heading, and a text per row.
struct Column {
  std::string name, unit;
  std::vector<std::string> cells;

  size_t width() const {
    size_t widest = std::max(name.size(), unit.size());
    for (const std::string& cell : cells) widest = std::max(widest, cell.size());
    return widest;
  }
};

std::vector<Column> trim_columns(const std::vector<TrimPoint>& rows) {
  std::vector<Column> columns{{"V", "m/s", {}}};
  for (const TrimPoint& row : rows) columns[0].cells.push_back(decimals(row.speed_mps, 2));
  for (size_t i = 0; i < rows.front().flight.quantities.size(); ++i) {
    const dynamics::Quantity& head = rows.front().flight.quantities[i];
    Column values{head.name, head.unit, {}}, margins{"margin", "%", {}};
    for (const TrimPoint& row : rows) {
      const dynamics::Quantity& q = row.flight.quantities[i];
      values.cells.push_back(decimals(q.value, 2) + (q.beyond() ? "!" : ""));
      if (q.has_limit()) margins.cells.push_back(decimals(q.margin_percent(), 0));
    }
    columns.push_back(std::move(values));
    if (head.has_limit()) columns.push_back(std::move(margins));
  }
  return columns;
}

/// Prints a table in which each limit's margin follows its quantity. A row beyond a limit ends with its name.
void print_trim_table(const std::vector<TrimPoint>& rows) {
  const std::vector<Column> columns = trim_columns(rows);
  const auto line = [&](auto cell) {
    std::string text;
    for (const Column& column : columns) text += fmt::format("{:>{}}", cell(column), column.width() + 2);
    return text;
  };
  fmt::print("{}\n", line([](const Column& c) { return c.name; }));
  fmt::print("{}\n", line([](const Column& c) { return c.unit; }));
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::vector<std::string> beyond = rows[i].flight.beyond();
    const std::string flag = beyond.empty() ? "" : fmt::format("  beyond: {}", fmt::join(beyond, "; "));
    fmt::print("{}{}\n", line([&](const Column& c) { return c.cells[i]; }), flag);
  }
}

void print_trim(const TrimOptions& options, const std::vector<TrimPoint>& rows) {
  if (options.json) {
    Json json = Json::array();
    for (const TrimPoint& row : rows) json.push_back(trim_row_json(row));
    fmt::print("{}\n", json_text(json, 2));
  } else if (options.csv) {
    print_trim_csv(rows);
  } else {
    print_trim_table(rows);
  }
}

/// Returns a sentence about the fastest steady flight below a speed at which there is none.
std::string fastest_flight(const dynamics::VehicleConfig& vehicle, double missing_mps) {
  double found_mps = 0.0;
  auto fastest = dynamics::steady_flight(vehicle, {0.0, 0.0, 0.0});
  if (!fastest) return "the vehicle cannot hover either";
  for (double step_mps = 0.5 * missing_mps; std::abs(step_mps) > 0.05; step_mps *= 0.5) {
    auto flight = dynamics::steady_flight(vehicle, {found_mps + step_mps, 0.0, 0.0});
    if (!flight) continue;
    found_mps += step_mps;
    fastest = std::move(flight);
  }
  const std::vector<std::string> beyond = fastest->beyond();
  if (beyond.empty()) return fmt::format("the fastest is about {:.1f} m/s", found_mps);
  return fmt::format("a trim exists up to about {:.1f} m/s, but is not flyable there: beyond {}", found_mps,
                     fmt::join(beyond, "; "));
}

}  // namespace

int trim(const TrimOptions& options) {
  std::vector<double> missing_mps;
  const std::vector<TrimPoint> rows = about(options.vehicle, [&](const dynamics::VehicleConfig& vehicle) {
    std::vector<TrimPoint> found;
    for (const double speed_mps : options.speeds_mps) {
      const auto flight = dynamics::steady_flight(vehicle, {speed_mps, 0.0, 0.0});
      if (flight) {
        found.push_back({speed_mps, *flight});
      } else {
        missing_mps.push_back(speed_mps);
      }
    }
    if (found.empty()) {
      throw InputError(fmt::format("{}: no steady flight at {} m/s; {}", options.vehicle.string(),
                                   fmt::join(missing_mps, ", "), fastest_flight(vehicle, missing_mps.front())));
    }
    return found;
  });
  for (const double speed_mps : missing_mps) warn(fmt::format("no steady flight at {} m/s", speed_mps));
  for (const TrimPoint& row : rows) {
    if (const auto beyond = row.flight.beyond(); !beyond.empty()) {
      warn(fmt::format("beyond the limits, not flyable, at {} m/s: {}", row.speed_mps, fmt::join(beyond, "; ")));
    }
  }
  print_trim(options, rows);
  if (!options.plot.empty()) {
    const Json data = trim_data(options.vehicle.stem().string(), rows, missing_mps);
    write_plot(options.plot, trim_page(data["title"].get<std::string>(), json_text(data)));
  }
  return 0;
}

}  // namespace hedgehop::sim::cli
