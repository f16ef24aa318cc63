#include "sim/batch/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "sim/config/input_error.h"
#include "sim/config/numbers.h"

namespace hedgehop::sim {
namespace {

constexpr uint64_t kMostSeeds = 1'000'000;  // a slip of the pen, not a campaign

[[noreturn]] void refuse_seeds(const std::string& text, std::string_view why) {
  throw InputError(fmt::format("seeds '{}': {}; expected such as 1:10, 3 or 1:3,7", text, why));
}

}  // namespace

std::string resolved_yaml(Scenario scenario, uint64_t seed) {
  scenario.seed = seed;
  scenario.film.enabled = false;
  return to_yaml(scenario);
}

std::vector<std::string> run_arguments(const Order& order) {
  std::vector<std::string> arguments{"run", order.scenario.string(), "--seed", std::to_string(order.seed)};
  for (const std::string& text : order.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(text);
  }
  return arguments;
}

std::string rerun_command(const Order& order) {
  std::string command = "hedgehop";
  for (const std::string& argument : run_arguments(order)) command += " " + shell_quoted(argument);
  return command;
}

std::string shell_quoted(const std::string& word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

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
    if (!first || !last) refuse_seeds(text, fmt::format("'{}' is no whole number or range of them", part));
    if (*last < *first) refuse_seeds(text, fmt::format("{} comes after {}", *first, *last));
    if (*last - *first >= kMostSeeds - seeds.size()) refuse_seeds(text, "more than a million seeds");
    for (uint64_t offset = 0; offset <= *last - *first; ++offset) {
      if (!known.insert(*first + offset).second) refuse_seeds(text, fmt::format("{} stands twice", *first + offset));
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

}  // namespace hedgehop::sim
