#include "sim/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

/// A number where the text is one, so that tables can be sorted and averaged.
Cell value_cell(const std::string& text) {
  if (const auto whole = parse_signed(text)) return *whole;
  const ParsedNumber parsed = parse_number(text, false);
  return parsed.kind == ParsedNumber::Kind::number ? Cell(parsed.member) : Cell(text);
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const size_t slash = text.find('/');
  const auto index = parse_unsigned(text.substr(0, slash));
  const auto of = slash == std::string::npos ? std::nullopt : parse_unsigned(text.substr(slash + 1));
  if (!index || !of || *index < 1 || *index > *of) {
    throw InputError(fmt::format("--shard {}: expected such as 2/8, from 1/8 to 8/8", text));
  }
  return {static_cast<size_t>(*index), static_cast<size_t>(*of)};
}

void SweepOrders::add(const SweepConfig& sweep, size_t point, const std::vector<std::string>& point_values) {
  for (Order& order : point_orders(sweep, point, point_values)) {
    orders.push_back(std::move(order));
    values.push_back(point_values);
    points.push_back(point);
  }
}

void SweepOrders::append(const SweepOrders& more) {
  orders.insert(orders.end(), more.orders.begin(), more.orders.end());
  values.insert(values.end(), more.values.begin(), more.values.end());
  points.insert(points.end(), more.points.begin(), more.points.end());
}

SweepOrders sweep_orders(const SweepConfig& sweep) {
  SweepOrders all;
  std::vector<std::string> faults;
  const auto points = design_points(sweep);
  for (size_t point = 0; point < points.size(); ++point) {
    try {
      all.add(sweep, point, points[point]);
    } catch (const InputError& error) {
      for (const std::string& fault : error.faults()) faults.push_back(fmt::format("point {}: {}", point, fault));
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return all;
}

SweepOrders part_of(const SweepOrders& all, Shard shard) {
  SweepOrders part;
  for (size_t i = shard.index - 1; i < all.orders.size(); i += shard.of) {
    part.orders.push_back(all.orders[i]);
    part.values.push_back(all.values[i]);
    part.points.push_back(all.points[i]);
  }
  return part;
}

Table sweep_table(const SweepConfig& sweep, const SweepOrders& orders, const std::vector<FlightRecord>& records,
                  const std::vector<ExtraColumn>& before) {
  std::vector<ExtraColumn> extra = before;
  ExtraColumn& number = extra.emplace_back(ExtraColumn{.name = "point", .cells = {}});
  for (const size_t point : orders.points) number.cells.emplace_back(static_cast<int64_t>(point));
  for (size_t i = 0; i < sweep.parameters.size(); ++i) {
    ExtraColumn& column = extra.emplace_back(ExtraColumn{.name = sweep.parameters[i].path, .cells = {}});
    for (const auto& values : orders.values) column.cells.push_back(value_cell(values.at(i)));
  }
  return flight_table(records, extra);
}

}  // namespace hedgehop::sim
