#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "sim/config/config_tree.h"
#include "sim/fields/field.h"
#include "sim/fields/invalid_field.h"

namespace hedgehop::avoidance {
class Module;
}

namespace hedgehop::sim {

struct ConfigOutline;

/// A module from a shared library. Its parameters are read by the library's own description, when a flight begins:
/// reading a scenario loads no foreign code.
struct PluginConfig {
  static constexpr std::string_view kName = "plugin";
  static constexpr std::string_view kMeaning = "a module from a shared library (docs/writing-a-module.md)";
  static constexpr std::string_view kChosenBy = kPluginKey;

  std::filesystem::path plugin;
  std::string module;
  double limit_s = 10.0;
  Node parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PluginConfig> auto& c) {
  v("plugin", c.plugin, {.required = true, .meaning = "shared library, relative to this file"});
  v("module", c.module, {.required = true, .meaning = "which of the library's modules"});
  v("limit", c.limit_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "wall time of a call after which the module counts as hung"});
  v("parameters", c.parameters, {.meaning = "the module's own, read as strictly"});
}

/// A module written in Python. Its class checks its own parameters, when a flight begins.
struct PythonConfig {
  static constexpr std::string_view kName = "python";
  static constexpr std::string_view kMeaning = "a module written in Python (docs/python.md)";
  static constexpr std::string_view kChosenBy = kPythonKey;

  std::filesystem::path python;
  std::string class_name;
  Node parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PythonConfig> auto& c) {
  v("python", c.python, {.required = true, .meaning = "source file, relative to this file"});
  v("class", c.class_name, {.required = true, .meaning = "the module's class in it"});
  v("parameters", c.parameters, {.meaning = "keyword arguments of the class"});
}

/// Who decides where to fly: a module of this tree, or one from outside, with its parameters.
class AvoidanceConfig {
 public:
  static constexpr bool kIsSealed = true;
  struct Choice;  ///< the parameters of one module (avoidance_choice.h)

  AvoidanceConfig();               ///< the control: straight to the goal
  AvoidanceConfig(Choice choice);  // NOLINT(google-explicit-constructor): a choice is one
  const Choice& choice() const { return *choice_; }

  /// Under which the module stands in a scenario.
  std::string_view name() const;
  /// A module's whose code lies outside this tree and is loaded when a flight begins; else null.
  const PluginConfig* plugin() const;
  const PythonConfig* python() const;
  bool is_foreign() const { return plugin() || python(); }
  /// Makes a module of this tree; null for a foreign one: reading a scenario loads no foreign code. Throws
  /// std::invalid_argument on a bad config.
  std::unique_ptr<avoidance::Module> make() const;

  // As every sealed field (field_types.h).
  void read(const Node& node, const std::string& path, const fields::Field& field, ErrorList& errors);
  ConfigOutline outlined(const fields::Field& field) const;
  void check_bounds(const std::string& path, std::vector<fields::InvalidField>& errors) const;

 private:
  std::shared_ptr<const Choice> choice_;  ///< never null
};

}  // namespace hedgehop::sim
