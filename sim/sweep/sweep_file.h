#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/batch/record.h"
#include "sim/fields/field.h"
#include "sim/sweep/sampling.h"

namespace hedgehop::sim {

/// One parameter of a sweep: a list of values or a range.
struct SweepParameter {
  enum class Scale { linear, log };
  std::string path;
  std::vector<std::string> values;
  std::optional<double> from, to;
  int64_t count = 0;
  Scale scale = Scale::linear;
  bool whole = false;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SweepParameter> auto& c) {
  v("path", c.path, {.required = true, .meaning = "key of the scenario, such as avoidance.flow_gain"});
  v("values", c.values, {.meaning = "values to take, or else a range"});
  v("from", c.from, {.meaning = "lower end of the range, in the key's unit"});
  v("to", c.to, {.meaning = "upper end of the range"});
  v("count", c.count,
    {.at_least = 0, .at_most = 1'000'000, .meaning = "values a grid takes from the range, with both ends"});
  v("scale", c.scale, {.choices = {"linear", "log"}, .meaning = "how the range is divided"});
  v("whole", c.whole, {.meaning = "whether the range's values are rounded to whole numbers"});
}

struct GridDesign {
  static constexpr std::string_view kName = "grid";
  static constexpr std::string_view kMeaning = "every combination of values, the last parameter changing fastest";
};
template <class Visitor>
void describe(Visitor&, const GridDesign&) {}

struct ListDesign {
  static constexpr std::string_view kName = "list";
  static constexpr std::string_view kMeaning = "the first values of all parameters, then the second ones, and so on";
};
template <class Visitor>
void describe(Visitor&, const ListDesign&) {}

struct RandomDesign {
  static constexpr std::string_view kName = "random";
  static constexpr std::string_view kMeaning = "independent even draws";
  int64_t points = 0;
  uint64_t seed = 1;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RandomDesign> auto& c) {
  v("points", c.points, {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "number of points"});
  v("seed", c.seed, {.meaning = "of the draws"});
}

struct LatinHypercubeDesign : RandomDesign {
  static constexpr std::string_view kName = "latin_hypercube";
  static constexpr std::string_view kMeaning = "draws that cover every parameter's range evenly";
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<LatinHypercubeDesign> auto& c) {
  describe(v, fields::base<RandomDesign>(c));
}

struct SobolDesign {
  static constexpr std::string_view kName = "sobol";
  static constexpr std::string_view kMeaning = "Sobol's sequence: covers all parameters together evenly";
  int64_t points = 0;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SobolDesign> auto& c) {
  v("points", c.points,
    {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "number; best a power of 2"});
}

struct OptimizeDesign {
  static constexpr std::string_view kName = "optimize";
  static constexpr std::string_view kMeaning = "looks for the point with the smallest mean of a column over the seeds";
  enum class Method { subplex, nelder_mead, bobyqa, direct };
  std::string minimize;
  Method method = Method::subplex;
  int64_t evaluations = 50;
  double failure_cost = 1e6;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<OptimizeDesign> auto& c) {
  v("minimize", c.minimize, {.required = true, .meaning = "column of the sweep's table, such as flight_time_s"});
  v("method", c.method,
    {.choices = {"subplex", "nelder_mead", "bobyqa", "direct"}, .meaning = "of NLopt; direct searches the whole box"});
  v("evaluations", c.evaluations, {.at_least = 1, .at_most = 100'000, .meaning = "most points to fly"});
  v("failure_cost", c.failure_cost, {.meaning = "what a flight counts that does not pass or lacks the column"});
}

using SweepDesign =
    std::variant<GridDesign, ListDesign, RandomDesign, LatinHypercubeDesign, SobolDesign, OptimizeDesign>;

/// A sweep: one scenario, parameters, a design, the same seeds at every point. Parameters are chosen by it, so its
/// seeds judge nothing: where it states `tuned_on`, they lie within.
struct SweepConfig {
  std::string description;
  std::string scenario;  ///< relative to the sweep's file; once read, to the working folder
  std::optional<std::string> seeds;
  std::optional<std::string> tuned_on;
  std::vector<std::string> set;
  SweepDesign design;
  std::vector<SweepParameter> parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SweepConfig> auto& c) {
  v("description", c.description, {.meaning = "what the sweep is for"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds, {.meaning = "seeds flown at every point, such as 1:10; else the scenario's own"});
  v("tuned_on", c.tuned_on,
    {.meaning = "all seeds that parameters are chosen on, such as 1:100; a sweep's own are among them"});
  v("set", c.set, {.meaning = "overrides of the scenario at every point, each key.path=value"});
  v("design", c.design, {.meaning = "which points of the parameters' ranges are flown"});
  v("parameters", c.parameters, {.required = true, .meaning = "what is varied"});
}

/// Reads a sweep. Throws InputError with every fault: of the file, and of every parameter that the scenario refuses
/// (unknown paths with the nearest key, wrong types, values out of bounds).
SweepConfig read_sweep(const std::filesystem::path& file);

/// What the scenario refuses of each parameter's extreme or listed values, tried alone: one line each.
std::vector<std::string> refused_parameters(const SweepConfig& sweep);

/// The value of a parameter at a coordinate in [0, 1], as YAML.
std::string parameter_value(const SweepParameter& parameter, double coordinate);

/// All points of a design, as values of the parameters in their order. Not for OptimizeDesign, which finds its own.
std::vector<std::vector<std::string>> design_points(const SweepConfig& sweep);

/// Orders of one point, one a seed; ids and groups carry the point's number. Throws InputError when the scenario
/// refuses the point's values together.
std::vector<Order> point_orders(const SweepConfig& sweep, size_t point, const std::vector<std::string>& values);

}  // namespace hedgehop::sim
