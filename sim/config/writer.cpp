#include "sim/config/outline_texts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace hedgehop::sim {
namespace {

std::string always_quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// @param in_list  on one line with other items: there, a comma or a bracket ends an unquoted scalar.
std::string scalar(const ConfigOutline& node, bool in_list = false) {
  constexpr std::string_view kListSigns = ",?[]{}";
  if (node.kind == ConfigOutline::Kind::text) return yaml_quoted(node.value);
  const bool is_choice = node.kind == ConfigOutline::Kind::choice;
  const bool ends_early = in_list && node.value.find_first_of(kListSigns) < std::string::npos;
  const bool begins_list = node.value == "-";  // on a line of its own or after another dash
  return is_choice && (ends_early || begins_list) ? always_quoted(node.value) : node.value;
}

/// Returns a key, quoted if it contains signs of YAML or would be null.
std::string key_text(const std::string& key) {
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c >= 0x80; };
  const auto is_inner = [&](unsigned char c) { return is_word(c) || c == ' ' || c == '-' || c == '/' || c == '.'; };
  const bool plain = !key.empty() && is_word(static_cast<unsigned char>(key.front())) && key.back() != ' ' &&
                     std::ranges::all_of(key, is_inner);
  const bool is_null = key == "null" || key == "Null" || key == "NULL";
  return plain && !is_null ? key : always_quoted(key);
}

void write_fields(const std::vector<ConfigOutline>& fields, int indent, std::string& out);

/// Appends the value after "key:": on the same line for scalars and lists of scalars, otherwise on indented lines.
void write_value(const ConfigOutline& node, int indent, std::string& out) {
  if (!node.present) {
    out += " ~\n";
  } else if (node.is_scalar()) {
    out += fmt::format(" {}\n", scalar(node));
  } else if (node.kind == ConfigOutline::Kind::list && std::ranges::all_of(node.parts, &ConfigOutline::is_scalar)) {
    std::vector<std::string> items;
    for (const ConfigOutline& item : node.parts) items.push_back(scalar(item, /*in_list=*/true));
    out += fmt::format(" [{}]\n", fmt::join(items, ", "));
  } else if (node.kind == ConfigOutline::Kind::list) {
    out += "\n";
    for (const ConfigOutline& item : node.parts) {
      std::string text;
      write_value(item, indent + 2, text);
      // The first key of a map follows the dash instead of the line break and the indent.
      const bool has_keys = text.starts_with('\n');
      out += fmt::format("{:{}}-{}", "", indent, has_keys ? text.substr(static_cast<size_t>(indent) + 2) : text);
    }
  } else if (node.kind == ConfigOutline::Kind::group && node.parts.empty()) {
    out += " {}\n";
  } else {
    out += "\n";
    if (node.kind == ConfigOutline::Kind::variant && !node.chosen_by_key) {
      out += fmt::format("{:{}}{}: {}\n", "", indent, node.field.selector, node.chosen);
    }
    write_fields(node.parts, indent, out);
  }
}

void write_fields(const std::vector<ConfigOutline>& fields, int indent, std::string& out) {
  for (const ConfigOutline& field : fields) {
    out += fmt::format("{:{}}{}:", "", indent, key_text(field.key));
    write_value(field, indent + 2, out);
  }
}

}  // namespace

std::string yaml_text(const std::vector<ConfigOutline>& fields) {
  std::string out;
  write_fields(fields, 0, out);
  return out;
}

std::string flow_text(const Node& node) {
  std::vector<std::string> parts;
  switch (node.kind) {
    case Node::Kind::null:
      return "null";
    case Node::Kind::scalar: {
      constexpr std::string_view kFlowSigns = ",?[]{}:#\"'\\\n";
      const bool plain = !node.quoted && node.text.find_first_of(kFlowSigns) == std::string::npos;
      return plain ? node.text : node.quoted ? always_quoted(node.text) : yaml_quoted(node.text);
    }
    case Node::Kind::list:
      for (const Node& item : node.items) parts.push_back(flow_text(item));
      return fmt::format("[{}]", fmt::join(parts, ", "));
    case Node::Kind::map:
      for (const Entry& entry : node.entries) parts.push_back(key_text(entry.key) + ": " + flow_text(entry.value));
      return fmt::format("{{{}}}", fmt::join(parts, ", "));
  }
  return "";
}

std::string yaml_quoted(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-' || c == '/' || c == '.'; };
  const bool is_word = !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
                       std::all_of(text.begin(), text.end(), plain);
  static constexpr std::string_view kReserved[] = {"null", "Null", "NULL", "true", "false", "yes", "no", "on", "off"};
  if (is_word && std::find(std::begin(kReserved), std::end(kReserved), text) == std::end(kReserved)) return text;

  return always_quoted(text);
}

}  // namespace hedgehop::sim
