#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace hedgehop::sim {

using Json = nlohmann::json;

/// A YAML document as JSON, by the YAML library's own tree: has no code in common with the scenario reader.
inline Json json_of(const YAML::Node& node) {
  if (node.IsNull()) return nullptr;
  if (node.IsSequence()) {
    Json list = Json::array();
    for (const YAML::Node& item : node) list.push_back(json_of(item));
    return list;
  }
  if (node.IsMap()) {
    Json map = Json::object();
    for (const auto& entry : node) map[entry.first.as<std::string>()] = json_of(entry.second);
    return map;
  }
  const std::string text = node.as<std::string>();
  if (node.Tag() == "!") return text;
  if (text == "true" || text == "false") return text == "true";
  const Json number = Json::parse(text, nullptr, false);
  return number.is_number() ? number : Json(text);
}

/// Checks a value against the keywords of JSON Schema that our schema uses; an unknown keyword is a fault.
/// @return "" when the value is valid, else the first fault.
/// @param root  holds the `$defs` that the schema refers to.
inline std::string schema_fault(const Json& root, const Json& schema, const Json& value,
                                const std::string& path = "$") {
  const auto is_type = [&](const std::string& type) {
    if (type == "integer") return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    if (type == "number") return value.is_number();
    return type == value.type_name();
  };
  const auto count_valid = [&](const Json& schemas) {
    int count = 0;
    for (const Json& each : schemas) count += schema_fault(root, each, value, path).empty();
    return count;
  };
  if (schema.is_boolean()) return schema.get<bool>() ? "" : path + ": not allowed";
  for (const auto& [keyword, rule] : schema.items()) {
    const std::string fault =
        path + ": " + keyword + " " + rule.dump().substr(0, 80) + ", got " + value.dump().substr(0, 80);
    bool holds = true;
    if (keyword == "type") {
      holds = rule.is_array() ? std::any_of(rule.begin(), rule.end(), is_type) : is_type(rule);
    } else if (keyword == "const") {
      holds = value == rule;
    } else if (keyword == "enum") {
      holds = std::find(rule.begin(), rule.end(), value) != rule.end();
    } else if (keyword == "minimum") {
      holds = value >= rule;
    } else if (keyword == "maximum") {
      holds = value <= rule;
    } else if (keyword == "exclusiveMinimum") {
      holds = value > rule;
    } else if (keyword == "exclusiveMaximum") {
      holds = value < rule;
    } else if (keyword == "minItems") {
      holds = value.size() >= rule.get<size_t>();
    } else if (keyword == "maxItems") {
      holds = value.size() <= rule.get<size_t>();
    } else if (keyword == "required") {
      holds = std::all_of(rule.begin(), rule.end(), [&](const Json& key) { return value.contains(key); });
    } else if (keyword == "oneOf") {
      holds = count_valid(rule) == 1;
    } else if (keyword == "anyOf") {
      holds = count_valid(rule) > 0;
    } else if (keyword == "if") {
      const char* const taken = schema_fault(root, rule, value, path).empty() ? "then" : "else";
      const Json branch = schema.value(taken, Json(true));
      if (std::string inner = schema_fault(root, branch, value, path); !inner.empty()) return inner;
    } else if (keyword == "allOf") {
      for (const Json& each : rule) {
        if (std::string inner = schema_fault(root, each, value, path); !inner.empty()) return inner;
      }
    } else if (keyword == "$ref") {
      const Json& defined = root.at(Json::json_pointer(rule.get<std::string>().substr(1)));
      if (std::string inner = schema_fault(root, defined, value, path); !inner.empty()) return inner;
    } else if (keyword == "items") {
      for (const Json& item : value) {
        if (std::string inner = schema_fault(root, rule, item, path + "[]"); !inner.empty()) return inner;
      }
    } else if (keyword == "properties") {
      for (const auto& [key, inner_schema] : rule.items()) {
        if (!value.contains(key)) continue;
        if (std::string inner = schema_fault(root, inner_schema, value[key], path + "." + key); !inner.empty())
          return inner;
      }
    } else if (keyword == "additionalProperties") {
      for (const auto& [key, ignored] : value.items()) {
        if (!schema["properties"].contains(key)) return path + ": unknown " + key;
      }
    } else {
      holds = keyword == "then" || keyword == "else" || keyword == "$schema" || keyword == "$defs" ||
              keyword == "title" || keyword == "description" || keyword == "default";
    }
    if (!holds) return fault;
  }
  return "";
}

}  // namespace hedgehop::sim
