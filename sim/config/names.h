#pragma once

#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Returns why a text cannot be a name of a scenario, camera, check or signal, such as "must not contain '/'"; "" if it
/// can. Names become parts of file names, columns and XML: 1 to 200 bytes, any letters of UTF-8 and spaces, but no
/// control characters, slashes, and no '.' or '-' at the beginning.
std::string name_fault(std::string_view name);

}  // namespace hedgehop::sim
