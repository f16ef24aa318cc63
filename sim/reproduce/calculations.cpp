#include "sim/reproduce/calculations.h"

#include <algorithm>

#include "sim/reproduce/landmark_flights.h"

namespace hedgehop::sim {

const std::vector<Calculation>& calculations() {
  static const std::vector<Calculation> all{
      {.name = "centering_exact",
       .meaning = "point mass centered in a corridor by the published law, exact signal",
       .columns = {"x_m", "off_middle_m", "settled_m"},
       .calculate = centering_exact},
      {.name = "centering_noisy",
       .meaning = "the same with the signal errors that the paper measured",
       .columns = {"x_m", "off_middle_m", "settled_m"},
       .calculate = centering_noisy},
      {.name = "section_costs",
       .meaning = "time to choose among sections of a depth map, by number of sections",
       .columns = {"sections", "decisions_hz", "cost_over_3x3", "cost_ms"},
       .calculate = section_costs},
      {.name = "landmark_costs",
       .meaning = "filter time per image, by number of landmarks",
       .columns = {"landmarks", "image_ms", "speed", "growth_8_to_35"},
       .calculate = landmark_costs},
      {.name = "cube_lateral_errors",
       .meaning = "error of the map of a cube's projected corners, circling",
       .columns = landmark_error_columns(),
       .calculate = cube_lateral_errors},
      {.name = "highrise_lateral_errors",
       .meaning = "error of the map of 35 projected corners, circling",
       .columns = landmark_error_columns(),
       .calculate = highrise_lateral_errors},
      {.name = "highrise_forward_errors",
       .meaning = "error of the map of 35 projected corners, flying toward them",
       .columns = landmark_error_columns(),
       .calculate = highrise_forward_errors},
      {.name = "cube_lateral_map",
       .meaning = "map of a cube's projected corners, circling",
       .columns = landmark_map_columns(),
       .calculate = cube_lateral_map},
      {.name = "highrise_lateral_map",
       .meaning = "map of 35 projected corners, circling",
       .columns = landmark_map_columns(),
       .calculate = highrise_lateral_map},
      {.name = "highrise_forward_map",
       .meaning = "map of 35 projected corners, flying toward them",
       .columns = landmark_map_columns(),
       .calculate = highrise_forward_map},
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
