#include "sim/cli/fly_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "sim/batch/flight_table.h"
#include "sim/batch/junit.h"
#include "sim/cli/every_write.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/config/folder_lock.h"
#include "sim/config/input_error.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/build.h"
#include "sim/flight/words.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/leaderboard_page.h"
#include "sim/pages/report_page.h"

namespace hedgehop::sim::cli {
namespace {

/// Returns the results of a batch that may have stopped early, without the flights past the stop of their group.
BatchOutcome conclude(std::vector<FlightRecord> records, const std::optional<SequentialCount>& count, double limit_s) {
  BatchOutcome outcome{.records = std::move(records)};
  if (!count) return outcome;
  std::erase_if(outcome.records, [&](const FlightRecord& record) { return count->discarded(record.order); });
  outcome.sequential = count->results();
  for (SequentialResult& result : outcome.sequential) {
    if (limit_s > 0.0) result.words += "; flights over --limit count against it, so the machine's speed enters";
  }
  return outcome;
}

std::vector<GroupVerdict> all_verdicts(const BatchOutcome& outcome) {
  std::vector<GroupVerdict> verdicts = outcome.verdicts;
  for (const SequentialResult& result : outcome.sequential) verdicts.push_back(verdict_of(result));
  return verdicts;
}

/// Which flights a stopping rule has counted, as a column.
std::vector<Table::Column> counted_column(const BatchOutcome& outcome, const std::optional<SequentialCount>& count) {
  if (!count) return {};
  std::vector<double> counted;
  for (const FlightRecord& record : outcome.records) counted.push_back(count->counted(record.order) ? 1.0 : 0.0);
  return {{.name = "counted", .values = std::move(counted), .whole = true}};
}

/// Returns the kept files of the failed flights, the report page first.
Attachments attachments_of(const std::vector<FlightRecord>& records, const BatchRun& run) {
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kFiles = {{{"report", "report.html"},
                                                                               {"film", "video.webm"},
                                                                               {"replay", "replay.html"},
                                                                               {"csv", "trajectory.csv"},
                                                                               {"csv", "decisions.csv"}}};
  const auto whole = [](const std::filesystem::path& p) { return std::filesystem::absolute(p).lexically_normal(); };
  Attachments attachments;
  for (const FlightRecord& record : records) {
    if (!record.result || holds(verdict_of(record))) continue;
    for (const auto& [artifact, file] : kFiles) {
      const std::filesystem::path path = whole(run.fly.out / record.order.id / file);
      if (std::ranges::find(run.fly.keep, artifact) == run.fly.keep.end() || !std::filesystem::exists(path)) continue;
      attachments[record.order.id].push_back(path.lexically_relative(whole(run.junit).parent_path()).string());
    }
  }
  return attachments;
}

EveryWrite write_files(const BatchRun& run, const BatchOutcome& outcome, const std::vector<Table::Column>& columns,
                       const JUnitOrigin& origin) {
  const std::filesystem::path& out = run.fly.out;
  EveryWrite files;
  const auto attempt = [&files](const std::filesystem::path& file, const std::string& text) {
    files.attempt([&] {
      if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
      write_file_whole(file, text);
    });
  };
  attempt(out / "batch.json", batch_json(outcome, std::string(version())));
  attempt(out / "batch.csv", flight_table(outcome.records, columns).csv());
  if (run.junit.empty()) return files;
  const Attachments attachments = attachments_of(outcome.records, run);
  attempt(run.junit, junit_text(outcome.records, all_verdicts(outcome), origin, attachments));
  return files;
}

/// Writes the leaderboard's matrix. @param again  the flights are an earlier batch's, and so is its leaderboard.
/// @return its text; empty without a leaderboard.
std::string write_matrix(const std::filesystem::path& out, const std::optional<Leaderboard>& board, bool again) {
  if (board) {
    write_leaderboard(out, *board);
  } else if (!again) {
    forget_leaderboard(out);
  }
  const nlohmann::ordered_json data = leaderboard_data(out, read_flights(out));
  if (data.is_null()) return "";
  const std::string text = leaderboard_text(data);
  write_file_whole(out / "leaderboard.md", text);
  return "\n" + text;
}

int exit_status(Standing verdict) {
  switch (verdict) {
    case Standing::shown:
      return 0;
    case Standing::undecided:
      return kUndecided;
    case Standing::refuted:
      break;
  }
  return kFails;
}

void show(CampaignProgress& progress, const EndedFlight& ended, bool passed) {
  const Verdict verdict = verdict_of(ended.record);
  const std::string outcome = shown_outcome(ended.record);
  const std::string words = verdict == Verdict::unchecked ? fmt::format("{}, {}", outcome, kNoChecks)
                            : verdict == Verdict::passed  ? fmt::format("passed, {}", outcome)
                                                          : failure_words(ended.record);
  progress.add(ended.record.order.id, words, passed, ended.reused);
}

/// Flies the orders, each group until the stopping rule has decided it.
std::vector<FlightRecord> fly(const BatchRun& run, std::optional<SequentialCount>& count, Interruption& interruption) {
  const std::vector<Order>& orders = run.batch.orders;
  CampaignProgress progress(orders.size());
  OrderFlights flights(orders, run.fly, run.reuse, interruption);
  while (const std::optional<EndedFlight> ended = flights.next()) {
    show(progress, *ended, holds(verdict_of(ended->record)));
    if (!count || !count->ended(ended->record)) continue;
    for (const Order& order : orders) {
      if (count->discarded(order)) flights.drop(order);
    }
  }
  progress.close();
  return flights.take_records();
}

/// Warns of flights that missed a goal that no check requires.
void warn_of_missed_goals(const std::vector<FlightRecord>& records) {
  const auto missed = [](const FlightRecord& r) { return r.result && r.result->flight.goal_missed_unchecked; };
  const auto first = std::ranges::find_if(records, missed);
  if (first == records.end()) return;
  notice(fmt::format("warning: {} of {} flights {}; the first: {}\n", std::ranges::count_if(records, missed),
                     records.size(), kGoalMissedUnchecked, first->order.id));
}

}  // namespace

void write_junit(const std::filesystem::path& file, const std::string& text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_file_whole(file, text);
}

int reporting_bad_input(const std::filesystem::path& junit, const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& error) {
    try {
      if (!junit.empty()) write_junit(junit, junit_of_bad_input(error.errors(), junit_origin()));
    } catch (const std::exception&) {  // one line suffices, and the fault below comes first
    }
    throw;
  }
}

