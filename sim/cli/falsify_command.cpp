#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/batch/folders.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/flyable.h"
#include "sim/cli/progress.h"
#include "sim/config/folder_lock.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/falsify/counterexample.h"
#include "sim/flight/json_file.h"
#include "sim/flight/words.h"
#include "sim/pages/campaign_report.h"
#include "sim/pages/report_page.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim::cli {
namespace {

constexpr size_t kConfirmingFlights = 2;  // of each failure: as it was found, and as it is kept

/// Prints the number of flights that were not flown, and each cause with its first flight.
/// @return the number.
size_t print_not_flown(const std::vector<FlightRecord>& records) {
  std::vector<std::pair<const FlightRecord*, size_t>> causes;  // in order of occurrence
  size_t count = 0;
  for (const FlightRecord& record : records) {
    if (verdict_of(record) != Verdict::not_flown) continue;
    ++count;
    const auto known = std::ranges::find(causes, record.cause, [](const auto& cause) { return cause.first->cause; });
    known == causes.end() ? void(causes.emplace_back(&record, 1)) : void(++known->second);
  }
  if (count == 0) return 0;
  fmt::print("{} of {} flights were not flown; they count neither as passed nor as failed:\n", count, records.size());
  for (const auto& [record, times] : causes) {
    fmt::print("  {} times, first {}: {}\n      {}\n", times, record->order.id, record->cause,
               rerun_command(record->order));
  }
  return count;
}

std::string_view words(Repeat repeat) {
  switch (repeat) {
    case Repeat::equal:
      return "";
    case Repeat::differs:
      return "; NOT CONFIRMED: the repeated flight differs";
    case Repeat::not_flown:
      return "; NOT CONFIRMED: the repeated flight was not flown";
  }
  return "";
}

/// A folder holds one search: flights of another would be taken for this one's.
void require_same_search(const FalsifySearch& search, const std::filesystem::path& out) {
  const std::filesystem::path file = out / "falsify.json";
  if (!has_file(out, file.filename().string())) return;
  nlohmann::ordered_json left;
  try {
    left = read_json(file);
  } catch (const InputError& damage) {
    throw InputError(fmt::format("{}; choose another --out, or remove the file", damage.errors().front()));
  }
  const bool is_search = left.is_object() && left.contains("search") && left["search"].is_string();
  if (is_search && left["search"] == search.identity) return;
  throw InputError(
      fmt::format("{}: holds a search of another file, or of this one before it or a --set was changed; choose "
                  "another --out",
                  out.string()));
}

class FalsifyRun {
 public:
  FalsifyRun(const FalsifyOptions& options, const FalsifySearch& search, std::filesystem::path out)
      : search_(search),
        out_(std::move(out)),
        progress_(std::in_place, static_cast<size_t>(search.config.design.budget)) {
    fly_ = {.program = options.program.empty() ? own_program() : options.program,
            .out = out_,
            .other_builds = options.reuse_other_builds,
            .workers = options.jobs,
            .limit_s = options.limit_s};
    file_ = options.file.string();
  }

  int run() {
    std::filesystem::create_directories(out_);
    write_file_whole(out_ / "falsify.json", falsify_json(search_, {}, {}));  // whose flights these are
    const FalsifyResult result = falsify(search_, [&](const std::vector<Order>& orders) { return fly(orders, false); });
    const Table table = falsify_table(search_, result);
    write_file_whole(out_ / "falsify.csv", table.csv());
    write_sqlite(out_ / "falsify.sqlite", table);
    write_file_whole(out_ / "falsify.json", falsify_json(search_, result, {}));
    std::optional<CompetitionSuite> suite;
    std::vector<Counterexample> found;
    if (!result.stopped) {
      if (search_.config.score == FalsifyScore::sbft) {
        suite = score(result);
      } else {
        found = keep(result);
      }
    }
    progress_->close();
    if (interruption_.signal() != 0) return kSignalled + interruption_.signal();
    try {
      write_campaign_report(out_, {});
    } catch (const PagesAbsent& absent) {
      notice(fmt::format("{}\n", absent.what()));
    }
    return suite ? conclude(result, *suite) : conclude(result, found);
  }

 private:
  /// Flies and stores the tests of the competition. @return nullopt if interrupted.
  std::optional<CompetitionSuite> score(const FalsifyResult& result) {
    progress_.emplace(suite_candidates(result) * kRunsOfTest);
    auto suite = fly_suite(search_, result, [&](const std::vector<Order>& orders) { return fly(orders, false); });
    if (!suite) return {};
    write_tests(file_, out_, *suite);
    write_file_whole(out_ / "falsify.json", falsify_json(search_, result, {}, &*suite));
    return suite;
  }

