#include "sim/batch/group_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/fields/order_statistics.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

/// null of result.json is "nothing near": as far as can be.
double number_or_infinity(const nlohmann::ordered_json& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::infinity();
}

Count earlier_count(const std::string& batch_json, const std::string& group) {
  try {
    const auto batch = nlohmann::ordered_json::parse(read_file_whole(batch_json));
    Count count;
    for (const auto& flight : batch.at("flights")) {
      if (flight.at("group") != group || flight.at("status") == "missing" || flight.at("passed").is_null()) continue;
      ++count.trials;
      count.successes += flight.at("passed").get<bool>() ? 1 : 0;
    }
    return count;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: no record of a batch: {}", batch_json, error.what()));
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
}

GroupVerdict judge(const SuccessRateCheck& check, const GroupSummary& group) {
  const Interval interval = wilson_interval(group.success, check.confidence);
  const std::string words =
      fmt::format("{} of {} passed; the rate's {:g} % interval {:.3f} to {:.3f} must begin at {:g} or above",
                  group.success.successes, group.success.trials, 100.0 * check.confidence, interval.low, interval.high,
                  check.at_least);
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
        fmt::format("nothing to compare: {} flights now, {} in {}", group.success.trials, before.trials, check.than);
    return verdict;
  }
  const std::string counts = fmt::format("{} of {} passed, {} of {} before", group.success.successes,
                                         group.success.trials, before.successes, before.trials);
  if (check.margin) {
    // One-sided: the lower end of the two-sided interval whose two tails are this wide each.
    verdict.value = newcombe_difference(group.success, before, 2.0 * check.confidence - 1.0).low;
    verdict.limit = -*check.margin;
    verdict.passed = verdict.value >= verdict.limit;
    verdict.words = fmt::format("{}; with {:g} % confidence the rate changed by {:+.3f} or better, asked {:+g}", counts,
                                100.0 * check.confidence, verdict.value, verdict.limit);
  } else {
    verdict.value = fisher_lower_tail(group.success, before);
    verdict.limit = 1.0 - check.confidence;
    verdict.passed = verdict.value >= verdict.limit;
    verdict.words = fmt::format("{}; chance alone does as badly with probability {:.3f}, {}", counts, verdict.value,
                                verdict.passed ? "which shows no loss" : "so it has become worse");
  }
  return verdict;
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
    ++group->flights;
    const std::string outcome = outcome_words(record);
    group->reached += outcome == "reached" ? 1 : 0;
    group->collided += outcome == "collided" ? 1 : 0;
    group->timeout += outcome == "timeout" ? 1 : 0;
    group->fault += outcome == "fault" ? 1 : 0;
    group->failed += outcome == "failed" ? 1 : 0;
    group->missing += outcome == "missing" ? 1 : 0;
    group->unchecked += unchecked(record) ? 1 : 0;
    group->success.trials += outcome == "missing" || unchecked(record) ? 0 : 1;
    group->success.successes += passed(record) ? 1 : 0;
    if (record.status != FlightRecord::Status::flown) continue;
    clearances[index].push_back(number_or_infinity(record.result.at("min_obstacle_clearance_m")));
    times[index].push_back(record.result.at("flight_time_s").get<double>());
  }
  for (size_t i = 0; i < groups.size(); ++i) {
    groups[i].least_clearance_m = clearances[i].empty() ? std::nan("") : std::ranges::min(clearances[i]);
    groups[i].median_clearance_m = median(clearances[i]);
    groups[i].median_time_s = median(times[i]);
  }
  return groups;
}

void require_decidable(const std::vector<CampaignCheck>& checks, const std::vector<GroupSummary>& groups) {
  const auto shows = [](int64_t flights, const SuccessRateCheck& check) {
    return wilson_interval({flights, flights}, check.confidence).low >= check.at_least;
  };
  std::vector<std::string> faults;
  for (const CampaignCheck& any : checks) {
    const auto* check = std::get_if<SuccessRateCheck>(&any);
    if (!check) continue;
    int64_t needed = 1;
    while (!shows(needed, *check)) ++needed;
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

}  // namespace hedgehop::sim