void print_failed(const std::vector<FlightRecord>& records) {
  for (const FlightRecord& record : records) {
    if (record.status != FlightRecord::Status::failed) continue;
    fmt::print("FAIL  {}: {}\n      {}\n", record.order.id, record.cause, rerun_command(record.order));
  }
}

void write_campaign_page(const std::filesystem::path& folder, bool quiet) {
  const std::string page = (folder / "report.html").string();
  try {
    write_campaign_report(folder, std::nullopt);
    if (!quiet) fmt::print("written: {}\n", page);
  } catch (const PagesAbsent& absent) {
    notice(fmt::format("{}: not written: {}\n", page, absent.what()));
  }
}

std::vector<FlightRecord> fly_shown(const std::vector<Order>& orders, const FlyOptions& options,
                                    Interruption& interruption, CampaignProgress& progress) {
  OrderFlights flights(orders, options, Reuse::all, interruption);
  while (const std::optional<EndedFlight> ended = flights.next()) {
    show(progress, *ended, verdict_of(ended->record) != Verdict::not_flown);
  }
  return flights.take_records();
}

int fly_batch(BatchRun run) {
  require_writable(run.fly.out);
  const FolderLock lock(run.fly.out);
  if (!run.junit.empty()) require_writable_file(run.junit);
  for (const std::string& fault : run.batch.faults) notice(fmt::format("{}\n", fault));
  for (const std::string& line : run.batch.left_out) notice(fmt::format("{}\n", line));
  const JUnitOrigin origin = junit_origin();
  std::optional<SequentialCount> count;
  if (run.rule) {
    run.batch.orders = seed_by_seed(run.batch.orders);
    count.emplace(*run.rule, run.batch.orders);
  }
  Interruption interruption;
  BatchOutcome outcome = conclude(fly(run, count, interruption), count, run.fly.limit_s);
  outcome.conduct = run.conduct;
  if (interruption.signal() == 0) {
    outcome.verdicts = judge(run.batch.checks, summarize(without_refused(outcome.records)));
  }
  EveryWrite files = write_files(run, outcome, counted_column(outcome, count), origin);
  std::string matrix;
  if (files.well()) files.attempt([&] { matrix = write_matrix(run.fly.out, run.batch.leaderboard, run.again); });
  if (run.json) {
    fmt::print("{}", batch_json(outcome, std::string(version())));
  } else {
    fmt::print("{}{}", summary_text(outcome), matrix);
  }
  files.raise();
  if (!run.json) fmt::print("written: {}\n", (run.fly.out / "batch.json").string());
  warn_of_missed_goals(outcome.records);
  if (run.page) write_campaign_page(run.fly.out, /*quiet=*/run.json);
  if (interruption.signal() != 0) return kSignalled + interruption.signal();
  if (!run.batch.faults.empty()) return kBadInput;
  return exit_status(verdict_of(outcome));
}

}  // namespace hedgehop::sim::cli
