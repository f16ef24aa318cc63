#include "sim/reproduce/calculations.h"

#include <algorithm>

#include "sim/reproduce/centering_runs.h"
#include "sim/reproduce/section_costs.h"

namespace hedgehop::sim {

const std::vector<Calculation>& calculations() {
  static const std::vector<Calculation> all{
      {.name = "centering_exact",
       .meaning = "a point mass centres itself in a corridor by the printed law, signal exact",
       .columns = {"x_m", "off_middle_m", "settled_m"},
       .calculate = centering_exact},
      {.name = "centering_noisy",
       .meaning = "the same with the deviations that the paper measured",
       .columns = {"x_m", "off_middle_m", "settled_m"},
       .calculate = centering_noisy},
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
