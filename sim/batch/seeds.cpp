#include "sim/batch/seeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

constexpr uint64_t kMaxSeeds = 1'000'000;  // a slip of the pen, not a campaign

[[noreturn]] void refuse_seeds(const std::string& text, std::string_view why) {
  throw InputError(fmt::format("seeds '{}': {}; expected such as 1:10, 3 or 1:3,7", text, why));
}

std::set<uint64_t> seed_set(const std::string& text) {
  const std::vector<uint64_t> seeds = parse_seeds(text);
  return {seeds.begin(), seeds.end()};
}

}  // namespace

std::vector<uint64_t> parse_seeds(const std::string& text) {
  std::vector<uint64_t> seeds;
  std::set<uint64_t> known;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, comma - begin);
    begin = comma + 1;
    const size_t colon = part.find(':');
    const std::optional<uint64_t> first = parse_unsigned(part.substr(0, colon));
    const std::optional<uint64_t> last = colon == std::string::npos ? first : parse_unsigned(part.substr(colon + 1));
    if (!first || !last) refuse_seeds(text, fmt::format("'{}' is not a whole number or a range such as 1:10", part));
    if (*last < *first) refuse_seeds(text, fmt::format("{} comes after {}", *first, *last));
    if (*last - *first >= kMaxSeeds - seeds.size()) refuse_seeds(text, "more than a million seeds");
    for (uint64_t offset = 0; offset <= *last - *first; ++offset) {
      if (!known.insert(*first + offset).second) refuse_seeds(text, fmt::format("{} occurs twice", *first + offset));
      seeds.push_back(*first + offset);
    }
  }
  return seeds;
}

std::string seed_words(std::vector<uint64_t> seeds) {
  std::ranges::sort(seeds);
  std::string words;
  for (size_t i = 0; i < seeds.size();) {
    const uint64_t first = seeds[i];
    uint64_t last = first;
    while (i < seeds.size() && (seeds[i] == last || seeds[i] == last + 1)) last = seeds[i++];
    words += words.empty() ? "" : ",";
    words += first == last ? std::to_string(first) : fmt::format("{}:{}", first, last);
  }
  return words;
}

std::string judging_fault(const std::optional<std::string>& tuned_on, const std::string& seeds) {
  if (!tuned_on) {
    return "missing key 'tuned_on': the seeds on which parameters were chosen, such as 1:100, or none; 'seeds' must "
           "not "
           "contain any of them";
  }
  try {
    const std::vector<uint64_t> judging = parse_seeds(seeds);
    if (*tuned_on == "none") return "";
    const std::set<uint64_t> tuning = seed_set(*tuned_on);
    const auto shared = std::ranges::find_if(judging, [&](uint64_t seed) { return tuning.contains(seed); });
    if (shared == judging.end()) return "";
    return fmt::format("seeds '{}' judge by seed {}, which parameters were chosen on (tuned_on '{}'); take others",
                       seeds, *shared, *tuned_on);
  } catch (const InputError& error) {
    return error.errors().front();
  }
}

bool within(const std::string& part, const std::string& whole) {
  const std::set<uint64_t> all = seed_set(whole);
  return std::ranges::all_of(parse_seeds(part), [&](uint64_t seed) { return all.contains(seed); });
}

}  // namespace hedgehop::sim
