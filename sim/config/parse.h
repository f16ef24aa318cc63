#pragma once

#include <string>

#include "sim/config/tree.h"

namespace hedgehop::sim {

/// Parses one YAML document. Doubled keys, merge keys, tags, several documents, an empty text and syntax errors go to
/// `faults`; aliases are copied. @param file  name for places. @return what could be read, possibly null.
Node parse_yaml(const std::string& text, const std::string& file, Faults& faults);

}  // namespace hedgehop::sim
