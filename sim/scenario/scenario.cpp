#include "sim/scenario/scenario.h"

#include <cmath>
#include <random>

#include "sim/scenario/parse.h"
#include "sim/scenario/reader.h"
#include "sim/scenario/schema.h"
#include "sim/scenario/validate.h"
#include "sim/scenario/writer.h"

namespace hedgehop::sim {

Eigen::Vector3d StartConfig::draw_p_WB(uint64_t seed) const {
  std::mt19937_64 generator(seed);
  const auto draw = [&] {  // evenly from [-1, 1), of 53 random bits
    return std::ldexp(static_cast<double>(generator() >> 11), -52) - 1.0;
  };
  Eigen::Vector2d in_disc;
  do {
    in_disc.x() = draw();
    in_disc.y() = draw();
  } while (in_disc.squaredNorm() > 1.0);
  return p_WB() + spread_m * Eigen::Vector3d(in_disc.x(), in_disc.y(), 0.0);
}

Scenario load_scenario(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Faults faults;
  Node root = load_tree(file, faults);
  if (root.kind != Node::Kind::map) faults.raise();
  apply_overrides(root, overrides, file, faults);

  Scenario scenario;
  read_struct(root, "", "", scenario, faults);
  faults.raise();
  for (CheckConfig& check : scenario.checks) {
    if (auto* path = std::get_if<PathToleranceCheck>(&check)) {
      path->reference = std::filesystem::absolute(file.parent_path() / path->reference).lexically_normal().string();
    }
  }
  validate(scenario, root, faults);
  faults.raise();
  return scenario;
}

dynamics::VehicleConfig load_vehicle(const std::filesystem::path& file) {
  Faults faults;
  const Node root = load_tree(file, faults);
  if (root.kind != Node::Kind::map) faults.raise();
  dynamics::VehicleConfig vehicle;
  read_value(root, "", {.meaning = "a vehicle"}, vehicle, faults);
  faults.raise();
  return vehicle;
}

std::string to_yaml(const Scenario& scenario) { return yaml_text(outline_fields(scenario)); }

std::string json_schema() { return schema_text(outline_fields(Scenario{}), "Hedgehop scenario"); }

}  // namespace hedgehop::sim
