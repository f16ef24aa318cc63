#include "sim/config/outline.h"

namespace hedgehop::sim {

Outline outline_as_written(const Node& node) {
  Outline outline;
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
      outline.kind = Outline::Kind::list;
      for (const Node& item : node.items) outline.parts.push_back(outline_as_written(item));
      break;
    case Node::Kind::scalar:
      // A choice is written without quotes: what was a number stays one.
      outline.kind = node.quoted ? Outline::Kind::text : Outline::Kind::choice;
      outline.value = node.text;
      break;
  }
  return outline;
}

}  // namespace hedgehop::sim
