#include "sim/scenario/schema.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using Kind = Outline::Kind;

Json schema_of(const Outline& node);

std::string description(const Field& field) {
  if (field.unit.empty()) return std::string(field.meaning);
  return field.meaning.empty() ? fmt::format("[{}]", field.unit) : fmt::format("{} [{}]", field.meaning, field.unit);
}

/// The value as JSON; numbers by way of their text, so that 0.1 stays 0.1.
Json value_of(const Outline& node) {
  if (!node.present) return nullptr;
  switch (node.kind) {
    case Kind::number:
    case Kind::integer:
    case Kind::boolean:
      return Json::parse(node.value);
    case Kind::list: {
      Json list = Json::array();
      for (const Outline& part : node.parts) list.push_back(value_of(part));
      return list;
    }
    default:
      return node.value;
  }
}

Json bounds_of(const Outline& node) {
  Json schema;
  const auto put = [&](const char* keyword, const std::optional<double>& bound) {
    if (bound) schema[keyword] = Json::parse(number_text(*bound, false));
  };
  put("exclusiveMinimum", node.field.above);
  put("minimum", node.field.at_least);
  put("exclusiveMaximum", node.field.below);
  put("maximum", node.field.at_most);
  if (node.non_negative && !node.field.above && !node.field.at_least) schema["minimum"] = 0;
  return schema;
}

/// A closed map of the fields, after `selector: name` when there is one.
Json group_schema(const std::vector<Outline>& fields, std::string_view selector, std::string_view name) {
  Json schema = {{"type", "object"}};
  Json& properties = schema["properties"] = Json::object();
  Json required = Json::array();
  if (!selector.empty()) properties[std::string(selector)] = {{"const", name}};
  properties["use"] = {{"type", "string"}, {"description", "file whose map this one is laid over"}};
  for (const Outline& field : fields) {
    properties[field.key] = schema_of(field);
    if (field.field.required) required.push_back(field.key);
  }
  schema["additionalProperties"] = false;
  if (!selector.empty()) schema["required"] = {selector};
  if (!required.empty()) {
    schema["anyOf"] = Json::array({Json{{"required", {"use"}}}, Json{{"required", required}}});
  }
  return schema;
}

Json variant_schema(const Outline& node) {
  const std::string selector(node.field.selector);
  Json choices = Json::array();
  for (const Outline& choice : node.all) {
    Json schema = group_schema(choice.parts, selector, choice.key);
    schema["title"] = choice.key;
    schema["description"] = choice.meaning;
    choices.push_back(std::move(schema));
  }
  // A file that is used may name the choice; then any of its keys may be laid over it.
  choices.push_back({{"type", "object"}, {"required", {"use"}}, {"not", {{"required", {selector}}}}});
  return {{"oneOf", std::move(choices)}};
}

Json schema_of(const Outline& node) {
  Json schema;
  switch (node.kind) {
    case Kind::number:
      schema = {{"type", "number"}};
      break;
    case Kind::integer:
      schema = {{"type", "integer"}};
      break;
    case Kind::boolean:
      schema = {{"type", "boolean"}};
      break;
    case Kind::text:
      schema = {{"type", {"string", "number", "boolean"}}};
      break;
    case Kind::choice:
      schema = {{"enum", node.field.choices}};
      break;
    case Kind::list:
      schema = {{"type", "array"}, {"items", schema_of(node.item.at(0))}};
      if (node.fixed_size > 0) schema["minItems"] = schema["maxItems"] = node.fixed_size;
      break;
    case Kind::group:
      schema = group_schema(node.parts, "", "");
      break;
    case Kind::variant:
      schema = variant_schema(node);
      break;
  }
  if (node.kind == Kind::number || node.kind == Kind::integer) schema.update(bounds_of(node));
  if (node.optional) schema = {{"anyOf", {schema, {{"type", "null"}}}}};
  if (const std::string text = description(node.field); !text.empty() && !node.key.empty())
    schema["description"] = text;
  const bool has_simple_value = node.kind != Kind::group && node.kind != Kind::variant;
  const bool list_of_maps = node.kind == Kind::list && !node.item.at(0).parts.empty();
  if (has_simple_value && !list_of_maps && !node.field.required && !node.key.empty())
    schema["default"] = value_of(node);
  return schema;
}

}  // namespace

std::string schema_text(const std::vector<Outline>& fields, const std::string& title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(group_schema(fields, "", ""));
  return schema.dump(2) + "\n";
}

}  // namespace hedgehop::sim
