#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "avoidance/module.h"

/// The interface of modules outside this tree. A plugin library contains one line, HEDGEHOP_PLUGIN(my::Row, ...). A row
/// names a config struct with kName, kMeaning and describe(), like those of this tree, and the function that makes the
/// module. docs/writing-a-module.md has an example.
namespace hedgehop::avoidance {

/// Description of one parameter in describe(), as in the modules of this tree. Degrees ("deg", "deg/s") are converted
/// to radians.
struct ParameterField {
  std::string_view unit = "";
  std::optional<double> above = {}, at_least = {}, below = {}, at_most = {};
  std::vector<std::string_view> choices = {};  ///< for an enum: choices[i] names the enumerator of value i
  bool required = false;
  std::string_view meaning = "";
};

/// Reads or documents parameters across the library boundary.
class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;
  virtual void number(std::string_view key, double& value, const ParameterField& field) = 0;
  virtual void integer(std::string_view key, int64_t& value, const ParameterField& field) = 0;
  virtual void boolean(std::string_view key, bool& value, const ParameterField& field) = 0;
  virtual void text(std::string_view key, std::string& value, const ParameterField& field) = 0;
  virtual void choice(std::string_view key, int64_t& index, const ParameterField& field) = 0;
  virtual void numbers(std::string_view key, std::vector<double>& values, const ParameterField& field) = 0;
};

/// The visitor type that describe() of a config receives.
class ParameterLister {
 public:
  explicit ParameterLister(ParameterVisitor& visitor) : visitor_(visitor) {}

  template <class T>
  void operator()(std::string_view key, T& value, const ParameterField& field) {
    if constexpr (std::is_same_v<T, double>) {
      visitor_.number(key, value, field);
    } else if constexpr (std::is_same_v<T, bool>) {
      visitor_.boolean(key, value, field);
    } else if constexpr (std::is_same_v<T, std::string>) {
      visitor_.text(key, value, field);
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      visitor_.numbers(key, value, field);
    } else {
      static_assert(std::is_integral_v<T> || std::is_enum_v<T>, "a parameter is a number, a text, a choice or a list");
      auto whole = static_cast<int64_t>(value);
      if constexpr (std::is_enum_v<T>) {
        visitor_.choice(key, whole, field);
      } else {
        visitor_.integer(key, whole, field);
      }
      value = static_cast<T>(whole);
    }
  }

 private:
  ParameterVisitor& visitor_;
};

/// A module that a library provides.
class PluginRow {
 public:
  virtual ~PluginRow() = default;
  virtual std::string_view name() const = 0;
  virtual std::string_view meaning() const = 0;
  /// Passes every parameter, with its default value, to the visitor, which may change it; then makes the module. Throws
  /// std::invalid_argument on a bad config.
  virtual std::unique_ptr<Module> make(ParameterVisitor& parameters) const = 0;
};

template <class Config, std::unique_ptr<Module> (*make_module)(const Config&)>
class ModuleRow : public PluginRow {
 public:
  std::string_view name() const override { return Config::kName; }
  std::string_view meaning() const override { return Config::kMeaning; }
  std::unique_ptr<Module> make(ParameterVisitor& parameters) const override {
    Config config;
    ParameterLister lister(parameters);
    describe(lister, config);
    return make_module(config);
  }
};

using PluginRows = std::vector<std::unique_ptr<PluginRow>>;

template <class... Rows>
void add_rows(PluginRows& rows) {
  (rows.push_back(std::make_unique<Rows>()), ...);
}

#define HEDGEHOP_WORDS_(x) #x
#define HEDGEHOP_WORDS(x) HEDGEHOP_WORDS_(x)
/// The properties that must be equal in library and program: the version of this interface (increase it with every
/// change of this file or of module.h), the C++ ABI, and the versions of the packages whose types cross the boundary.
#define HEDGEHOP_PLUGIN_INTERFACE \
  "modules 5, C++ ABI " HEDGEHOP_WORDS(__GXX_ABI_VERSION) ", Eigen " HEDGEHOP_WORDS(EIGEN_WORLD_VERSION) "."      \
  HEDGEHOP_WORDS(EIGEN_MAJOR_VERSION) ", OpenCV " HEDGEHOP_WORDS(CV_VERSION_MAJOR) "." HEDGEHOP_WORDS(CV_VERSION_MINOR)

/// Exports modules. @param ...  rows: hedgehop::avoidance::ModuleRow<Config, make>.
#define HEDGEHOP_PLUGIN(...)                                                                                           \
  extern "C" __attribute__((visibility("default"))) const char* hedgehop_plugin_interface() {                          \
    return HEDGEHOP_PLUGIN_INTERFACE;                                                                                  \
  }                                                                                                                    \
  extern "C" __attribute__((visibility("default"))) void hedgehop_plugin_rows(hedgehop::avoidance::PluginRows& rows) { \
    hedgehop::avoidance::add_rows<__VA_ARGS__>(rows);                                                                  \
  }

}  // namespace hedgehop::avoidance
