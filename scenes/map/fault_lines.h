#pragma once

#include <string>
#include <vector>

namespace hedgehop::scenes::map {

/// Joins the faults of each object to one line, in the order of the first ones. Equal faults of an object occur once.
/// @param faults  "way 12: ..." each.
std::vector<std::string> one_line_each(const std::vector<std::string>& faults);

}  // namespace hedgehop::scenes::map
