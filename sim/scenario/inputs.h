#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

/// The files that a flight depends on, with the SHA-256 of each as `sha256sum` prints it, or "missing". A name is
/// relative to the scenario's folder where the file lies below or near it, else absolute.
using Inputs = std::map<std::string, std::string>;

/// @param read    the scenario's file and all that it uses.
/// @param folder  of the scenario's file.
/// @return those, and the meshes with their materials and images, camera calibrations, reference paths and the plugin.
Inputs inputs_of(const Scenario& scenario, const std::set<std::filesystem::path>& read,
                 const std::filesystem::path& folder);

/// Returns the SHA-256 of all inputs of the flights of a scenario except their seed: every resolved value, with the
/// renderer, and the content of every file that it names. Equal in every copy of the files. Description, tags, notes,
/// origin, film and the layout of YAML files do not count.
/// @param folder  of the scenario's file.
std::string scenario_sha256(Scenario scenario, const std::filesystem::path& folder);

/// 64 hexadecimal digits, or "missing" if there is no such file.
std::string sha256(const std::filesystem::path& file);

}  // namespace hedgehop::sim
