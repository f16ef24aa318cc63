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

/// The keys of a module's process, of PluginConfig and PythonConfig.
template <class Visitor, class Config>
void describe_process(Visitor& v, Config& c) {
  v("limit", c.limit_s,
    {.unit = "s",
     .above = 0.0,
     .at_most = 3600.0,
     .meaning = "maximum wall time of a call; a slower module counts as hung"});
  v("in_process", c.in_process, {.meaning = "whether it runs in the simulator's process, without protection"});
}

/// A module from a shared library. The library's own description reads its parameters at the start of a flight, because
/// reading a scenario loads no foreign code.
struct PluginConfig {
  static constexpr std::string_view kName = "plugin";
  static constexpr std::string_view kMeaning = "a module from a shared library (docs/writing-a-module.md)";
  static constexpr std::string_view kChosenBy = kPluginKey;

  std::filesystem::path plugin;
  std::string module;
  double limit_s = 10.0;
  bool in_process = false;
  Node parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PluginConfig> auto& c) {
  v("plugin", c.plugin, {.required = true, .meaning = "shared library, relative to this file"});
  v("module", c.module, {.required = true, .meaning = "module of the library"});
  describe_process(v, c);
  v("parameters", c.parameters, {.meaning = "the module's own parameters"});
}

/// A module in Python. Its class checks its own parameters at the start of a flight.
struct PythonConfig {
  static constexpr std::string_view kName = "python";
  static constexpr std::string_view kMeaning = "a module written in Python (docs/python.md)";
  static constexpr std::string_view kChosenBy = kPythonKey;

  std::filesystem::path python;
  std::string class_name;
  double limit_s = 10.0;
  bool in_process = false;
  Node parameters;
};
template <class Visitor>
void describe(Visitor& v, fields::ConfigOf<PythonConfig> auto& c) {
  v("python", c.python, {.required = true, .meaning = "source file, relative to this file"});
  v("class", c.class_name, {.required = true, .meaning = "class of the module"});
  describe_process(v, c);
  v("parameters", c.parameters, {.meaning = "keyword arguments of the class"});
}

/// The avoidance module with its parameters: a module of this tree or a foreign module.
class AvoidanceConfig {
 public:
  static constexpr bool kIsSealed = true;
  struct Choice;  ///< the parameters of one module (avoidance_choice.h)

  AvoidanceConfig();               ///< the control: straight to the goal
  AvoidanceConfig(Choice choice);  // implicit, because a choice is a configuration
  const Choice& choice() const { return *choice_; }

  /// Returns the name of the module in scenarios.
  std::string_view name() const;
  /// The config of a foreign module, which is loaded at the start of a flight; else null.
  const PluginConfig* plugin() const;
  const PythonConfig* python() const;
  bool is_foreign() const { return plugin() || python(); }
  /// Returns a module of this tree; null for a foreign module, because reading a scenario loads no foreign code. Throws
  /// std::invalid_argument on an invalid config.
  std::unique_ptr<avoidance::Module> make() const;

  // As every sealed field (field_types.h).
  void read(const Node& node, const std::string& path, const fields::Field& field, ErrorList& errors);
  ConfigOutline outlined(const fields::Field& field) const;
  void check_bounds(const std::string& path, std::vector<fields::InvalidField>& errors) const;

 private:
  std::shared_ptr<const Choice> choice_;  ///< never null
};

}  // namespace hedgehop::sim
