#pragma once

#include <optional>
#include <string>

namespace hedgehop::sim {

/// Seeds that parameters were chosen on do not judge them: a file that judges states both, as `tuned_on:` and `seeds:`.
/// @param tuned_on  as the file has it: seeds such as 1:100, or "none"; nothing where the key is missing.
/// @return what is wrong, one line: tuned_on missing, either no seeds, or a seed in both; "" when nothing is.
std::string judging_fault(const std::optional<std::string>& tuned_on, const std::string& seeds);

/// Whether every seed of `part` is one of `whole`. Throws InputError where either is no list of seeds.
bool within(const std::string& part, const std::string& whole);

}  // namespace hedgehop::sim
