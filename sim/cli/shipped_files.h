#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hedgehop::sim::cli {

/// The YAML files of a folder of configs such as "papers", by name: of the working folder's `configs`, else of those
/// beside the installed program. Throws InputError naming the folder where there are none.
std::vector<std::filesystem::path> shipped_files(const std::string& folder);

}  // namespace hedgehop::sim::cli
