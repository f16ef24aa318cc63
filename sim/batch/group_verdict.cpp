#include "sim/batch/group_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/config/input_error.h"
#include "sim/fields/order_statistics.h"
#include "sim/flight/words.h"
#include "sim/libm/random.h"

namespace hedgehop::sim {
namespace {

Count earlier_count(const std::string& batch_json, const std::string& group) {
  try {
    const nlohmann::ordered_json batch = read_batch_json(batch_json);
    Count count;
    for (const auto& flight : batch.at("flights")) {
      if (flight.at("group") != group || flight.at("status") == "missing" || flight.at("passed").is_null()) continue;
      if (is_refused({.id = flight.value("id", "")})) continue;
      ++count.trials;
      count.successes += flight.at("passed").get<bool>() ? 1 : 0;
    }
    return count;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(json_fault(batch_json, error, kRecordOfBatch));
  }
}

GroupVerdict judge(const SuccessRateCheck& check, const GroupSummary& group) {
  const Interval interval = wilson_interval(group.success, check.confidence);
  const std::string words = fmt::format("{} of {} passed; lower bound of the {:g} % interval {}; required: >= {}",
                                        group.success.successes, group.success.trials, 100.0 * check.confidence,
                                        distinct_decimals(interval.low, check.at_least), check.at_least);
  return {
      group.group, std::string(SuccessRateCheck::kName), interval.low >= check.at_least, interval.low, check.at_least,
      words};
}

GroupVerdict judge(const NoWorseCheck& check, const GroupSummary& group) {
  GroupVerdict verdict{.group = group.group, .check = std::string(NoWorseCheck::kName)};
  const Count before = earlier_count(check.than, group.group);
  if (before.trials == 0 || group.success.trials == 0) {
    verdict.value = verdict.limit = std::nan("");
    verdict.words =
        fmt::format("no flights to compare: {} now, {} in {}", group.success.trials, before.trials, check.than);
    return verdict;
  }
  const std::string counts = fmt::format("{} of {} passed, {} of {} before", group.success.successes,
                                         group.success.trials, before.successes, before.trials);
  if (check.margin) {
    // One-sided: the lower end of the two-sided interval whose two tails are this wide each.
    verdict.value = newcombe_difference(group.success, before, 2.0 * check.confidence - 1.0).low;
    verdict.limit = -*check.margin;
    verdict.passed = verdict.value >= verdict.limit;
    verdict.words =
        fmt::format("{}; with {:g} % confidence the rate changed by {} or better; required: {}", counts,
                    100.0 * check.confidence, distinct_decimals(verdict.value, verdict.limit), verdict.limit);
  } else {
    verdict.value = fisher_lower_tail(group.success, before);
    verdict.limit = 1.0 - check.confidence;
    verdict.passed = verdict.value >= verdict.limit;
    verdict.words =
        fmt::format("{}; chance alone does as badly with probability {}, {}", counts,
                    distinct_decimals(verdict.value, verdict.limit),
                    verdict.passed ? "so a loss is not shown; 'margin' can rule one out" : "so it has become worse");
  }
  return verdict;
}

void count(const FlightRecord& record, GroupSummary& group) {
  ++group.flights;
  if (record.status == FlightRecord::Status::missing) {
    ++group.missing;
    return;
  }
  const Verdict verdict = verdict_of(record);
  group.failed += verdict == Verdict::not_flown ? 1 : 0;
  group.unchecked += verdict == Verdict::unchecked ? 1 : 0;
  group.success.trials += verdict == Verdict::unchecked || is_refused(record.order) ? 0 : 1;
  group.success.successes += verdict == Verdict::passed ? 1 : 0;
  if (!record.result) return;
  const Outcome outcome = record.result->flight.outcome;
  group.reached += outcome == Outcome::reached ? 1 : 0;
  group.collided += outcome == Outcome::collided ? 1 : 0;
  group.timeout += outcome == Outcome::timeout ? 1 : 0;
  group.completed += outcome == Outcome::timeout && !record.result->flight.goal_distance_m ? 1 : 0;
  group.fault += verdict == Verdict::fault ? 1 : 0;
}

}  // namespace

std::vector<GroupSummary> summarize(const std::vector<FlightRecord>& records) {
  std::vector<GroupSummary> groups;
  std::vector<std::vector<double>> clearances, times;
  for (const FlightRecord& record : records) {
    auto group = std::ranges::find(groups, record.order.group, &GroupSummary::group);
    if (group == groups.end()) {
      group = groups.insert(groups.end(), GroupSummary{.group = record.order.group});
      clearances.emplace_back();
      times.emplace_back();
    }
    const auto index = static_cast<size_t>(group - groups.begin());
    count(record, *group);
    if (!record.result) continue;
    clearances[index].push_back(record.result->flight.closest_obstacle.distance_m);
    times[index].push_back(record.result->flight.flight_time_s);
  }
  for (size_t i = 0; i < groups.size(); ++i) {
    groups[i].min_clearance_m = clearances[i].empty() ? std::nan("") : std::ranges::min(clearances[i]);
    groups[i].median_clearance_m = median(clearances[i]);
    groups[i].median_time_s = median(times[i]);
  }
  return groups;
}

int64_t flights_to_show(double rate, double confidence) {
  const auto shows = [&](int64_t flights) { return wilson_interval({flights, flights}, confidence).low >= rate; };
  const double z = normal_quantile(0.5 + 0.5 * confidence);
  const auto flights = std::max<int64_t>(1, static_cast<int64_t>(std::ceil(rate * z * z / (1.0 - rate))));
  // The closed form and the interval round differently: by one flight at most.
  if (!shows(flights)) return flights + 1;
  return flights > 1 && shows(flights - 1) ? flights - 1 : flights;
}

void require_decidable(const std::vector<CampaignCheck>& checks, const std::vector<GroupSummary>& groups) {
  std::vector<std::string> faults;
  for (const CampaignCheck& any : checks) {
    const auto* check = std::get_if<SuccessRateCheck>(&any);
    if (!check) continue;
    if (check->at_least >= 1.0) {
      faults.push_back(
          "success_rate: a rate of 1 cannot be shown: every future flight would have to pass, and no finite number of "
          "flights shows that; require a rate below 1, such as 0.99");
      continue;
    }
    const int64_t needed = flights_to_show(check->at_least, check->confidence);
    for (const GroupSummary& group : groups) {
      if (group.flights >= needed) continue;
      faults.push_back(
          fmt::format("{}: {} of {} flights that pass cannot show a rate of {:g} with {:g} % confidence; it takes {}",
                      group.group, group.flights, group.flights, check->at_least, 100.0 * check->confidence, needed));
    }
  }
  if (!faults.empty()) throw InputError(faults);
}

std::vector<GroupVerdict> judge(const std::vector<CampaignCheck>& checks, const std::vector<GroupSummary>& groups) {
  std::vector<GroupVerdict> verdicts;
  for (const CampaignCheck& check : checks) {
    for (const GroupSummary& group : groups) {
      verdicts.push_back(std::visit([&](const auto& c) { return judge(c, group); }, check));
    }
  }
  return verdicts;
}

void require_decidable(const BatchOrders& batch) {
  std::vector<FlightRecord> planned;
  for (const Order& order : batch.orders) {
    if (order.fault.empty())
      planned.push_back({.order = order, .status = FlightRecord::Status::missing, .cause = {}, .result = {}});
  }
  const std::vector<GroupSummary> groups = summarize(planned);
  judge(batch.checks, groups);  // throws if an earlier batch cannot be read
  require_decidable(batch.checks, groups);
}

}  // namespace hedgehop::sim
