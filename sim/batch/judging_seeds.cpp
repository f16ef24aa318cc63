#include "sim/batch/judging_seeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "sim/batch/order.h"
#include "sim/config/input_error.h"

namespace hedgehop::sim {
namespace {

std::set<uint64_t> seed_set(const std::string& text) {
  const std::vector<uint64_t> seeds = parse_seeds(text);
  return {seeds.begin(), seeds.end()};
}

}  // namespace

std::string judging_fault(const std::optional<std::string>& tuned_on, const std::string& seeds) {
  if (!tuned_on) {
    return "needs 'tuned_on': the seeds that parameters were chosen on, such as 1:100, or none where none were; "
           "'seeds' lie outside of them";
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
    return error.faults().front();
  }
}

bool within(const std::string& part, const std::string& whole) {
  const std::set<uint64_t> all = seed_set(whole);
  return std::ranges::all_of(parse_seeds(part), [&](uint64_t seed) { return all.contains(seed); });
}

}  // namespace hedgehop::sim
