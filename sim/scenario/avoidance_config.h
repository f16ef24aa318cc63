#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "sim/fields/field.h"
#include "sim/scenario/foreign_config.h"

namespace hedgehop::avoidance {
class Module;
}

namespace hedgehop::sim {

class Faults;
struct Outline;

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
  void read(const Node& node, const std::string& path, const fields::Field& field, Faults& faults);
  Outline outlined(const fields::Field& field) const;
  void require_bounds(const std::string& path) const;

 private:
  std::shared_ptr<const Choice> choice_;  ///< never null
};

}  // namespace hedgehop::sim
