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

/// Searches for flights that fail.
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
  v("scale", c.scale, {.choices = {"linear", "log"}, .meaning = "how the range is searched"});
  v("whole", c.whole, {.meaning = "whether values are rounded to whole numbers"});
  v("neutral", c.neutral, {.meaning = "value that disturbs nothing; a failure is shrunk towards it"});
}

/// Boxes to be placed in an open field: unknowns of their own. Both ends of a range may be equal.
struct FalsifyBoxes {
  int64_t count = 1;
  Eigen::Vector2d north_m = {0.0, 0.0}, east_m = {0.0, 0.0};
  Eigen::Vector2d length_m = {10.0, 10.0}, width_m = {5.0, 5.0}, height_m = {20.0, 20.0};
  Eigen::Vector2d heading_deg = {0.0, 0.0};
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyBoxes> auto& c) {
  v("count", c.count,
    {.at_least = 1, .at_most = 20, .required = true, .meaning = "how many; a failure is shrunk to fewer"});
  v("north", c.north_m, {.unit = "m", .required = true, .meaning = "range of their middles"});
  v("east", c.east_m, {.unit = "m", .required = true, .meaning = "range of their middles"});
  v("length", c.length_m, {.unit = "m", .above = 0.0, .meaning = "range along their headings"});
  v("width", c.width_m, {.unit = "m", .above = 0.0, .meaning = "range across"});
  v("height", c.height_m, {.unit = "m", .above = 0.0, .meaning = "range"});
  v("heading", c.heading_deg, {.at_least = -360.0, .at_most = 360.0, .meaning = "range, degrees from north to east"});
}

/// What a point must keep to be flown; one that does not costs no flight.
enum class FalsifyConstraint { boxes_inside, boxes_apart, way_exists };

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
     .meaning = "evolution strategy from the best of some random points; DIRECT_L of NLopt, for up to 5 unknowns; "
                "random points alone, to compare with"});
  v("budget", c.budget,
    {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "most flights of the search"});
  v("seed", c.seed, {.meaning = "of the search; equal ones search alike"});
  v("failures", c.failures,
    {.at_least = 1, .at_most = 100, .meaning = "distinct failures to find; the search stops with the last of them"});
  v("shrinking", c.shrinking,
    {.at_least = 0, .at_most = 10'000, .meaning = "most further flights to shrink a failure"});
}

/// A search for flights that fail: one scenario, unknowns with bounds, a budget.
struct FalsifyConfig {
  std::string description;
  std::string scenario;  ///< relative to the file; once read, to the working folder
  std::optional<std::string> seeds;
  std::vector<std::string> set;
  std::vector<std::string> robustness;
  FalsifyDesign design;
  std::optional<FalsifyBoxes> boxes;
  std::vector<FalsifyConstraint> constraints;
  std::vector<FalsifyParameter> parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<FalsifyConfig> auto& c) {
  v("description", c.description, {.meaning = "what the search is for"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds,
    {.meaning = "seeds flown at every point, the least robust of which counts; else the scenario's own"});
  v("set", c.set, {.meaning = "overrides of the scenario at every point, each key.path=value"});
  v("robustness", c.robustness, {.meaning = "names of the checks to break; all that the scenario has when not given"});
  v("design", c.design, {.required = true, .meaning = "how to search, and how long"});
  v("boxes", c.boxes, {.meaning = "boxes to place in the scene"});
  v("constraints", c.constraints,
    {.choices = {"boxes_inside", "boxes_apart", "way_exists"},
     .meaning = "corners within the middles' range; no two overlap; a way leads past the boxes to the goal"});
  v("parameters", c.parameters, {.meaning = "further unknowns"});
}

/// A search that was read: the scenario as it is before the unknowns are set, and the unknowns as a sweep has them.
struct FalsifySearch {
  FalsifyConfig config;
  Scenario scenario;
  SweepConfig sweep;                           ///< scenario, seeds, overrides, parameters
  std::vector<std::optional<double>> neutral;  ///< of each parameter of the sweep
  std::string identity;                        ///< differs where the file, an override or the scenario does
};

/// Reads a search. Throws InputError with every fault, as read_sweep() does.
/// @param overrides  of the search file, each key.path=value.
FalsifySearch read_falsify(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Path of a number of the k-th box: "scene.boxes.0.north".
std::string box_path(size_t box, std::string_view key);

}  // namespace hedgehop::sim
