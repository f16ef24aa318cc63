#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hedgehop::sim::cli {

/// Returns the YAML files of a folder of configs such as "papers", sorted by name. They are taken from `configs` in the
/// working folder, otherwise from those of the installed program. Throws InputError that names the folder if there are
/// no such files.
std::vector<std::filesystem::path> shipped_files(const std::string& folder);

}  // namespace hedgehop::sim::cli
