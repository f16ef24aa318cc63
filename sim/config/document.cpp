#include "sim/config/outline_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/config/config_tree.h"
#include "sim/config/numbers.h"
#include "sim/config/other_units.h"

namespace hedgehop::sim {
namespace {

using Kind = ConfigOutline::Kind;

bool has_parts(const ConfigOutline& node) { return node.kind == Kind::group || node.kind == Kind::variant; }

std::string type_words(const ConfigOutline& node) {
  switch (node.kind) {
    case Kind::number:
      return "number";
    case Kind::integer:
      return "integer";
    case Kind::boolean:
      return "true|false";
    case Kind::text:
      return "text";
    case Kind::choice:
      return fmt::format("{}", fmt::join(node.field.choices, "|"));
    case Kind::any:
      return "any value";
    case Kind::group:
      return "map";
    case Kind::variant: {
      std::vector<std::string> names;
      for (const ConfigOutline& choice : node.all) names.push_back(choice.key);
      return fmt::format("map with {}: {}", node.field.selector, fmt::join(names, "|"));
    }
    case Kind::list:
      break;
  }
  const std::string item = type_words(node.item.at(0));
  return node.fixed_size > 0 ? fmt::format("{} x {}", node.fixed_size, item) : "list of " + item;
}

std::string bounds_words(const fields::Field& field) {
  std::vector<std::string> bounds;
  const std::optional<double> limit =
      fields::unit_limit(field.unit);  // holds for every field of the unit, so it is omitted
  const auto put = [&](std::string_view relation, const std::optional<double>& bound) {
    if (bound && (!limit || std::abs(*bound) != *limit)) bounds.push_back(fmt::format("{} {}", relation, *bound));
  };
  put(">", field.above);
  put(">=", field.at_least);
  put("<", field.below);
  put("<=", field.at_most);
  return fmt::format("{}", fmt::join(bounds, " and "));
}

/// Returns a scalar with at most 12 digits; the exact decimal of an angle has more.
std::string readable(const ConfigOutline& node) {
  return node.kind == Kind::number ? fmt::format("{:.12g}", parse_number(node.value, false).member) : node.value;
}

std::string default_words(const ConfigOutline& node) {
  if (node.field.required) return "required";
  if (has_parts(node) && node.present) return "";
  if (!node.present) return "default none";
  if (node.kind == Kind::text) return node.value.empty() ? "default empty" : "default " + node.value;
  if (node.kind != Kind::list) return "default " + readable(node);
  std::vector<std::string> items;
  for (const ConfigOutline& part : node.parts) items.push_back(has_parts(part) ? "..." : readable(part));
  return fmt::format("default [{}]", fmt::join(items, ", "));
}

}  // namespace

std::string document_fields(const std::vector<ConfigOutline>& fields, int indent) {
  size_t key_width = 0;
  for (const ConfigOutline& field : fields) key_width = std::max(key_width, field.key.size());
  std::string text;
  for (const ConfigOutline& field : fields) {
    std::vector<std::string> facts;
    const std::string unit = field.field.unit.empty() ? "" : fmt::format(" {}", field.field.unit);
    for (std::string fact : {type_words(field) + unit, bounds_words(field.field), default_words(field)}) {
      if (!fact.empty()) facts.push_back(std::move(fact));
    }
    const std::string_view other = other_unit_key(field.key, field.field.unit);
    const std::string instead = other.empty() ? "" : fmt::format("; or `{}` in its place", other);
    text += fmt::format("{:{}}{:{}}  {}{}  ({})\n", "", indent, field.key, key_width, field.field.meaning, instead,
                        fmt::join(facts, ", "));
    const ConfigOutline& shape = field.kind == Kind::list ? field.item.at(0) : field;
    if (shape.kind == Kind::group) text += document_fields(shape.parts, indent + 4);
    if (shape.kind == Kind::variant && indent > 0) {  // the choices of a scenario's own keys are topics
      for (const ConfigOutline& choice : shape.all) {
        text += fmt::format("{:{}}{}: {}\n", "", indent + 4, choice.key, choice.meaning);
        text += document_fields(choice.parts, indent + 8);
      }
    }
  }
  return text;
}

std::string document_choices(const std::vector<ConfigOutline>& choices) {
  std::string text;
  for (const ConfigOutline& choice : choices) {
    text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", choice.key, choice.meaning);
    text += document_fields(choice.parts, 4);
  }
  return text;
}

}  // namespace hedgehop::sim
