#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/fields/field.h"

namespace hedgehop::sim {

struct ConfigOutline;
struct Node;

/// Maximum number of points of a sweep.
inline constexpr size_t kMaxSweepPoints = 1'000'000;

/// One value of a list: any YAML value, also a map or null.
struct SweepValue {
  static constexpr bool kIsSealed = true;

  std::string text;         ///< as YAML on one line, as it follows "--set key="
  SourcePosition position;  ///< in the sweep's file

  // As every sealed field (field_types.h).
  void read(const Node& node, const std::string& path, const fields::Field& field, ErrorList& errors);
  ConfigOutline outlined(const fields::Field& field) const;
};

/// One parameter of a sweep: a list of values or a range.
struct SweepParameter {
  enum class Scale { linear, log };
  std::string path;
  std::vector<SweepValue> values;
  std::optional<double> from, to;
  int64_t count = 0;
  Scale scale = Scale::linear;
  bool whole = false;
  SourcePosition position = {};  ///< in the sweep's file; empty if it has no file
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SweepParameter> auto& c) {
  v("path", c.path, {.required = true, .meaning = "key of the scenario, such as avoidance.flow_gain"});
  v("values", c.values, {.meaning = "list of values of any kind, also maps and null; alternative to a range"});
  v("from", c.from, {.meaning = "lower end of the range, in the key's unit"});
  v("to", c.to, {.meaning = "upper end of the range"});
  v("count", c.count,
    {.at_least = 0, .at_most = 1'000'000, .meaning = "number of values of a grid over the range, including both ends"});
  v("scale", c.scale, {.choices = {"linear", "log"}, .meaning = "scale on which the range is divided"});
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
  static constexpr std::string_view kMeaning = "independent uniform draws";
  int64_t points = 0;
  uint64_t seed = 1;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<RandomDesign> auto& c) {
  v("points", c.points, {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "number of points"});
  v("seed", c.seed, {.meaning = "seed of the draws"});
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
  bool indices = false;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SobolDesign> auto& c) {
  v("points", c.points,
    {.at_least = 1, .at_most = 1'000'000, .required = true, .meaning = "number of points; preferably a power of 2"});
  v("indices", c.indices,
    {.meaning = "whether the points are arranged for Sobol indices, which takes points x (parameters + 2) points"});
}

struct OptimizeDesign {
  static constexpr std::string_view kName = "optimize";
  static constexpr std::string_view kMeaning =
      "searches for the point with the minimum mean of a column over the seeds";
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
    {.choices = {"subplex", "nelder_mead", "bobyqa", "direct"},
     .meaning = "algorithm of NLopt; direct searches the whole box"});
  v("evaluations", c.evaluations, {.at_least = 1, .at_most = 100'000, .meaning = "maximum number of points to fly"});
  v("failure_cost", c.failure_cost, {.meaning = "cost of a flight that fails or lacks the column"});
}

using SweepDesign =
    std::variant<GridDesign, ListDesign, RandomDesign, LatinHypercubeDesign, SobolDesign, OptimizeDesign>;

/// A sweep: one scenario, parameters, a design, and the same seeds at every point. Because parameters are chosen with
/// these seeds, the seeds must not be used for evaluation. If `tuned_on` is given, it must contain them.
struct SweepConfig {
  std::string description;
  std::string scenario;  ///< relative to the sweep's file; once read, to the working folder
  std::optional<std::string> seeds;
  std::optional<std::string> tuned_on;
  std::vector<std::string> set;
  SweepDesign design;
  std::vector<SweepParameter> parameters;
  std::filesystem::path file = {};            ///< that it was read from
  SourcePosition design_position = {};        ///< of the design in this file
  std::vector<SourcePosition> set_positions;  ///< of the items of `set` in this file; may have fewer
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<SweepConfig> auto& c) {
  v("description", c.description, {.meaning = "purpose of the sweep"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file, relative to this file"});
  v("seeds", c.seeds, {.meaning = "seeds flown at every point, such as 1:10; default: the scenario's seed"});
  v("tuned_on", c.tuned_on,
    {.meaning = "all seeds on which parameters are chosen, such as 1:100; must contain the seeds of the sweep"});
  v("set", c.set, {.meaning = "overrides of the scenario at every point, each key.path=value"});
  v("design", c.design, {.meaning = "choice of the points in the parameters' ranges"});
  v("parameters", c.parameters, {.required = true, .meaning = "varied parameters"});
}

/// Reads a sweep. Throws InputError with every fault of the file and of its parameters: unknown paths with the nearest
/// key, wrong types, values out of bounds, too many points, unknown columns. Each fault names the line of the file.
/// @param overrides  "a.b=value", of the scenario at every point, after those of the file.
SweepConfig read_sweep(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// Returns the faults of each parameter's extreme or listed values, each tried alone; one line per fault, with the
/// position of the value.
std::vector<std::string> refused_parameters(const SweepConfig& sweep);

/// Returns a fault of an override with the position of the parameter instead of "--set key".
std::string at_parameter(const SweepConfig& sweep, const std::string& fault);

/// Returns the value of a parameter at a coordinate in [0, 1], as YAML.
std::string parameter_value(const SweepParameter& parameter, double coordinate);

}  // namespace hedgehop::sim
