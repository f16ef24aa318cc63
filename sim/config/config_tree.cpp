#include "sim/config/config_tree.h"

#include <fmt/format.h>

#include <charconv>

#include "sim/fields/shortened.h"

namespace hedgehop::sim {

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

Node* Node::find(std::string_view key) {
  for (Entry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

std::string Node::description() const {
  switch (kind) {
    case Kind::null:
      return "an empty value";
    case Kind::list:
      return "a list";
    case Kind::map:
      return "a map";
    case Kind::scalar:
      break;
  }
  constexpr size_t kMaxBytes = 80;
  return fmt::format("{}'{}'", quoted ? "the text " : "", shortened(text, kMaxBytes));
}

SourcePosition position_of(const Node& root, std::string_view path) {
  const Node* node = &root;
  while (!path.empty()) {
    const size_t dot = path.find('.');
    const std::string_view key = path.substr(0, dot);
    const Node* next = node->find(key);
    size_t index = 0;
    if (node->kind == Node::Kind::list &&
        std::from_chars(key.data(), key.data() + key.size(), index).ec == std::errc() && index < node->items.size()) {
      next = &node->items[index];
    }
    if (!next) break;
    node = next;
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
  }
  return node->position;
}

}  // namespace hedgehop::sim
