#include "sim/plugin/foreign_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "avoidance/plugin.h"
#include "sim/config/input_error.h"
#include "sim/config/reader.h"
#include "sim/plugin/module_process.h"

namespace hedgehop::sim {
namespace {

using avoidance::ParameterField;

/// Reads a plugin's parameters as strictly as those of this tree's modules.
class ParameterReader : public avoidance::ParameterVisitor {
 public:
  ParameterReader(const Node& map, ErrorList& errors) : reader_(map, "avoidance.parameters", "", errors) {}

  void number(std::string_view key, double& value, const ParameterField& field) override {
    reader_(key, value, to_field(field));
  }
  void integer(std::string_view key, int64_t& value, const ParameterField& field) override {
    reader_(key, value, to_field(field));
  }
  void boolean(std::string_view key, bool& value, const ParameterField& field) override {
    reader_(key, value, to_field(field));
  }
  void text(std::string_view key, std::string& value, const ParameterField& field) override {
    reader_(key, value, to_field(field));
  }
  void choice(std::string_view key, int64_t& index, const ParameterField& field) override {
    enum class Choice : int64_t {};
    auto chosen = static_cast<Choice>(index);
    reader_(key, chosen, to_field(field));
    index = static_cast<int64_t>(chosen);
  }
  void numbers(std::string_view key, std::vector<double>& values, const ParameterField& field) override {
    reader_(key, values, to_field(field));
  }
  void finish() const { reader_.finish(); }

 private:
  static fields::Field to_field(const ParameterField& field) {
    return {.unit = field.unit,
            .above = field.above,
            .at_least = field.at_least,
            .below = field.below,
            .at_most = field.at_most,
            .choices = field.choices,
            .required = field.required,
            .meaning = field.meaning};
  }
  StructReader reader_;
};

[[noreturn]] void refuse(const PluginConfig& config, const std::string& why) {
  throw InputError(FieldError{"avoidance.plugin", fmt::format("{}: {}", config.plugin.string(), why)});
}

/// A function that the library exports, or null.
template <class Function>
Function* find_function(void* library, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(library, name));
}

avoidance::PluginRows load_rows(const PluginConfig& config) {
  std::error_code error;
  if (!std::filesystem::exists(config.plugin, error)) refuse(config, "no such file");
  if (!std::filesystem::is_regular_file(config.plugin, error)) refuse(config, "is not a regular file");
  void* const library =
      ::dlopen(config.plugin.c_str(), RTLD_NOW | RTLD_LOCAL);  // never unloaded: its code may be in use
  if (!library) refuse(config, fmt::format("cannot be loaded: {}", ::dlerror()));
  auto* const interface = find_function<const char*()>(library, "hedgehop_plugin_interface");
  auto* const add_rows = find_function<void(avoidance::PluginRows&)>(library, "hedgehop_plugin_rows");
  if (!interface || !add_rows) refuse(config, "is not a module library: it lacks HEDGEHOP_PLUGIN(...)");
  if (const std::string_view theirs = interface(); theirs != HEDGEHOP_PLUGIN_INTERFACE) {
    refuse(config, fmt::format("was built against another interface ({}); this program has: {}. Build it again", theirs,
                               HEDGEHOP_PLUGIN_INTERFACE));
  }
  avoidance::PluginRows rows;
  add_rows(rows);
  return rows;
}

std::unique_ptr<avoidance::Module> load_module(const PluginConfig& config) {
  const avoidance::PluginRows rows = load_rows(config);
  std::vector<std::string_view> names;
  for (const auto& row : rows) names.push_back(row->name());
  const auto row = std::ranges::find(names, config.module);
  if (row == names.end()) {
    refuse(config, fmt::format("has no module '{}'{}", config.module, suggestion(config.module, names)));
  }
  ErrorList errors("scenario");
  ParameterReader parameters(config.parameters, errors);
  std::unique_ptr<avoidance::Module> module;
  try {
    module = rows[static_cast<size_t>(row - names.begin())]->make(parameters);
  } catch (const InputError&) {
    throw;
  } catch (const std::logic_error& bad) {
    refuse(config, bad.what());
  }
  parameters.finish();
  errors.throw_if_any();
  return module;
}

std::unique_ptr<avoidance::Module> make_plugin_module(const PluginConfig& config, const std::filesystem::path& folder) {
  if (config.in_process) {
    try {
      return load_module(config);
    } catch (const InputError&) {
      throw;
    } catch (const std::exception& failure) {
      refuse(config, failure.what());
    }
  }
  PluginConfig whole = config;  // its process works in another folder
  whole.plugin = std::filesystem::absolute(config.plugin);
  try {
    return make_module_process([&whole] { return load_module(whole); },
                               {.name = config.module, .limit_s = config.limit_s, .folder = folder});
  } catch (const std::invalid_argument& refusal) {
    refuse(config, refusal.what());
  }
}

}  // namespace

std::unique_ptr<avoidance::Module> make_module(const AvoidanceConfig& config, const std::filesystem::path& folder) {
  if (const PluginConfig* plugin = config.plugin()) return make_plugin_module(*plugin, folder);
  if (const PythonConfig* script = config.python()) return make_python_module(*script, folder);
  return config.make();
}

}  // namespace hedgehop::sim
