#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "sim/campaign/batch_record.h"
#include "sim/campaign/fly_orders.h"
#include "sim/campaign/junit.h"
#include "sim/campaign/leaderboard.h"
#include "sim/campaign/sequential_count.h"
#include "sim/campaign/table.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/flight/build.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

std::filesystem::path folder_of(const BatchOptions& options) {
  if (!options.out.empty()) return options.out;
  const bool one = options.inputs.size() == 1;
  return std::filesystem::path("out") / (one ? std::filesystem::absolute(options.inputs[0]).stem() : "batch");
}

BatchOrders orders_of(const BatchOptions& options, const std::filesystem::path& out) {
  if (options.inputs.empty() && !options.failed_only) {
    throw InputError("batch: name scenarios, campaigns or folders (or --failed-only with --out)");
  }
  BatchOrders batch =
      options.inputs.empty()
          ? reread_batch(out / "batch.json")
          : read_batch(options.inputs, options.seeds.empty() ? std::vector<uint64_t>{} : parse_seeds(options.seeds),
                       options.overrides);
  if (options.least_success) batch.checks.push_back(SuccessRateCheck{*options.least_success, options.confidence});
  if (!options.no_worse_than.empty()) {
    const std::filesystem::path than = options.no_worse_than;
    batch.checks.push_back(NoWorseCheck{(std::filesystem::is_directory(than) ? than / "batch.json" : than).string(),
                                        options.confidence, options.margin});
  }
  if (batch.orders.empty() || std::ranges::none_of(batch.orders, &std::string::empty, &Order::fault)) {
    throw InputError(batch.faults.empty() ? std::vector<std::string>{"batch: nothing to fly"} : batch.faults);
  }
  // An earlier batch that cannot be read is better known before the flights than after.
  const std::vector<GroupSummary> planned = summarize(gather(batch.orders, {}, /*other_builds=*/false));
  judge(batch.checks, planned);
  require_decidable(batch.checks, planned);
  return batch;
}

std::optional<StoppingRule> rule_of(const BatchOptions& options, const BatchOrders& batch) {
  if (options.until.empty() && !options.until_width) return {};
  if (!batch.checks.empty() || batch.leaderboard) {
    throw InputError(
        "--until: success_rate, no_worse and leaderboards are for a number of flights planned in advance; stopping "
        "early would falsify them");
  }
  if (!options.until.empty()) return StoppingRule{parse_rate_claim(options.until), options.confidence};
  return StoppingRule{width_claim(*options.until_width, options.of), options.confidence};
}

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

/// Writes every file that can be written. @return why the first of the others could not be, else empty.
std::string write_files(const std::filesystem::path& out, const std::filesystem::path& junit,
                        const BatchOutcome& outcome, const std::vector<ExtraColumn>& columns) {
  std::string fault;
  const auto attempt = [&fault](const std::filesystem::path& file, const std::string& text) {
    try {
      if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
      write_file_whole(file, text);
    } catch (const std::exception& error) {
      if (fault.empty()) fault = error.what();
    }
  };
  attempt(out / "batch.json", batch_json(outcome, std::string(version())));
  attempt(out / "batch.csv", csv_text(flight_table(outcome.records, columns)));
  if (!junit.empty()) attempt(junit, junit_text(outcome.records, all_verdicts(outcome)));
  return fault;
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

}  // namespace

std::filesystem::path own_program() {
  std::array<char, 4096> path{};
  const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size());
  if (length <= 0 || static_cast<size_t>(length) == path.size()) throw std::runtime_error("cannot find this program");
  return std::string(path.data(), static_cast<size_t>(length));
}

int batch(const BatchOptions& options) {
  const std::filesystem::path out = folder_of(options);
  BatchOrders batch = orders_of(options, out);
  const std::optional<StoppingRule> rule = rule_of(options, batch);
  require_writable(out);
  for (const std::string& fault : batch.faults) fmt::print(stderr, "{}\n", fault);

  std::optional<SequentialCount> count;
  if (rule) {
    batch.orders = seed_by_seed(batch.orders);
    count.emplace(*rule, batch.orders);
  }
  Interruption interruption;
  CampaignProgress progress(batch.orders.size());
  FlyOptions fly{.program = options.program.empty() ? own_program() : options.program,
                 .out = out,
                 .other_builds = options.reuse_other_builds,
                 .workers = options.jobs,
                 .limit_s = options.limit_s};
  if (count) fly.wanted = [&count](const Order& order) { return count->wanted(order); };
  const Reuse reuse = options.resume ? Reuse::all : options.failed_only ? Reuse::passed : Reuse::none;
  std::vector<FlightRecord> records =
      fly_orders(batch.orders, fly, reuse, interruption, [&](const FlightRecord& record, bool reused) {
        if (count) count->ended(record);
        const bool ok = passed(record) || unchecked(record);
        const std::string words = unchecked(record) ? fmt::format("{}, {}", outcome_words(record), kNoChecks)
                                  : ok              ? outcome_words(record)
                                                    : failure_words(record);
        progress.add(record.order.id, words, ok, reused);
      });
  progress.close();

  BatchOutcome outcome = conclude(std::move(records), count, options.limit_s);
  outcome.verdicts = judge(batch.checks, summarize(outcome.records));
  const std::string unwritten = write_files(out, options.junit, outcome, counted_column(outcome, count));
  const std::string matrix = unwritten.empty() ? write_matrix(out, batch.leaderboard, options.inputs.empty()) : "";
  if (options.json) {
    fmt::print("{}", batch_json(outcome, std::string(version())));
  } else {
    fmt::print("{}{}", summary_text(outcome), matrix);
  }
  if (!unwritten.empty()) throw std::runtime_error(unwritten);
  if (!options.json) fmt::print("written: {}\n", (out / "batch.json").string());
  if (interruption.signal() != 0) return kSignalled + interruption.signal();
  if (!batch.faults.empty()) return kBadInput;
  return exit_status(outcome);
}

}  // namespace hedgehop::sim::cli
