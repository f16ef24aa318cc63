#pragma once

#include <cstdint>
#include <vector>

#include <optional>
#include <string>

namespace hedgehop::sim {

/// Seeds of a text like "1:10" (both ends), "3" or "1:3,7". @throws InputError for anything else, for a range that
/// falls, for a doubled seed or more than a million of them.
std::vector<uint64_t> parse_seeds(const std::string& text);

/// Seeds as parse_seeds() reads them, in rising order, each once; "" of none.
std::string seed_words(std::vector<uint64_t> seeds);

/// Seeds that parameters were chosen on do not judge them: a file that judges states both, as `tuned_on:` and `seeds:`.
/// @param tuned_on  as the file has it: seeds such as 1:100, or "none"; nothing where the key is missing.
/// @return what is wrong, one line: tuned_on missing, either no seeds, or a seed in both; "" when nothing is.
std::string judging_fault(const std::optional<std::string>& tuned_on, const std::string& seeds);

/// Whether every seed of `part` is one of `whole`. Throws InputError where either is no list of seeds.
bool within(const std::string& part, const std::string& whole);

}  // namespace hedgehop::sim
