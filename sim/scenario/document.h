#pragma once

#include <string>
#include <vector>

#include "sim/scenario/outline.h"

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

/// Topics of `hedgehop list`: "modules", "vehicles", "scenes", "cameras", "checks", "scenario".
const std::vector<std::string>& document_topics();
/// Text of a topic. Throws InputError, naming the topics, for any other.
std::string document(const std::string& topic);

}  // namespace hedgehop::sim
