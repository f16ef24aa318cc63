#include "sim/reproduce/calculations.h"

#include <algorithm>

#include "sim/reproduce/section_costs.h"

namespace hedgehop::sim {

const std::vector<Calculation>& calculations() {
  static const std::vector<Calculation> all{
      {.name = "section_costs",
       .meaning = "choosing among sections of a depth map, by their number",
       .columns = {"sections", "decisions_hz", "cost_over_3x3", "cost_ms"},
       .calculate = section_costs},
  };
  return all;
}

const Calculation* find_calculation(std::string_view name) {
  const auto found = std::ranges::find(calculations(), name, &Calculation::name);
  return found == calculations().end() ? nullptr : &*found;
}

std::vector<std::string_view> calculation_names() {
  std::vector<std::string_view> names;
  for (const Calculation& calculation : calculations()) names.push_back(calculation.name);
  return names;
}

}  // namespace hedgehop::sim
