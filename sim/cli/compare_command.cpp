#include <fmt/format.h>

#include <algorithm>

#include "sim/batch/seeds.h"
#include "sim/cli/commands.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/flyable.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

BatchOrders orders_of(const CompareOptions& options) {
  const std::vector<uint64_t> seeds = parse_seeds(options.seeds);
  BatchOrders batch = read_batch({options.base, options.candidate}, seeds, options.overrides, /*recursive=*/false,
                                 require_flyable_foreign);
  if (!batch.faults.empty()) throw InputError(batch.faults);
  for (const std::filesystem::path& file : {options.base, options.candidate}) {
    if (std::ranges::find(batch.orders, file.lexically_normal(), &Order::scenario) == batch.orders.end())
      throw InputError(fmt::format("compare: {} is a campaign or a folder; valid: a scenario", file.string()));
  }
  if (batch.orders.size() == 2 * seeds.size()) return batch;
  throw InputError(
      fmt::format("compare: BASE and CANDIDATE are the same file '{}'; name two scenarios", options.base.string()));
}

}  // namespace

namespace {

int plan_and_compare(const CompareOptions& options) {
  BatchRun run{.rule = StoppingRule{parse_pair_claim(options.until, options.range_m), options.confidence},
               .junit = options.junit,
               .json = options.json};
  run.batch = orders_of(options);
  run.conduct = conduct_of(run.batch, plan_of(run.batch), run.rule, options.limit_s);
  run.reuse = options.resume ? Reuse::all : Reuse::none;
  run.fly = {.program = options.program.empty() ? own_program() : options.program,
             .out = options.out.empty() ? std::filesystem::path("out") / "compare" : options.out,
             .other_builds = options.reuse_other_builds,
             .workers = options.jobs,
             .limit_s = options.limit_s};
  return fly_batch(std::move(run));
}

}  // namespace

int compare(const CompareOptions& options) {
  return reporting_bad_input(options.junit, [&] { return plan_and_compare(options); });
}

}  // namespace hedgehop::sim::cli
