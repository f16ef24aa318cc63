#include "sim/sweep/design.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "sim/sweep/sampling.h"

namespace hedgehop::sim {
namespace {

constexpr size_t kTooMany = kMaxSweepPoints + 1;

size_t limited_product(size_t a, size_t b) { return b != 0 && a > kTooMany / b ? kTooMany : std::min(a * b, kTooMany); }

bool is_log(const SweepParameter& p) { return p.scale == SweepParameter::Scale::log; }

double range_value(const SweepParameter& p, double coordinate) {
  if (coordinate == 1.0) return *p.to;  // without pow's rounding
  return is_log(p) ? *p.from * std::pow(*p.to / *p.from, coordinate) : *p.from + coordinate * (*p.to - *p.from);
}

size_t grid_count(const SweepParameter& p) { return p.values.empty() ? static_cast<size_t>(p.count) : p.values.size(); }

std::string grid_value(const SweepParameter& p, size_t index) {
  if (!p.values.empty()) return p.values[index].text;
  return design_value(p, static_cast<double>(index) / static_cast<double>(p.count - 1));
}

/// First point of Sobol's sequence for indices: not the origin, at which A equals B. A multiple of a power of 2 keeps
/// the points a net.
uint32_t first_sobol_point(size_t points) {
  uint32_t first = 1;
  while (first < points) first *= 2;
  return first;
}

}  // namespace

size_t count_points(const SweepConfig& sweep) {
  return std::visit(
      [&]<class Design>(const Design& design) -> size_t {
        if constexpr (std::is_same_v<Design, GridDesign>) {
          size_t count = 1;
          for (const SweepParameter& p : sweep.parameters) count = limited_product(count, grid_count(p));
          return count;
        } else if constexpr (std::is_same_v<Design, ListDesign>) {
          return sweep.parameters[0].values.size();
        } else if constexpr (std::is_same_v<Design, OptimizeDesign>) {
          return static_cast<size_t>(design.evaluations);
        } else if constexpr (std::is_same_v<Design, SobolDesign>) {
          const auto points = static_cast<size_t>(design.points);
          return design.indices ? limited_product(points, sweep.parameters.size() + 2) : points;
        } else {
          return static_cast<size_t>(design.points);
        }
      },
      sweep.design);
}

DesignPoints::DesignPoints(const SweepConfig& sweep) : sweep_(sweep), size_(count_points(sweep)) {
  UnitPoints unit;
  const size_t parameters = sweep.parameters.size();
  if (const auto* random = std::get_if<RandomDesign>(&sweep.design)) {
    unit = random_points(size_, parameters, random->seed);
  } else if (const auto* latin = std::get_if<LatinHypercubeDesign>(&sweep.design)) {
    unit = latin_hypercube(size_, parameters, latin->seed);
  } else if (const auto* sobol = std::get_if<SobolDesign>(&sweep.design); sobol && sobol->indices) {
    block_ = parameters + 2;
  }
  coordinates_.reserve(unit.size() * parameters);
  for (const std::vector<double>& point : unit) coordinates_.insert(coordinates_.end(), point.begin(), point.end());
}

std::vector<std::string> DesignPoints::values(size_t index) const {
  const std::vector<SweepParameter>& parameters = sweep_.parameters;
  std::vector<std::string> values(parameters.size());
  if (std::holds_alternative<ListDesign>(sweep_.design)) {
    for (size_t i = 0; i < values.size(); ++i) values[i] = parameters[i].values[index].text;
  } else if (std::holds_alternative<GridDesign>(sweep_.design)) {
    for (size_t i = values.size(); i-- > 0;) {
      const size_t count = grid_count(parameters[i]);
      values[i] = grid_value(parameters[i], index % count);
      index /= count;
    }
  } else if (const auto* sobol = std::get_if<SobolDesign>(&sweep_.design)) {
    // [Saltelli2010] sec. 4: each point of a sequence of twice the dimension is one row of A and one row of B.
    const size_t block = block_ == 0 ? 1 : block_, part = index % block;
    const uint32_t first = block_ == 0 ? 0 : first_sobol_point(static_cast<size_t>(sobol->points));
    const std::vector<double> row =
        sobol_point(first + static_cast<uint32_t>(index / block), values.size() * (block_ == 0 ? 1 : 2));
    for (size_t i = 0; i < values.size(); ++i) {
      const bool of_b = part == 1 || part == i + 2;
      values[i] = design_value(parameters[i], row[i + (of_b ? values.size() : 0)]);
    }
  } else {
    for (size_t i = 0; i < values.size(); ++i) {
      values[i] = design_value(parameters[i], coordinates_[index * values.size() + i]);
    }
  }
  return values;
}

std::string design_value(const SweepParameter& p, double coordinate) {
  if (!p.values.empty() || p.whole) return parameter_value(p, coordinate);
  const double exact = range_value(p, coordinate);
  const std::string text = is_log(p) ? fmt::format("{:.6g}", exact) : fmt::format("{:.12g}", exact);
  const double rounded = std::clamp(std::strtod(text.c_str(), nullptr), *p.from, *p.to);
  return fmt::format("{}", rounded == 0.0 ? 0.0 : rounded);
}

std::vector<std::string> rounding_notices(const SweepConfig& sweep) {
  std::vector<std::string> notices;
  if (!std::holds_alternative<GridDesign>(sweep.design)) return notices;
  for (const SweepParameter& p : sweep.parameters) {
    if (!p.values.empty() || !p.whole) continue;
    constexpr size_t kExamples = 3;
    std::vector<std::string> examples;
    size_t rounded = 0;
    for (int64_t i = 0; i < p.count; ++i) {
      const double exact = range_value(p, static_cast<double>(i) / static_cast<double>(p.count - 1));
      if (std::abs(exact - std::round(exact)) < 1e-9 * std::max(1.0, std::abs(exact))) continue;
      if (++rounded <= kExamples) examples.push_back(fmt::format("{:.6g} to {:.0f}", exact, std::round(exact)));
    }
    if (rounded == 0) continue;
    if (rounded > kExamples) examples.emplace_back("...");
    notices.push_back(fmt::format("{}: '{}': {} of {} values are rounded to another value: {}", p.position.text(),
                                  p.path, rounded, p.count, fmt::join(examples, ", ")));
  }
  return notices;
}

}  // namespace hedgehop::sim
