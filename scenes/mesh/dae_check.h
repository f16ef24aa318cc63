#pragma once

#include <string>

namespace hedgehop::scenes::mesh {

/// Returns why the importer cannot process a DAE safely, such as "its XML is nested deeper than 200"; empty if it can.
/// Checked are the nesting of elements, the indices of polygons, and that each array has the numbers that its accessor
/// reads.
std::string fault_of_dae(const std::string& dae);

}  // namespace hedgehop::scenes::mesh
