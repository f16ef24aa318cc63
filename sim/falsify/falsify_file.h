#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/fields/field.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/sweep_file.h"

/// Searches for failing flights.
namespace hedgehop::sim {

/// One unknown of a search.
struct FalsifyParameter {
  std::string path;
  double from = 0.0, to = 0.0;
  SweepParameter::Scale scale = SweepParameter::Scale::linear;
  bool whole = false;
  std::optional<double> neutral;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyParameter> auto& c) {
  v("path", c.path, {.required = true, .meaning = "key of the scenario, such as wind.speed or failures.0.at"});
  v("from", c.from, {.required = true, .meaning = "lower end of the range, in the key's unit"});
  v("to", c.to, {.required = true, .meaning = "upper end of the range"});
  v("scale", c.scale, {.choices = {"linear", "log"}, .meaning = "scale on which the range is searched"});
  v("whole", c.whole, {.meaning = "whether values are rounded to whole numbers"});
  v("neutral", c.neutral, {.meaning = "value without any disturbance; failures are shrunk towards it"});
}

/// Boxes placed by the search, whose positions and sizes are further unknowns. The ends of a range may be equal.
struct FalsifyBoxes {
  int64_t count = 1;
  Eigen::Vector2d north_m = {0.0, 0.0}, east_m = {0.0, 0.0};
  Eigen::Vector2d length_m = {10.0, 10.0}, width_m = {5.0, 5.0}, height_m = {20.0, 20.0};
  Eigen::Vector2d heading_deg = {0.0, 0.0};
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyBoxes> auto& c) {
  v("count", c.count,
    {.at_least = 1, .at_most = 20, .required = true, .meaning = "number of boxes; shrinking may remove some"});
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "range of the centers"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "range of the centers"});
  v("length", c.length_m, {.unit = "m", .above = 0.0, .meaning = "range of the size along the heading"});
  v("width", c.width_m, {.unit = "m", .above = 0.0, .meaning = "range of the size across the heading"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "range of the height"});
  v("heading", c.heading_deg,
    {.at_least = -360.0, .at_most = 360.0, .meaning = "range of the heading, degrees from north to east"});
}

/// A constraint on points. A point that violates one is not flown and costs no flight.
enum class FalsifyConstraint { boxes_inside, boxes_apart, way_exists, box_on_route };

/// The objective that a search minimizes.
enum class FalsifyScore {
  robustness,  ///< the robustness of the weakest check
  sbft         ///< the negative score of the UAV testing competition (competition_score.h)
};

struct FalsifyDesign {
  enum class Method { cma_es, direct, random };
  Method method = Method::cma_es;
  int64_t budget = 0;
  uint64_t seed = 1;
  int64_t failures = 1;
  int64_t shrinking = 60;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyDesign> auto& c) {
  v("method", c.method,
    {.choices = {"cma_es", "direct", "random"},
     .meaning = "evolution strategy, started from the best random points; DIRECT_L of NLopt, for up to 5 unknowns; "
                "random points only, as a baseline"});
  v("budget", c.budget,
    {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "maximum number of flights of the search"});
  v("seed", c.seed, {.meaning = "seed of the search; equal seeds give equal searches"});
  v("failures", c.failures,
    {.at_least = 1, .at_most = 100, .meaning = "number of distinct failures after which the search stops"});
  v("shrinking", c.shrinking,
    {.at_least = 0, .at_most = 10'000, .meaning = "maximum number of further flights that shrink a failure"});
}

/// A search for flights that fail: one scenario, unknowns with bounds, a budget.
struct FalsifyConfig {
  std::string description;
  std::string scenario;  ///< relative to the file; once read, to the working folder
  std::optional<std::string> seeds;
  std::vector<std::string> set;
  FalsifyScore score = FalsifyScore::robustness;
  std::vector<std::string> robustness;
  FalsifyDesign design;
  std::optional<FalsifyBoxes> boxes;
  std::vector<FalsifyConstraint> constraints;
  std::vector<FalsifyParameter> parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyConfig> auto& c) {
  v("description", c.description, {.meaning = "purpose of the search"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds,
    {.meaning = "seeds flown at every point, of which the one with the minimum robustness counts; default: the "
                "scenario's seed"});
  v("set", c.set, {.meaning = "overrides of the scenario at every point, each key.path=value"});
  v("score", c.score,
    {.choices = {"robustness", "sbft"},
     .meaning = "objective: the robustness of the checks, or the score of the SBFT UAV testing competition 2025, with "
                "five runs of each failing test"});
  v("robustness", c.robustness, {.meaning = "names of the checks to violate; default: all checks of the scenario"});
  v("design", c.design, {.required = true, .meaning = "method and budget of the search"});
  v("boxes", c.boxes, {.meaning = "boxes to place in the scene"});
  v("constraints", c.constraints,
    {.choices = {"boxes_inside", "boxes_apart", "way_exists", "box_on_route"},
     .meaning = "corners within the range of the centers; no two boxes overlap; a path past the boxes to the goal; the "
                "straight route leads through a box"});
  v("parameters", c.parameters, {.meaning = "further unknowns"});
}

/// A search as read from its file: the scenario before the unknowns are set, and the unknowns as a sweep.
struct FalsifySearch {
  FalsifyConfig config;
  Scenario scenario;
  SweepConfig sweep;                           ///< scenario, seeds, overrides, parameters
  std::vector<std::optional<double>> neutral;  ///< one per parameter of the sweep
  std::string identity;                        ///< differs if the file, an override or the scenario differs
};

/// Reads a search. Throws InputError with every fault, like read_sweep().
/// @param overrides  overrides of the search file, each key.path=value.
FalsifySearch read_falsify(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Returns the path of a number of a box, such as "scene.boxes.0.north". @param box  from 0.
std::string box_path(size_t box, std::string_view key);

}  // namespace hedgehop::sim
