#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/config/tree.h"
#include "sim/fields/field.h"

namespace hedgehop::sim {

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
void describe(Visitor& v, PluginConfig& c) {
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
void describe(Visitor& v, PythonConfig& c) {
  v("python", c.python, {.required = true, .meaning = "source file, relative to this file"});
  v("class", c.class_name, {.required = true, .meaning = "the module's class in it"});
  v("parameters", c.parameters, {.meaning = "keyword arguments of the class"});
}

}  // namespace hedgehop::sim
