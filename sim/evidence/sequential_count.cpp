#include "sim/evidence/sequential_count.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace hedgehop::sim {
namespace {

std::variant<RateTally, PairTally> tally_of(const StoppingRule& rule) {
  if (const auto* rate = std::get_if<RateClaim>(&rule.claim)) return RateTally(*rate, rule.confidence);
  return PairTally(std::get<PairClaim>(rule.claim), rule.confidence);
}

double bound_of(const StoppingRule& rule) {
  if (const auto* rate = std::get_if<RateClaim>(&rule.claim)) return rate->bound;
  return -std::get<PairClaim>(rule.claim).margin.value_or(0.0);
}

}  // namespace

nlohmann::ordered_json to_json(const SequentialResult& result) {
  nlohmann::ordered_json json{{"group", result.group},
                              {"rule", result.claim},
                              {"verdict", std::string(to_string(result.standing))},
                              {"confidence", result.confidence},
                              {"alpha", 1.0 - result.confidence},
                              {"order", "by seed"},
                              {"planned", result.planned}};
  json.update(result.figures);
  json["stopped_at"] = result.last_seed ? nlohmann::ordered_json(*result.last_seed) : nlohmann::ordered_json(nullptr);
  json["discarded"] = result.standing == Standing::undecided ? 0 : result.planned - result.counted;
  json["words"] = result.words;
  return json;
}

GroupVerdict verdict_of(const SequentialResult& result) {
  return {result.group, "until " + result.claim, result.standing == Standing::shown, result.value, result.bound,
          result.words};
}

SequentialCount::SequentialCount(StoppingRule rule, const std::vector<Order>& orders) : rule_(std::move(rule)) {
  const bool pairs = std::holds_alternative<PairClaim>(rule_.claim);
  for (const Order& order : orders) {
    if (is_refused(order)) continue;
    Group& group = group_named(pairs ? "candidate against base" : order.group);
    const bool second = pairs && !group.seeds.empty() && group.seeds.back() == order.seed;
    if (!second) {
      group.seeds.push_back(order.seed);
      group.observed.emplace_back(pairs ? 2 : 1);
    }
    const auto index = static_cast<size_t>(&group - groups_.data());
    slots_[order.id] = {index, group.seeds.size() - 1, second ? 1u : 0u};
  }
}

SequentialCount::Group& SequentialCount::group_named(const std::string& name) {
  const auto known = std::ranges::find(groups_, name, &Group::name);
  if (known != groups_.end()) return *known;
  return groups_.emplace_back(Group{.name = name, .tally = tally_of(rule_), .seeds = {}, .observed = {}});
}

const SequentialCount::FlightSlot* SequentialCount::slot_of(const Order& order) const {
  return is_refused(order) ? nullptr : &slots_.at(order.id);
}

bool SequentialCount::ended(const FlightRecord& record) {
  const FlightSlot* const slot = slot_of(record.order);
  if (!slot) return false;
  Group& group = groups_[slot->group];
  group.observed[slot->unit][slot->member] =
      std::visit([&](const auto& tally) { return tally.observe(record); }, group.tally);
  const bool was_undecided = group.standing == Standing::undecided;
  advance(group);
  return was_undecided && group.standing != Standing::undecided;
}

void SequentialCount::advance(Group& group) {
  const auto complete = [](const auto& unit) {
    return std::ranges::all_of(unit, [](auto& x) { return x.has_value(); });
  };
  while (group.standing == Standing::undecided && group.next < group.observed.size() &&
         complete(group.observed[group.next])) {
    const auto& unit = group.observed[group.next++];
    if (auto* rate = std::get_if<RateTally>(&group.tally)) {
      rate->count(*unit[0]);
      group.standing = rate->standing();
    } else {
      PairTally& pairs = std::get<PairTally>(group.tally);
      pairs.count(std::vector{*unit[0], *unit[1]});
      group.standing = pairs.standing();
    }
  }
}

bool SequentialCount::counted(const Order& order) const {
  const FlightSlot* const slot = slot_of(order);
  return slot && slot->unit < groups_[slot->group].next;
}

bool SequentialCount::discarded(const Order& order) const {
  const FlightSlot* const slot = slot_of(order);
  return slot && groups_[slot->group].standing != Standing::undecided && !counted(order);
}

SequentialResult SequentialCount::result_of(const Group& group) const {
  SequentialResult result{.group = group.name, .claim = rule_.text(), .standing = group.standing};
  result.confidence = rule_.confidence;
  result.planned = static_cast<int64_t>(group.observed.size());
  result.counted = static_cast<int64_t>(group.next);
  if (group.next > 0) result.last_seed = group.seeds[group.next - 1];
  result.bound = bound_of(rule_);
  std::visit(
      [&](const auto& tally) {
        result.figures = tally.figures();
        result.value = tally.value();
        result.words = fmt::format("{}: {}", to_string(group.standing), tally.words());
      },
      group.tally);
  if (group.standing == Standing::undecided) {
    const bool all = result.counted == result.planned;
    result.words += all ? "; more seeds may be added, with --resume" : "; interrupted before the last seed";
  } else if (result.counted < result.planned) {
    result.words += fmt::format("; flights past seed {} do not count", *result.last_seed);
  }
  return result;
}

std::vector<SequentialResult> SequentialCount::results() const {
  std::vector<SequentialResult> results;
  for (const Group& group : groups_) results.push_back(result_of(group));
  return results;
}

std::vector<Order> seed_by_seed(const std::vector<Order>& orders) {
  std::map<std::string, size_t> flights_of;
  std::vector<std::pair<size_t, const Order*>> ranked;
  for (const Order& order : orders) ranked.emplace_back(flights_of[order.group]++, &order);
  std::ranges::stable_sort(ranked, {}, [](const auto& r) { return r.first; });
  std::vector<Order> sorted;
  for (const auto& [rank, order] : ranked) sorted.push_back(*order);
  return sorted;
}

}  // namespace hedgehop::sim
