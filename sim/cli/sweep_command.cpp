#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/batch/junit.h"
#include "sim/batch/seeds.h"
#include "sim/cli/commands.h"
#include "sim/cli/every_write.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/progress.h"
#include "sim/config/whole_file.h"
#include "sim/evidence/batch_record.h"
#include "sim/flight/build.h"
#include "sim/sweep/optimize.h"
#include "sim/sweep/sweep.h"

namespace hedgehop::sim::cli {
namespace {

struct SweepRun {
  const SweepOptions& options;
  SweepConfig sweep;
  std::filesystem::path out;
  std::string name = "sweep";  ///< of the tables, without their ending
};

EveryWrite write_tables(const SweepRun& run, const SweepOrders& orders, const std::vector<FlightRecord>& records) {
  EveryWrite files;
  const Table table = sweep_table(run.sweep, orders, records);
  files.attempt([&] {
    std::filesystem::create_directories(run.out);
    write_file_whole(run.out / (run.name + ".csv"), table.csv());
  });
  files.attempt([&] { write_sqlite(run.out / (run.name + ".sqlite"), table); });
  if (run.options.junit.empty()) return files;
  files.attempt([&] { write_junit(run.options.junit, junit_text(records, {}, junit_origin())); });
  return files;
}

/// Prints the counts and returns the exit status.
int conclude(const SweepRun& run, const SweepOrders& orders, const std::vector<FlightRecord>& records) {
  const EveryWrite files = write_tables(run, orders, records);
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
  if (files.well() && run.options.shard.empty()) write_campaign_page(run.out);
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

int fly_all(const SweepRun& run, const SweepOrders& orders) {
  Interruption interruption;
  CampaignProgress progress(orders.orders.size());
  const auto records = fly_shown(orders.orders, fly_options(run), interruption, progress);
  progress.close();
  const int status = conclude(run, orders, records);
  return interruption.signal() != 0 ? kSignalled + interruption.signal() : status;
}

int fly_optimizer(const SweepRun& run, const OptimizeDesign& design) {
  Interruption interruption;
  const size_t seeds = run.sweep.seeds ? parse_seeds(*run.sweep.seeds).size() : 1;
  CampaignProgress progress(seeds * static_cast<size_t>(design.evaluations));
  const FlyOptions options = fly_options(run);
  const FlyPoint fly = [&](const std::vector<Order>& orders) -> std::optional<std::vector<FlightRecord>> {
    auto records = fly_shown(orders, options, interruption, progress);
    if (interruption.signal() != 0) return std::nullopt;
    return records;
  };
  const Optimum best = optimize(run.sweep, fly);
  progress.close();
  const EveryWrite files = write_tables(run, best.orders, best.records);
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
  fmt::print("{} points flown; smallest mean of {}: {:g}, with{}\n", best.records.size() / seeds, design.minimize,
             best.cost, words);
  files.raise();
  write_file_whole(run.out / "optimum.json", json.dump(2) + "\n");
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
int print_plan(const SweepRun& run, const SweepOrders& orders) {
  const auto records = gather(orders.orders, {run.out}, run.options.reuse_other_builds);
  const auto missing = std::ranges::count(records, FlightRecord::Status::missing, &FlightRecord::status);
  const std::set<size_t> points(orders.points.begin(), orders.points.end());
  fmt::print("{} flights of {} points; {} have results in {}\n", records.size(), points.size(),
             static_cast<int64_t>(records.size()) - missing, run.out.string());
  if (!orders.orders.empty()) fmt::print("first flight: {}\n", rerun_command(orders.orders.front()));
  return 0;
}

int plan_and_fly_sweep(const SweepOptions& options) {
  SweepRun run{.options = options, .sweep = read_sweep(options.file, options.overrides), .out = options.out};
  if (run.out.empty()) run.out = std::filesystem::path("out") / options.file.stem();
  require_writable(run.out);
  if (!options.junit.empty()) require_writable_file(options.junit);
  if (const auto* design = std::get_if<OptimizeDesign>(&run.sweep.design)) {
    if (options.on != "local" || !options.shard.empty() || options.merge || options.missing) {
      throw InputError("an optimizer looks at each point before the next: no --on, --shard, --merge or --missing");
    }
    if (options.dry_run) {
      fmt::print(
          "at most {} points, {} flights each; the optimizer chooses each point from the results of the others\n",
          design->evaluations, run.sweep.seeds ? parse_seeds(*run.sweep.seeds).size() : 1);
      return 0;
    }
    return fly_optimizer(run, *design);
  }
  SweepOrders orders = sweep_orders(run.sweep);
  if (options.on == "slurm") return on_slurm(run, orders.orders.size());
  if (!options.shard.empty()) {
    const Shard shard = parse_shard(options.shard);
    orders = part_of(orders, shard);
    run.name = fmt::format("shard-{}-of-{}", shard.index, shard.of);
  }
  if (options.merge || options.missing) {
    std::vector<std::filesystem::path> folders{run.out};
    folders.insert(folders.end(), options.merge_from.begin(), options.merge_from.end());
    const std::vector<FlightRecord> records = gather(orders.orders, folders, run.options.reuse_other_builds);
    if (options.merge) return conclude(run, orders, records);
    fmt::print("{}\n", std::ranges::count(records, FlightRecord::Status::missing, &FlightRecord::status));
    return 0;
  }
  return options.dry_run ? print_plan(run, orders) : fly_all(run, orders);
}

}  // namespace

int sweep(const SweepOptions& options) {
  return reporting_bad_input(options.junit, [&] { return plan_and_fly_sweep(options); });
}

}  // namespace hedgehop::sim::cli
