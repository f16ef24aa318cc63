#include "sim/cli/fly_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "sim/batch/flight_table.h"
#include "sim/batch/junit.h"
#include "sim/cli/campaign_page.h"
#include "sim/cli/every_write.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/notice.h"
#include "sim/cli/progress.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/build.h"
#include "sim/pages/leaderboard_page.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

/// The results of a batch that may have stopped early: what lies past a group's stop is left out.
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
std::vector<ExtraColumn> counted_column(const BatchOutcome& outcome, const std::optional<SequentialCount>& count) {
  if (!count) return {};
  ExtraColumn column{.name = "counted", .cells = {}};
  for (const FlightRecord& record : outcome.records) {
    column.cells.emplace_back(static_cast<int64_t>(count->counted(record.order)));
  }
  return {column};
}

EveryWrite write_files(const std::filesystem::path& out, const std::filesystem::path& junit,
                       const BatchOutcome& outcome, const std::vector<ExtraColumn>& columns) {
  EveryWrite files;
  const auto attempt = [&files](const std::filesystem::path& file, const std::string& text) {
    files.attempt([&] {
      if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
      write_file_whole(file, text);
    });
  };
  attempt(out / "batch.json", batch_json(outcome, std::string(version())));
  attempt(out / "batch.csv", csv_text(flight_table(outcome.records, columns)));
  if (!junit.empty()) attempt(junit, junit_text(outcome.records, all_verdicts(outcome)));
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

int exit_status(const BatchOutcome& outcome) {
  const auto any = [&](Standing standing) {
    return std::ranges::find(outcome.sequential, standing, &SequentialResult::standing) != outcome.sequential.end();
  };
  if (any(Standing::refuted)) return kFails;
  if (any(Standing::undecided)) return kUndecided;
  if (!outcome.sequential.empty()) return 0;
  if (!outcome.verdicts.empty()) return std::ranges::all_of(outcome.verdicts, &GroupVerdict::passed) ? 0 : kFails;
  const auto holds = [](const FlightRecord& r) { return passed(r) || unchecked(r); };
  return std::ranges::all_of(outcome.records, holds) ? 0 : kFails;
}

OnRecord show_on(CampaignProgress& progress, std::optional<SequentialCount>& count) {
  return [&](const FlightRecord& record, bool reused) {
    if (count) count->ended(record);
    const bool ok = passed(record) || unchecked(record);
    const std::string words = unchecked(record) ? fmt::format("{}, {}", outcome_words(record), kNoChecks)
                              : ok              ? outcome_words(record)
                                                : failure_words(record);
    progress.add(record.order.id, words, ok, reused);
  };
}

}  // namespace

int fly_batch(BatchRun run) {
  require_writable(run.fly.out);
  if (!run.junit.empty()) require_writable_file(run.junit);
  for (const std::string& fault : run.batch.faults) notice(fmt::format("{}\n", fault));
  std::optional<SequentialCount> count;
  if (run.rule) {
    run.batch.orders = seed_by_seed(run.batch.orders);
    count.emplace(*run.rule, run.batch.orders);
    run.fly.wanted = [&count](const Order& order) { return count->wanted(order); };
  }
  Interruption interruption;
  CampaignProgress progress(run.batch.orders.size());
  auto records = fly_orders(run.batch.orders, run.fly, run.reuse, interruption, show_on(progress, count));
  progress.close();

  BatchOutcome outcome = conclude(std::move(records), count, run.fly.limit_s);
  outcome.conduct = run.conduct;
  if (interruption.signal() == 0) outcome.verdicts = judge(run.batch.checks, summarize(outcome.records));
  EveryWrite files = write_files(run.fly.out, run.junit, outcome, counted_column(outcome, count));
  std::string matrix;
  if (files.well()) files.attempt([&] { matrix = write_matrix(run.fly.out, run.batch.leaderboard, run.again); });
  if (run.json) {
    fmt::print("{}", batch_json(outcome, std::string(version())));
  } else {
    fmt::print("{}{}", summary_text(outcome), matrix);
  }
  files.raise();
  if (!run.json) {
    fmt::print("written: {}\n", (run.fly.out / "batch.json").string());
    write_campaign_page(run.fly.out);
  }
  if (interruption.signal() != 0) return kSignalled + interruption.signal();
  if (!run.batch.faults.empty()) return kBadInput;
  return exit_status(outcome);
}

}  // namespace hedgehop::sim::cli
