#pragma once

#include <variant>

#include "avoidance/registry.h"
#include "sim/scenario/avoidance_config.h"

namespace hedgehop::sim {

template <class Variant, class... More>
struct Widened;
template <class... Choices, class... More>
struct Widened<std::variant<Choices...>, More...> {
  using type = std::variant<Choices..., More...>;
};

/// A source that includes this header is recompiled with every module's config.
struct AvoidanceConfig::Choice {
  Widened<avoidance::ModuleConfig, PluginConfig, PythonConfig>::type module;
};

}  // namespace hedgehop::sim