  /// Confirms, shrinks and stores the failures. @return as many as were completed before an interruption.
  std::vector<Counterexample> keep(const FalsifyResult& result) {
    std::vector<Counterexample> found;
    while (found.size() < result.failures.size()) {
      progress_.emplace(static_cast<size_t>(search_.config.design.shrinking) + kConfirmingFlights);
      auto next = keep_counterexample(search_, file_, result, found.size() + 1, out_,
                                      {.plain = [&](const Order& order) { return fly_one(order, false); },
                                       .with_report = [&](const Order& order) { return fly_one(order, true); }});
      if (!next) break;
      found.push_back(std::move(*next));
      write_file_whole(out_ / "falsify.json", falsify_json(search_, result, found));
    }
    return found;
  }

  std::optional<std::vector<FlightRecord>> fly(const std::vector<Order>& orders, bool reports) {
    if (std::exchange(is_first_, false)) require_first_flyable(orders);
    FlyOptions options = fly_;
    options.reports = reports;
    auto records = fly_shown(orders, options, interruption_, *progress_);
    if (interruption_.signal() != 0) return std::nullopt;
    return records;
  }
  std::optional<FlightRecord> fly_one(const Order& order, bool reports) {
    auto records = fly({order}, reports);
    return records ? std::optional(std::move(records->front())) : std::nullopt;
  }

  /// Prints the search's flights and failing points. @param failures  number of distinct failures.
  /// @return the number of flights that were not flown.
  static size_t print_search(const FalsifyResult& result, size_t failures) {
    fmt::print("{}{}", mixture_words(result.records), truth_words(result.records));
    const size_t not_flown = print_not_flown(result.records);
    if (failures == 0) {
      fmt::print("no failure in {}, which is no proof of safety\n",
                 counted(result.records.size() - not_flown, "flight"));
    } else {
      fmt::print("{}, {} of {}, the first after {}; {}\n", counted(result.records.size(), "flight"),
                 std::ranges::count_if(result.trials, &FalsifyTrial::fails),
                 counted(result.trials.size(), "point") + (result.trials.size() == 1 ? " fails" : " fail"),
                 counted(result.trials[result.failures[0]].record + 1, "flight"),
                 counted(failures, "distinct failure"));
    }
    return not_flown;
  }

  /// Prints the competition's scores and returns the exit status.
  int conclude(const FalsifyResult& result, const CompetitionSuite& suite) const {
    const size_t not_flown = print_search(result, suite.tests.size());
    std::vector<FlightRecord> runs;
    for (const CompetitionTest& test : suite.tests) runs.insert(runs.end(), test.records.begin(), test.records.end());
    const size_t runs_not_flown = print_not_flown(runs);
    fmt::print("{}written: {}\n", suite_words(suite), (out_ / "report.html").string());
    if (suite.confirmed() > 0) return kFails;
    return not_flown + runs_not_flown > 0 || !suite.tests.empty() ? kUndecided : 0;
  }

  /// Prints the failures and returns the exit status.
  int conclude(const FalsifyResult& result, const std::vector<Counterexample>& found) const {
    const size_t not_flown = print_search(result, found.size());
    size_t confirmed = 0;
    bool differs = false;
    for (const Counterexample& one : found) {
      const Repeat repeat = one.repeats == Repeat::equal ? one.confirmed : one.repeats;
      confirmed += repeat == Repeat::equal ? 1 : 0;
      differs |= repeat == Repeat::differs;
      const std::string left = one.shrunk.items_before == 0 ? ""
                                                            : fmt::format(", {} of {} boxes, movers and failures left",
                                                                          one.shrunk.items, one.shrunk.items_before);
      fmt::print("FAIL  {}: robustness {:.4g}{}, {:g} s{}\n      hedgehop run {}\n", one.file.stem().string(),
                 one.weakest.robustness, left, one.shrunk.scenario.duration_s, words(repeat),
                 shell_quoted(one.file.string()));
    }
    if (!found.empty()) fmt::print("confirmed: {} of {}, flown again alone\n", confirmed, found.size());
    fmt::print("written: {}\n", (out_ / "report.html").string());
    if (differs) return kInternalError;
    if (confirmed > 0) return kFails;
    return not_flown > 0 || !found.empty() ? kUndecided : 0;
  }

  const FalsifySearch& search_;
  const std::filesystem::path out_;
  std::string file_;
  FlyOptions fly_;
  Interruption interruption_;
  std::optional<CampaignProgress> progress_;
  bool is_first_ = true;  ///< no flight has been ordered yet
};

}  // namespace

int falsify(const FalsifyOptions& options) {
  const FalsifySearch search = read_falsify(options.file, options.overrides);
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / options.file.stem() : options.out;
  require_writable(out);
  const FolderLock lock(out);
  require_same_search(search, out);
  return FalsifyRun(options, search, out).run();
}

}  // namespace hedgehop::sim::cli
