#pragma once

#include <string>

#include "sim/config/outline.h"

namespace hedgehop::sim {

/// YAML of a group, every key in full; nothing stands for an optional without value but `~`.
std::string yaml_text(const std::vector<Outline>& fields);

/// Any text as a YAML scalar on one line, quoted where it must be.
std::string yaml_quoted(const std::string& text);

}  // namespace hedgehop::sim
