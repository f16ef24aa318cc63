#include "sim/evidence/batch_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/batch/statistics.h"
#include "sim/config/utf8.h"
#include "sim/evidence/anytime_valid.h"
#include "sim/flight/build.h"
#include "sim/flight/json_reader.h"
#include "sim/flight/words.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

Json group_json(const GroupSummary& group, const BatchOutcome& outcome) {
  const Interval interval = success_interval(group.success, !outcome.sequential.empty());
  return Json{{"group", group.group},
              {"flights", group.flights},
              {"passed", group.success.successes},
              {"ended", group.success.trials},
              {"success_rate", group.success.trials > 0 ? Json(group.success.rate()) : Json(nullptr)},
              {"success_rate_95", {interval.low, interval.high}},
              {"success_rate_method", outcome.interval_method()},
              {"reached", group.reached},
              {"collided", group.collided},
              {"timeout", group.timeout},
              {"fault", group.fault},
              {"failed", group.failed},
              {"missing", group.missing},
              {"no_checks", group.unchecked},
              {"min_clearance_m", json_number(group.min_clearance_m)},
              {"median_clearance_m", json_number(group.median_clearance_m)},
              {"median_time_s", json_number(group.median_time_s)}};
}

Json flight_json(const FlightRecord& record) {
  const Verdict verdict = verdict_of(record);
  const bool open = verdict == Verdict::unchecked || record.status == FlightRecord::Status::missing;
  Json overrides = Json::array();
  for (const std::string& text : record.order.overrides) overrides.push_back(name_text(text));
  return Json{{"id", record.order.id},
              {"group", record.order.group},
              {"scenario", name_text(record.order.scenario.string())},
              {"seed", record.order.seed},
              {"set", std::move(overrides)},
              {"status", std::string(to_string(record.status))},
              {"passed", open ? Json(nullptr) : Json(verdict == Verdict::passed)},
              {"cause", record.cause},
              {"command", rerun_command(record.order)},
              {"result", record.result ? to_json(record.result->info, record.result->flight) : Json(nullptr)}};
}

/// Returns a number of a group with some decimals; "-" if no flight has it, "no obstacle" for an infinite clearance.
std::string group_figure(double value, int count) {
  if (std::isnan(value)) return "-";
  return std::isinf(value) ? "no obstacle" : decimals(value, count);
}

std::string group_line(const GroupSummary& g, const BatchOutcome& outcome) {
  const Interval interval = success_interval(g.success, !outcome.sequential.empty());
  std::string success = fmt::format("{} | {:.2f} to {:.2f}", g.success.successes, interval.low, interval.high);
  if (g.success.trials == 0) {
    success = g.unchecked > 0 ? fmt::format("{} | -", kNoChecks) : "0 | -";
  } else if (g.unchecked > 0) {
    success += fmt::format("; {} of {}", kNoChecks, g.unchecked);
  }
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", markdown_cell(g.group),
                     g.flights, success, g.reached, g.completed, g.collided, g.timeout - g.completed,
                     g.fault + g.failed, g.missing, group_figure(g.min_clearance_m, 2),
                     group_figure(g.median_clearance_m, 2), group_figure(g.median_time_s, 0));
}

}  // namespace

Interval success_interval(Count success, bool anytime) {
  return anytime ? anytime_interval(success, kTableConfidence) : wilson_interval(success, kTableConfidence);
}

std::string BatchOutcome::interval_method() const { return sequential.empty() ? "wilson" : "anytime"; }

Standing verdict_of(const BatchOutcome& outcome) {
  const auto shown = [](bool all) { return all ? Standing::shown : Standing::refuted; };
  if (!outcome.sequential.empty()) {
    const auto any = [&](Standing standing) {
      return std::ranges::find(outcome.sequential, standing, &SequentialResult::standing) != outcome.sequential.end();
    };
    if (any(Standing::refuted)) return Standing::refuted;
    return any(Standing::undecided) ? Standing::undecided : Standing::shown;
  }
  if (!outcome.verdicts.empty()) return shown(std::ranges::all_of(outcome.verdicts, &GroupVerdict::passed));
  return shown(std::ranges::all_of(outcome.records, [](const FlightRecord& r) { return holds(verdict_of(r)); }));
}

std::string batch_json(const BatchOutcome& outcome, const std::string& version) {
  Json json{{"version", version},
            {"build", std::string(build_identity())},
            {"conduct", to_json(outcome.conduct)},
            {"groups", Json::array()},
            {"verdicts", Json::array()},
            {"sequential", Json::array()},
            {"flights", Json::array()}};
  for (const GroupSummary& group : summarize(outcome.records)) json["groups"].push_back(group_json(group, outcome));
  for (const GroupVerdict& verdict : outcome.verdicts) {
    json["verdicts"].push_back(Json{{"group", verdict.group},
                                    {"check", verdict.check},
                                    {"passed", verdict.passed},
                                    {"value", json_number(verdict.value)},
                                    {"limit", json_number(verdict.limit)},
                                    {"words", verdict.words}});
  }
  for (const SequentialResult& result : outcome.sequential) json["sequential"].push_back(to_json(result));
  for (const FlightRecord& record : outcome.records) json["flights"].push_back(flight_json(record));
  return json_text(json, 1) + "\n";
}

std::string summary_text(const BatchOutcome& outcome) {
  const std::vector<FlightRecord>& records = outcome.records;
  std::string text =
      mixture_words(records) + truth_words(records) +
      fmt::format(
          "| scenario | flights | passed | 95 % interval{} | reached | completed | collided | timeout | fault | "
          "missing | minimum clearance, m | median minimum clearance, m | median time, s "
          "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
          outcome.sequential.empty() ? "" : " at any time");
  for (const GroupSummary& group : summarize(records)) text += group_line(group, outcome);
  for (const FlightRecord& record : records) {
    if (record.status == FlightRecord::Status::missing || holds(verdict_of(record))) continue;
    text +=
        fmt::format("FAIL  {}: {}\n      {}\n", record.order.id, failure_words(record), rerun_command(record.order));
  }
  for (const GroupVerdict& verdict : outcome.verdicts) {
    text +=
        fmt::format("{}  {} {}: {}\n", verdict.passed ? "pass" : "FAIL", verdict.check, verdict.group, verdict.words);
  }
  for (const SequentialResult& result : outcome.sequential) {
    const bool open = result.standing == Standing::undecided;
    const std::string_view word = result.standing == Standing::shown ? "pass" : open ? "open" : "FAIL";
    text += fmt::format("{}  {} {}: {}\n", word, result.claim, result.group, result.words);
  }
  return text;
}

std::string failure_words(const FlightRecord& record) {
  const Verdict verdict = verdict_of(record);
  if (verdict == Verdict::passed) return "";
  if (verdict == Verdict::unchecked) return std::string(kNoChecks);
  if (verdict == Verdict::not_flown) return record.cause;
  const FlightResult& result = record.result->flight;
  std::string words = shown_outcome(record);
  if (!result.cause.empty()) words += " (" + result.cause + ")";
  for (const CheckResult& check : result.checks) {
    if (check.passed) continue;
    const std::string failure = check.name + " " + check_words(check);
    if (failure == result.cause) continue;
    CheckResult figures = check;
    figures.cause.clear();
    words += "; " + check.name + " " + check_words(figures) + (check.cause.empty() ? "" : " (" + check.cause + ")");
  }
  return words;
}

}  // namespace hedgehop::sim
