#include "sim/falsify/ddmin.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

namespace hedgehop::sim {
namespace {

/// Returns the items in `parts` parts of nearly equal size.
std::vector<Subset> split(const Subset& items, size_t parts) {
  std::vector<Subset> chunks;
  for (size_t i = 0; i < parts; ++i) {
    const auto at = [&](size_t k) { return items.begin() + static_cast<std::ptrdiff_t>(items.size() * k / parts); };
    chunks.emplace_back(at(i), at(i + 1));
  }
  return chunks;
}

Subset without(const Subset& items, const Subset& chunk) {
  Subset rest;
  std::ranges::set_difference(items, chunk, std::back_inserter(rest));
  return rest;
}

}  // namespace

Subset ddmin(size_t count, const std::function<bool(const Subset&)>& fails) {
  std::map<Subset, bool> known;
  const auto test = [&](const Subset& items) {
    const auto [entry, is_new] = known.try_emplace(items, false);
    if (is_new) entry->second = fails(items);
    return entry->second;
  };
  Subset items(count);
  std::iota(items.begin(), items.end(), size_t{0});
  for (size_t parts = 2; items.size() >= 2;) {
    const std::vector<Subset> chunks = split(items, parts);
    const auto chunk = std::ranges::find_if(chunks, test);
    if (chunk != chunks.end()) {  // reduce to a subset
      items = *chunk;
      parts = 2;
      continue;
    }
    const auto rest =
        std::ranges::find_if(chunks, [&](const Subset& left_out) { return test(without(items, left_out)); });
    if (rest != chunks.end()) {  // reduce to a complement
      items = without(items, *rest);
      parts = std::max<size_t>(parts - 1, 2);
      continue;
    }
    if (parts == items.size()) break;
    parts = std::min(items.size(), 2 * parts);  // finer
  }
  const bool empty_fails = items.size() == 1 && test({});
  return empty_fails ? Subset{} : items;
}

}  // namespace hedgehop::sim
