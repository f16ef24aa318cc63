#pragma once

#include <string>
#include <vector>

#include "sim/config/outline.h"

namespace hedgehop::sim {

/// For people: a line per key with its unit, default, bounds and meaning, indented by `indent`.
std::string document_fields(const std::vector<Outline>& fields, int indent);

/// For people: a paragraph per choice, "name: meaning" and its keys.
std::string document_choices(const std::vector<Outline>& choices);

/// Documentation of every choice of a variant.
template <fields::VariantField Variant>
std::string describe_choices() {
  return document_choices(outline_alternatives<Variant>());
}

}  // namespace hedgehop::sim
