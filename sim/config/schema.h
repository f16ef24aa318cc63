#pragma once

#include <string>

#include "sim/config/outline.h"

namespace hedgehop::sim {

/// JSON Schema (draft 2020-12) of a group. Any map may hold `use: file` and then leave out what that file gives.
std::string schema_text(const std::vector<Outline>& fields, const std::string& title);

}  // namespace hedgehop::sim
