#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sim/config/input_error.h"

namespace hedgehop::sim {

/// The YAML files of a folder, and the files that are left out.
struct FolderFiles {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> yaml;                              ///< *.yaml and *.yml, sorted
  std::vector<std::filesystem::path> others;                            ///< files of other kinds, sorted
  std::vector<std::pair<std::filesystem::path, size_t>> not_descended;  ///< subfolders with their number of YAML files
  std::vector<std::filesystem::path> links;                             ///< to folders with YAML files, sorted
  std::vector<std::string> faults;                                      ///< one line for each unreadable folder
  size_t results = 0;                                                   ///< scenarios that earlier flights wrote
};

/// Returns the files of a folder. Hidden files and folders do not count; links to folders are not followed.
/// @param recursive  whether subfolders are read.
FolderFiles files_of(const std::filesystem::path& folder, bool recursive);

/// Calls `read` for each YAML file of a folder. Parts of scenarios, such as a rig, are read last, and only if no
/// scenario uses them: `used` returns the files that have been used so far, canonical.
void read_each(const FolderFiles& files, const std::function<void(const std::filesystem::path&)>& read,
               const std::function<std::set<std::filesystem::path>()>& used);

/// Returns one line that names the files that are left out, or "". @param used  files that scenarios use, canonical;
/// they are not left out.
std::string left_out_words(const FolderFiles& files, const std::set<std::filesystem::path>& used);

/// Returns overrides in which the paths of a module (`avoidance={plugin: ...}`, `avoidance.python=...`) are relative to
/// the working folder instead of a file's folder, so that they have the same meaning after --set.
std::vector<std::string> with_module_paths(std::vector<std::string> overrides, const std::filesystem::path& folder);

struct Node;
/// Positions of overrides in their file, by their text with the paths of with_module_paths().
using OverridePositions = std::map<std::string, SourcePosition>;
/// Returns the positions of the items of all keys `set` of a file. @param folder  of the file.
OverridePositions override_positions(const Node& root, const std::filesystem::path& folder);
/// Returns faults in which the position of an override replaces "--set key". @param overrides  a later one has
/// precedence.
std::vector<std::string> at_overrides(std::vector<std::string> faults, const std::vector<std::string>& overrides,
                                      const OverridePositions& positions);

}  // namespace hedgehop::sim
