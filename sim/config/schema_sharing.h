#pragma once

#include <nlohmann/json.hpp>

namespace hedgehop::sim {

/// Writes each larger part that a JSON Schema holds several times once, under `$defs`, and refers to it everywhere
/// else.
void share_definitions(nlohmann::ordered_json& schema);

}  // namespace hedgehop::sim
