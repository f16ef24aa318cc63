#include "sim/scenario/avoidance_config.h"

#include <utility>

#include "avoidance/module.h"
#include "sim/config/config_outline.h"
#include "sim/config/reader.h"
#include "sim/fields/bounds.h"
#include "sim/scenario/avoidance_choice.h"

namespace hedgehop::sim {

AvoidanceConfig::AvoidanceConfig() : AvoidanceConfig(Choice{}) {}

AvoidanceConfig::AvoidanceConfig(Choice choice) : choice_(std::make_shared<const Choice>(std::move(choice))) {}

std::string_view AvoidanceConfig::name() const {
  return std::visit([]<class Config>(const Config&) { return Config::kName; }, choice_->module);
}

const PluginConfig* AvoidanceConfig::plugin() const { return std::get_if<PluginConfig>(&choice_->module); }

const PythonConfig* AvoidanceConfig::python() const { return std::get_if<PythonConfig>(&choice_->module); }

std::unique_ptr<avoidance::Module> AvoidanceConfig::make() const {
  return std::visit(
      []<class Config>(const Config& config) -> std::unique_ptr<avoidance::Module> {
        if constexpr (std::is_constructible_v<avoidance::ModuleConfig, Config>) {
          return avoidance::make_module(config);
        } else {
          return nullptr;
        }
      },
      choice_->module);
}

void AvoidanceConfig::read(const Node& node, const std::string& path, const fields::Field& field, ErrorList& errors) {
  Choice choice = *choice_;
  read_value(node, path, field, choice.module, errors);
  *this = std::move(choice);
}

ConfigOutline AvoidanceConfig::outlined(const fields::Field& field) const { return outline(choice_->module, field); }

void AvoidanceConfig::check_bounds(const std::string& path, std::vector<fields::InvalidField>& errors) const {
  const fields::BoundsVisitor visitor("", errors);
  visitor(path, choice_->module, {});
}

}  // namespace hedgehop::sim
