#pragma once

#include <string>

namespace hedgehop::sim {

struct Node;

/// Returns the kind of a file by its keys, with its use: "a vehicle; a scenario names it: vehicle: {use: FILE}"; "" if
/// it is of no known kind.
std::string file_kind(const Node& root);

/// Whether the keys are those of a file for a command, such as a scenario, and not those of a part of a scenario.
bool is_command_file(const Node& root);

}  // namespace hedgehop::sim
