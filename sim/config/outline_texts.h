#pragma once

#include <string>
#include <vector>

#include "sim/config/config_outline.h"

namespace hedgehop::sim {

/// Returns the YAML of a group with every key. An optional without a value is `~`.
std::string yaml_text(const std::vector<ConfigOutline>& fields);

/// Returns a text as a YAML scalar on one line, quoted if necessary.
std::string yaml_quoted(const std::string& text);

/// Returns a value as written, as YAML on one line.
std::string flow_text(const Node& node);

/// Returns the JSON Schema (draft 2020-12) of a group. A map with `use: file` may omit the keys of that file.
std::string schema_text(const std::vector<ConfigOutline>& fields, const std::string& title);

/// Returns one line per key with its unit, default, bounds and meaning, indented by `indent`.
std::string document_fields(const std::vector<ConfigOutline>& fields, int indent);

/// Returns one paragraph per choice: "name: meaning" and its keys.
std::string document_choices(const std::vector<ConfigOutline>& choices);

/// Returns the documentation of every choice of a variant.
template <fields::VariantField Variant>
std::string describe_choices() {
  return document_choices(outline_alternatives<Variant>());
}

}  // namespace hedgehop::sim
