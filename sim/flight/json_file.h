#pragma once

#include <exception>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace hedgehop::sim {

/// Returns the fault of a JSON file in one line: "b.json:2:1: is not complete JSON", "b.json: is not the record of a
/// batch: the key 'groups' is missing".
/// @param error  of the JSON library, thrown when it parsed the text or looked for a value.
/// @param kind   required kind of the file: "the record of a batch".
std::string json_fault(const std::filesystem::path& file, const std::exception& error, std::string_view kind);

/// Reads a JSON file that a run wrote. Throws InputError naming the file if it is missing, malformed (with line and
/// column) or nested deeper than 50 levels, and std::runtime_error if it cannot be read.
nlohmann::ordered_json read_json(const std::filesystem::path& file);

}  // namespace hedgehop::sim
