// The plan of a corridor: its random variation and the edges of its floor.
#include <algorithm>
#include <cmath>

#include "scenes/world_config.h"
#include "scenes/worlds/corridor.h"
#include "sim/fields/bounds.h"
#include "sim/libm/random.h"

namespace hedgehop::scenes::worlds {
namespace {

using Eigen::Vector2d;

constexpr uint64_t kCorridorPlanStream = 2;  // of the scene's seed; corridor.cpp has the others

Vector2d direction_NE(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

// Start of the last section, heading of the previous one, and length up to there.
struct LastSectionStart {
  Vector2d end_NE = Vector2d::Zero();
  double heading_rad = 0.0, length_m = 0.0;
};

LastSectionStart last_section_start(const std::vector<CorridorSection>& sections) {
  LastSectionStart all;
  for (size_t k = 0; k + 1 < sections.size(); ++k) {
    all.heading_rad += sections[k].bend_rad;
    all.end_NE += sections[k].length_m * direction_NE(all.heading_rad);
    all.length_m += sections[k].length_m;
  }
  return all;
}

// Throws if any seed could make the corridor impossible.
void validate(const CorridorConfig& c) {
  fields::require_bounds(c);
  require(c.door_height_m <= c.height_m, "door_height", c.door_height_m, "at most the height");
  require(!c.sections.empty(), "sections", 0.0, "at least one");
  const auto min_width_m = [&](double width_m) { return width_m - c.vary * std::abs(width_m - c.width_m); };
  const double smallest = 1.0 - c.vary, largest = 1.0 + c.vary;
  const double shortest = smallest * smallest / largest;  // after keep_last_section()
  double width_m = c.width_m;
  for (const CorridorSection& s : c.sections) {
    require(shortest * s.length_m >= 1.0, "sections.length", s.length_m, "at least 1 m, including variation");
    const double end_m = s.width_m > 0.0 ? min_width_m(s.width_m) : width_m;
    require(end_m >= 0.5, "sections.width", end_m, "0, or at least 0.5 m including variation");
    const double middle_width_m = 0.5 * (width_m + end_m);
    require(s.doorway_m == 0.0 || (smallest * s.doorway_m >= 0.3 && largest * s.doorway_m < middle_width_m),
            "sections.doorway", s.doorway_m, "0, or 0.3 m to the corridor's width, including variation");
    require(largest * std::abs(s.obstacle_m) < middle_width_m, "sections.obstacle", s.obstacle_m,
            "less than the corridor's width, including variation");
    width_m = end_m;
  }
  const LastSectionStart written = last_section_start(c.sections);
  require(c.vary == 0.0 || written.end_NE.norm() >= 0.5 * written.length_m, "vary", c.vary,
          "0 if the corridor turns back");
  require_texture_size(c.texture_size_px);
}

// Rotates and scales all sections except the last, so that the last one keeps its configured start and heading.
void keep_last_section(const std::vector<CorridorSection>& written, std::vector<CorridorSection>& drawn) {
  const LastSectionStart from = last_section_start(drawn), to = last_section_start(written);
  const double turn_rad = std::atan2(to.end_NE.y(), to.end_NE.x()) - std::atan2(from.end_NE.y(), from.end_NE.x());
  const double scale = to.end_NE.norm() / from.end_NE.norm();
  for (size_t k = 0; k + 1 < drawn.size(); ++k) drawn[k].length_m *= scale;
  drawn.front().bend_rad += turn_rad;
  drawn.back().bend_rad = to.heading_rad + written.back().bend_rad - (from.heading_rad + turn_rad);
}

}  // namespace

CorridorConfig draw_corridor(const CorridorConfig& config, uint64_t seed) {
  validate(config);
  CorridorConfig drawn = config;
  drawn.vary = 0.0;
  if (config.vary == 0.0) return drawn;

  Random random(derived_seed(seed, kCorridorPlanStream));
  const auto factor = [&] { return uniform(random, 1.0 - config.vary, 1.0 + config.vary); };
  for (CorridorSection& section : drawn.sections) {
    section.length_m *= factor();
    section.bend_rad *= factor();
    if (section.width_m > 0.0) section.width_m = config.width_m + factor() * (section.width_m - config.width_m);
    section.doorway_m *= factor();
    section.obstacle_m *= factor();
  }
  CorridorSection& last = drawn.sections.back();
  const CorridorSection& written = config.sections.back();
  last.length_m = written.length_m * uniform(random, 1.0, 1.0 + config.vary);
  if (drawn.sections.size() > 1) {
    keep_last_section(config.sections, drawn.sections);
  } else {
    last.bend_rad = written.bend_rad;
  }
  return drawn;
}

CorridorPlan plan_corridor(const CorridorConfig& written, uint64_t seed) {
  const CorridorConfig config = draw_corridor(written, seed);
  CorridorPlan plan;
  const auto add_edges = [&](const Vector2d& middle, const Vector2d& before, const Vector2d& after, double width_m) {
    // Across the bend, with the length at which both sections have the width `width_m`.
    const Vector2d across = (to_the_right(before) + to_the_right(after)).normalized();
    const Vector2d half = 0.5 * width_m / across.dot(to_the_right(after)) * across;
    plan.middles_NE.push_back(middle);
    plan.lefts_NE.push_back(middle - half);
    plan.rights_NE.push_back(middle + half);
  };
  Vector2d middle = Vector2d::Zero(), along = Vector2d::UnitX();
  double heading_rad = 0.0, width_m = config.width_m;
  for (const CorridorSection& section : config.sections) {
    heading_rad += section.bend_rad;
    const Vector2d next = direction_NE(heading_rad);
    add_edges(middle, plan.middles_NE.empty() ? next : along, next, width_m);
    along = next;
    middle += section.length_m * along;
    if (section.width_m > 0.0) width_m = section.width_m;
  }
  add_edges(middle, along, along, width_m);
  return plan;
}

}  // namespace hedgehop::scenes::worlds
