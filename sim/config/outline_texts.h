#pragma once

#include <string>
#include <vector>

#include "sim/config/config_outline.h"

namespace hedgehop::sim {

/// YAML of a group, every key in full; nothing stands for an optional without value but `~`.
std::string yaml_text(const std::vector<ConfigOutline>& fields);

/// Any text as a YAML scalar on one line, quoted where it must be.
std::string yaml_quoted(const std::string& text);

/// JSON Schema (draft 2020-12) of a group. Any map may hold `use: file` and then leave out what that file gives.
std::string schema_text(const std::vector<ConfigOutline>& fields, const std::string& title);

/// For people: a line per key with its unit, default, bounds and meaning, indented by `indent`.
std::string document_fields(const std::vector<ConfigOutline>& fields, int indent);

/// For people: a paragraph per choice, "name: meaning" and its keys.
std::string document_choices(const std::vector<ConfigOutline>& choices);

/// Documentation of every choice of a variant.
template <fields::VariantField Variant>
std::string describe_choices() {
  return document_choices(outline_alternatives<Variant>());
}

}  // namespace hedgehop::sim
