#include "sim/config/outline_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "sim/config/other_units.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ConfigOutline::Kind;

constexpr size_t kWorthSharing = 200;  // letters

/// Calls `visit` with each direct part of `schema` and a name for it.
template <class Visit>
void each_part(Json& schema, const std::string& name, Visit visit) {
  for (auto& [keyword, rule] : schema.items()) {
    if (keyword == "properties") {
      for (auto& [key, part] : rule.items()) visit(part, key);
    } else if (keyword == "oneOf" || keyword == "anyOf" || keyword == "allOf") {
      for (Json& part : rule) visit(part, part.value("title", name));
    } else if (keyword == "then" || keyword == "else" || keyword == "items") {
      visit(rule, rule.is_object() ? rule.value("title", name) : name);
    }
  }
}

class Sharing {
 public:
  explicit Sharing(Json& root) : root_(root) {
    each_part(root_, "", [this](Json& part, const std::string&) { count(part); });
    each_part(root_, "", [this](Json& part, const std::string& name) { replace(part, name); });
    if (!definitions_.empty()) root_["$defs"] = std::move(definitions_);
  }

 private:
  // The parts of a part that occurred before are written once with it.
  void count(Json& schema) {
    if (++uses_[schema.dump()] > 1) return;
    each_part(schema, "", [this](Json& part, const std::string&) { count(part); });
  }

  void replace(Json& schema, const std::string& name) {
    const std::string text = schema.dump();
    const bool shared = text.size() >= kWorthSharing && uses_.at(text) > 1;
    std::string& defined = names_[text];
    const bool first = defined.empty();
    if (shared && first) defined = unused(name);
    const std::string reference = "#/$defs/" + defined;
    if (!shared || first) {
      each_part(schema, name, [this](Json& part, const std::string& inner) { replace(part, inner); });
    }
    if (!shared) return;
    if (first) definitions_[reference.substr(std::string_view("#/$defs/").size())] = std::move(schema);
    schema = {{"$ref", reference}};
  }

  std::string unused(const std::string& name) {
    const int number = ++named_[name];
    return number == 1 ? name : fmt::format("{}_{}", name, number);
  }

  Json& root_;
  Json definitions_ = Json::object();
  std::map<std::string, int> uses_, named_;
  std::map<std::string, std::string> names_;  ///< by text
};

Json schema_of(const ConfigOutline& node, bool partial);

std::string description(const fields::Field& field) {
  if (field.unit.empty()) return std::string(field.meaning);
  return field.meaning.empty() ? fmt::format("[{}]", field.unit) : fmt::format("{} [{}]", field.meaning, field.unit);
}

/// Returns the value as JSON; numbers are parsed from their text, so that 0.1 remains 0.1.
Json value_of(const ConfigOutline& node) {
  if (!node.present) return nullptr;
  switch (node.kind) {
    case Kind::number:
    case Kind::integer:
    case Kind::boolean:
      return Json::parse(node.value);
    case Kind::list: {
      Json list = Json::array();
      for (const ConfigOutline& part : node.parts) list.push_back(value_of(part));
      return list;
    }
    default:
      return node.value;
  }
}

Json bounds_of(const ConfigOutline& node) {
  Json schema = Json::object();
  if (node.kind != Kind::number && node.kind != Kind::integer) return schema;
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

/// Whether a key under these fields is required, unless a used file gives it.
bool demands_something(const std::vector<ConfigOutline>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](const ConfigOutline& field) {
    return field.field.required || field.kind == Kind::variant || demands_something(field.parts);
  });
}

