#pragma once

#include <cstdint>
#include <vector>

#include <optional>
#include <string>

namespace hedgehop::sim {

/// Returns the seeds of a text such as "1:10" (both ends included), "3" or "1:3,7". Throws InputError for any other
/// text, for a descending range, a repeated seed, or more than a million seeds.
std::vector<uint64_t> parse_seeds(const std::string& text);

/// Returns seeds as text for parse_seeds(), in ascending order without duplicates; "" without seeds.
std::string seed_words(std::vector<uint64_t> seeds);

/// Checks that tuning seeds are not used for evaluation. A file that evaluates states both, as `tuned_on:` and
/// `seeds:`.
/// @param tuned_on  value of the key: seeds such as 1:100, or "none"; nullopt if the key is missing.
/// @return the error, one line: tuned_on missing, a text that is not a list of seeds, or a seed in both; "" if valid.
std::string judging_fault(const std::optional<std::string>& tuned_on, const std::string& seeds);

/// Returns whether every seed of `part` is in `whole`. Throws InputError if either is not a list of seeds.
bool within(const std::string& part, const std::string& whole);

}  // namespace hedgehop::sim
