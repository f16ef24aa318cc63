#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "sim/batch/seeds.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/flyable.h"
#include "sim/cli/progress.h"
#include "sim/cli/sweep_files.h"
#include "sim/config/folder_lock.h"
#include "sim/config/utf8.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/build.h"
#include "sim/sweep/optimize.h"
#include "sim/sweep/plan.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim::cli {
namespace {

constexpr size_t kChunkFlights = 2'000;  // whose orders are in memory at a time
constexpr size_t kManyPoints = 5'000;    // their check takes more than ten seconds

/// Prints the counts and returns the exit status.
int conclude(const SweepRun& run, const SweepPlan& plan, const FlownSweep& flown) {
  const std::vector<FlightRecord>& records = flown.records;
  const EveryWrite files = write_sweep(run, flown, plan.numbers_of_design(), plan.block());
  const auto of_status = [&](FlightRecord::Status status) {
    return std::ranges::count(records, status, &FlightRecord::status);
  };
  const auto of_verdict = [&](Verdict verdict) {
    return std::ranges::count_if(records, [&](const FlightRecord& record) { return verdict_of(record) == verdict; });
  };
  const auto without = of_verdict(Verdict::unchecked);
  const std::string no_checks = without > 0 ? fmt::format(", {} with {}", without, kNoChecks) : "";
  fmt::print("{}{}", mixture_words(records), truth_words(records));
  fmt::print("{} flights: {} passed, {} failed a check{}, {} failed to fly, {} missing\n", records.size(),
             of_verdict(Verdict::passed), of_verdict(Verdict::failed) + of_verdict(Verdict::fault), no_checks,
             of_status(FlightRecord::Status::failed), of_status(FlightRecord::Status::missing));
  if (files.well()) fmt::print("written: {}\n", (run.out / (run.name + ".csv")).string());
  if (files.well() && run.options.shard.empty()) write_sweep_page(run, records.size());
  print_failed(records);
  files.raise();
  return std::ranges::all_of(records, [](const FlightRecord& r) { return holds(verdict_of(r)); }) ? 0 : kFails;
}

FlyOptions fly_options(const SweepRun& run) {
  return {.program = run.options.program.empty() ? own_program() : run.options.program,
          .out = run.out,
          .other_builds = run.options.reuse_other_builds,
          .workers = run.options.jobs,
          .limit_s = run.options.limit_s};
}

/// Calls `each` with the orders of the sweep or shard, a limited number at a time.
template <class Each>
void for_each_chunk(const SweepPlan& plan, Shard shard, Each each) {
  const size_t points = std::max<size_t>(1, kChunkFlights / plan.seeds());
  for (size_t first = 0; first < plan.points(); first += points) {
    if (const SweepOrders orders = plan.orders(first, points, shard); !orders.orders.empty()) each(orders);
  }
}

int fly_all(const SweepRun& run, const SweepPlan& plan, Shard shard) {
  require_first_flyable(plan.orders(0, 1, {}).orders);
  Interruption interruption;
  CampaignProgress progress((plan.flights() + shard.of - shard.index) / shard.of);
  const FlyOptions options = fly_options(run);
  FlownSweep flown;
  for_each_chunk(plan, shard, [&](const SweepOrders& orders) {
    auto records = interruption.signal() != 0 ? gather(orders.orders, {run.out}, options.other_builds)
                                              : fly_shown(orders.orders, options, interruption, progress);
    flown.add(run.sweep, orders, std::move(records), !run.options.junit.empty());
  });
  progress.close();
  const int status = conclude(run, plan, flown);
  return interruption.signal() != 0 ? kSignalled + interruption.signal() : status;
}

/// Writes the tables of the results that exist, or counts the flights without one.
int gather_all(const SweepRun& run, const SweepPlan& plan, Shard shard) {
  std::vector<std::filesystem::path> folders{run.out};
  folders.insert(folders.end(), run.options.merge_from.begin(), run.options.merge_from.end());
  FlownSweep flown;
  int64_t missing = 0;
  for_each_chunk(plan, shard, [&](const SweepOrders& orders) {
    std::vector<FlightRecord> records = gather(orders.orders, folders, run.options.reuse_other_builds);
    missing += std::ranges::count(records, FlightRecord::Status::missing, &FlightRecord::status);
    if (run.options.merge) flown.add(run.sweep, orders, std::move(records), !run.options.junit.empty());
  });
  if (run.options.merge) return conclude(run, plan, flown);
  fmt::print("{}\n", missing);
  return 0;
}

int fly_optimizer(const SweepRun& run, const OptimizeDesign& design) {
  Interruption interruption;
  const size_t seeds = run.sweep.seeds ? parse_seeds(*run.sweep.seeds).size() : 1;
  CampaignProgress progress(seeds * static_cast<size_t>(design.evaluations));
  const FlyOptions options = fly_options(run);
  bool is_first = true;
  const FlyPoint fly = [&](const std::vector<Order>& orders) -> std::optional<std::vector<FlightRecord>> {
    if (std::exchange(is_first, false)) require_first_flyable(orders);
    auto records = fly_shown(orders, options, interruption, progress);
    if (interruption.signal() != 0) return std::nullopt;
    return records;
  };
  const Optimum best = optimize(run.sweep, fly);
  progress.close();
  FlownSweep flown;
  flown.add(run.sweep, best.orders, best.records, true);
  const EveryWrite files = write_sweep(run, flown, {}, 0);
  if (!best.fault.empty()) {
    if (files.well()) write_sweep_page(run, best.records.size());
    throw InputError(fmt::format("{}: {}", run.sweep.design_position.text(), best.fault));
  }
  if (best.stopped) {
    files.raise();
    return kSignalled + interruption.signal();
  }
  nlohmann::ordered_json json{{"minimize", design.minimize}, {"cost", best.cost}, {"values", {}}};
  std::string words;
  for (size_t i = 0; i < best.values.size(); ++i) {
    json["values"][run.sweep.parameters[i].path] = best.values[i];
    words += fmt::format(" --set {}={}", run.sweep.parameters[i].path, best.values[i]);
  }
  const std::string early_end =
      best.early_end.empty() ? "" : fmt::format(" of up to {} ({})", design.evaluations, best.early_end);
  fmt::print("{} points flown{}; smallest mean of {}: {:g}, with{}\n", best.records.size() / seeds, early_end,
             design.minimize, best.cost, words);
  if (best.cost >= design.failure_cost)
    fmt::print("no point has a mean below failure_cost: flights fail or lack {}\n", design.minimize);
  files.raise();
  write_file_whole(run.out / "optimum.json", json_text(json, 2) + "\n");
  fmt::print("written: {}\n", (run.out / "optimum.json").string());
  write_campaign_page(run.out);
  return best.cost < design.failure_cost ? 0 : kFails;
}

int on_slurm(const SweepRun& run, size_t flights) {
  const SlurmJob job{.program = own_program(),
                     .sweep = run.options.file,
                     .out = std::filesystem::absolute(run.out).lexically_normal(),
                     .folder = std::filesystem::current_path(),
                     .worker = run.options.program,
                     .junit = run.options.junit.empty() ? "" : std::filesystem::absolute(run.options.junit),
                     .tasks = std::min(run.options.tasks, flights),
                     .cores = run.options.task_cores,
                     .limit_s = run.options.limit_s,
                     .other_builds = run.options.reuse_other_builds,
                     .overrides = run.options.overrides,
                     .options = run.options.slurm_options};
  if (run.options.dry_run) {
    fmt::print("{}\n{}", array_script(job), merge_script(job));
    return 0;
  }
  fmt::print("submitted: job {}; {} when it has ended\n", submit(job), (run.out / "sweep.csv").string());
  return 0;
}

/// Prints the flights that the command would fly.
int print_plan(const SweepRun& run, const SweepPlan& plan, Shard shard) {
  size_t flights = 0, with_results = 0;
  std::string first;
  for_each_chunk(plan, shard, [&](const SweepOrders& orders) {
    const auto records = gather(orders.orders, {run.out}, run.options.reuse_other_builds);
    flights += records.size();
    with_results += records.size() - static_cast<size_t>(std::ranges::count(records, FlightRecord::Status::missing,
                                                                            &FlightRecord::status));
    if (first.empty()) first = rerun_command(orders.orders.front());
  });
  fmt::print("{} flights of {} points; {} have results in {}\n", flights, plan.points(), with_results,
             run.out.string());
  if (!first.empty()) fmt::print("first flight: {}\n", first);
  return 0;
}

int plan_and_fly_sweep(const SweepOptions& options) {
  SweepRun run{.options = options, .sweep = read_sweep(options.file, options.overrides), .out = options.out};
  if (run.out.empty()) run.out = std::filesystem::path("out") / options.file.stem();
  require_writable(run.out);
  if (!options.junit.empty()) require_writable_file(options.junit);
  if (const auto* design = std::get_if<OptimizeDesign>(&run.sweep.design)) {
    if (options.on != "local" || !options.shard.empty() || options.merge || options.missing) {
      throw InputError("an optimizer needs each result before the next point: no --on, --shard, --merge or --missing");
    }
    if (options.dry_run) {
      fmt::print(
          "at most {} points, {} flights each; the optimizer chooses each point from the results of the others\n",
          design->evaluations, run.sweep.seeds ? parse_seeds(*run.sweep.seeds).size() : 1);
      return 0;
    }
    const FolderLock lock(run.out);
    return fly_optimizer(run, *design);
  }
  if (const size_t points = count_points(run.sweep); points > kManyPoints) {
    notice(fmt::format("checking {} points before the flights\n", points));
  }
  const SweepPlan plan(run.sweep);
  for (const std::string& line : plan.notices()) notice(line + "\n");
  if (options.on == "slurm" && (options.missing || options.merge || !options.shard.empty())) {
    throw InputError("--on slurm submits the whole sweep: no --shard, --merge or --missing");
  }
  if (options.on == "slurm") return on_slurm(run, plan.flights());
  Shard shard;
  if (!options.shard.empty()) {
    shard = parse_shard(options.shard);
    run.name = fmt::format("shard-{}-of-{}", shard.index, shard.of);
  }
  if (options.missing) return gather_all(run, plan, shard);
  if (options.dry_run) return print_plan(run, plan, shard);
  const FolderLock lock = options.shard.empty() ? FolderLock(run.out) : FolderLock(run.out, run.name);
  return options.merge ? gather_all(run, plan, shard) : fly_all(run, plan, shard);
}

}  // namespace

int sweep(const SweepOptions& options) {
  return reporting_bad_input(options.junit, [&] { return plan_and_fly_sweep(options); });
}

}  // namespace hedgehop::sim::cli
