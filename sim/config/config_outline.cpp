#include "sim/config/config_outline.h"

namespace hedgehop::sim {

ConfigOutline outline_as_written(const Node& node) {
  ConfigOutline outline;
  switch (node.kind) {
    case Node::Kind::null:
      outline.present = false;
      break;
    case Node::Kind::map:
      for (const Entry& entry : node.entries) {
        outline.parts.push_back(outline_as_written(entry.value));
        outline.parts.back().key = entry.key;
      }
      break;
    case Node::Kind::list:
      outline.kind = ConfigOutline::Kind::list;
      for (const Node& item : node.items) outline.parts.push_back(outline_as_written(item));
      break;
    case Node::Kind::scalar:
      // A choice is written without quotes, so that a number remains a number.
      outline.kind = node.quoted ? ConfigOutline::Kind::text : ConfigOutline::Kind::choice;
      outline.value = node.text;
      break;
  }
  return outline;
}

}  // namespace hedgehop::sim