/// Returns the schema of a map of these fields only. With `partial`, all are optional, because a used file gives them.
/// @param selector, name  a first key of constant value, unless they are empty.
Json closed_map(const std::vector<ConfigOutline>& fields, std::string_view selector, std::string_view name,
                bool partial) {
  Json schema = {{"type", "object"}};
  Json& properties = schema["properties"] = Json::object();
  Json required = Json::array();
  if (!selector.empty()) {
    properties[std::string(selector)] = {{"const", name}};
    required.push_back(selector);
  }
  properties["use"] = {{"type", "string"}, {"description", "file whose map this one is laid over"}};
  for (const ConfigOutline& field : fields) {
    properties[field.key] = schema_of(field, partial);
    if (const std::string_view other = other_unit_key(field.key, field.field.unit); !other.empty()) {
      properties[std::string(other)] = {{"type", "number"},
                                        {"description", fmt::format("in place of {}, in rpm", field.key)}};
    }
    if (field.field.required && !partial) required.push_back(field.key);
  }
  schema["additionalProperties"] = false;
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json group_schema(const std::vector<ConfigOutline>& fields, std::string_view selector, std::string_view name,
                  bool partial) {
  if (partial || !demands_something(fields)) return closed_map(fields, selector, name, partial);
  return {{"if", {{"type", "object"}, {"required", {"use"}}}},
          {"then", closed_map(fields, selector, name, true)},
          {"else", closed_map(fields, selector, name, false)}};
}

/// Returns the schema of a map without the selector, which a used file gives: any key of any choice.
Json unnamed_choice(const ConfigOutline& node, bool partial) {
  Json properties = {{"use", {{"type", "string"}}}};
  for (const ConfigOutline& choice : node.all) {
    if (choice.chosen_by_key) continue;
    for (const ConfigOutline& field : choice.parts) properties[field.key] = true;
  }
  Json schema = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!partial) schema["required"] = {"use"};
  return schema;
}

/// One rule per choice, so that an editor reports a wrong key for the choice that contains it.
Json variant_schema(const ConfigOutline& node, bool partial) {
  const std::string selector(node.field.selector);
  const Json selected = {{"type", "object"}, {"required", {selector}}};
  Json rules = Json::array(), names = Json::array(), unselected = Json::array();
  for (const ConfigOutline& choice : node.all) {
    Json schema = group_schema(choice.parts, choice.chosen_by_key ? "" : selector, choice.key, partial);
    schema["title"] = choice.key;
    schema["description"] = choice.meaning;
    if (choice.chosen_by_key) {
      unselected.push_back(std::move(schema));
      continue;
    }
    names.push_back(choice.key);
    Json chosen = selected;
    chosen["properties"] = {{selector, {{"const", choice.key}}}};
    rules.push_back({{"if", std::move(chosen)}, {"then", std::move(schema)}});
  }
  unselected.push_back(unnamed_choice(node, partial));
  const Json named = {{"properties", {{selector, {{"enum", std::move(names)}}}}}};
  rules.push_back({{"if", selected}, {"then", named}, {"else", {{"anyOf", std::move(unselected)}}}});
  return {{"type", "object"}, {"allOf", std::move(rules)}};
}

Json scalar_schema(const ConfigOutline& node) {
  switch (node.kind) {
    case Kind::number:
      return {{"type", "number"}};
    case Kind::integer:
      return {{"type", "integer"}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::choice:
      return {{"enum", node.field.choices}};
    case Kind::any:
      return Json::object();
    default:
      return {{"type", {"string", "number", "boolean"}}};  // a name may look like a number
  }
}

Json schema_of(const ConfigOutline& node, bool partial) {
  Json schema;
  if (node.open) {
    schema = {{"type", "object"}};
  } else if (node.kind == Kind::group) {
    schema = group_schema(node.parts, "", "", partial);
  } else if (node.kind == Kind::variant) {
    schema = variant_schema(node, partial);
  } else if (node.kind == Kind::list) {
    schema = {{"type", "array"}, {"items", schema_of(node.item.at(0), false)}};
    if (node.fixed_size > 0) schema["minItems"] = schema["maxItems"] = node.fixed_size;
  } else {
    schema = scalar_schema(node);
    schema.update(bounds_of(node));
  }
  if (node.optional) schema = {{"anyOf", {schema, {{"type", "null"}}}}};
  if (node.key.empty()) return schema;

  if (const std::string text = description(node.field); !text.empty()) schema["description"] = text;
  const bool list_of_maps = node.kind == Kind::list && !node.item.at(0).is_scalar();
  if ((node.is_scalar() || node.kind == Kind::list) && !list_of_maps && !node.field.required) {
    schema["default"] = value_of(node);
  }
  return schema;
}

}  // namespace

std::string schema_text(const std::vector<ConfigOutline>& fields, const std::string& title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  schema.update(group_schema(fields, "", "", false));
  Sharing{schema};
  return schema.dump(2) + "\n";
}

}  // namespace hedgehop::sim
