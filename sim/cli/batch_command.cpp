#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sim/batch/earlier_batch.h"
#include "sim/batch/group_verdict.h"
#include "sim/batch/seeds.h"
#include "sim/cli/commands.h"
#include "sim/cli/fly_batch.h"
#include "sim/cli/flyable.h"
#include "sim/config/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

std::filesystem::path folder_of(const BatchOptions& options) {
  if (!options.out.empty()) return options.out;
  std::filesystem::path name = "batch";
  if (options.inputs.size() == 1) name = std::filesystem::absolute(options.inputs[0]).stem();
  if (!options.plan.empty()) name = options.plan.stem();
  return "out" / name;
}

struct PlannedBatch {
  BatchOrders batch;
  std::optional<Registration> plan;
};

/// Adds the checks of the command line, except those of the inputs or the earlier batch.
void add_checks(const BatchOptions& options, BatchOrders& batch) {
  const auto add = [&batch](const CampaignCheck& check) {
    if (std::ranges::find(batch.checks, check) == batch.checks.end()) batch.checks.push_back(check);
  };
  if (options.min_success) add(SuccessRateCheck{*options.min_success, options.confidence});
  if (options.no_worse_than.empty()) return;
  std::filesystem::path than = options.no_worse_than;
  if (std::filesystem::is_directory(than)) than /= "batch.json";
  read_batch_json(than);  // refused before any flight
  add(NoWorseCheck{than.string(), options.confidence, options.margin});
}

PlannedBatch read_orders(const BatchOptions& options, const std::filesystem::path& out) {
  if (options.inputs.empty() && options.plan.empty() && !options.failed_only) {
    throw InputError("batch: name scenarios, campaigns or folders (or --plan, or --failed-only with --out)");
  }
  const std::vector<uint64_t> seeds = options.seeds.empty() ? std::vector<uint64_t>{} : parse_seeds(options.seeds);
  std::optional<Registration> plan;
  if (!options.plan.empty()) plan = read_registration(options.plan);
  std::vector<std::string> overrides = options.overrides;
  if (!options.renderer.empty()) overrides.push_back("drawing.renderer=" + options.renderer);
  if (options.inputs.empty() && !plan && !(overrides.empty() && options.seeds.empty())) {
    throw InputError("batch --failed-only repeats the flights of --out as they are: no --seeds, --set or --renderer");
  }
  BatchOrders batch = plan ? orders_of(*plan, seeds, overrides, require_flyable_foreign)
                      : options.inputs.empty()
                          ? reread_batch(out / "batch.json")
                          : read_batch(options.inputs, seeds, overrides, options.recursive, require_flyable_foreign);
  if (!plan) plan = plan_of(batch);
  add_checks(options, batch);
  if (batch.orders.empty() || std::ranges::none_of(batch.orders, &std::string::empty, &Order::fault)) {
    throw InputError(
        batch.faults.empty()
            ? std::vector<std::string>{"batch: no flights; name a scenario, a campaign or a folder with such files"}
            : batch.faults);
  }
  try {
    require_decidable(batch);
  } catch (const InputError& error) {
    std::vector<std::string> faults = batch.faults;
    faults.insert(faults.end(), error.errors().begin(), error.errors().end());
    throw InputError(faults);
  }
  return {.batch = std::move(batch), .plan = std::move(plan)};
}

std::optional<StoppingRule> rule_of(const BatchOptions& options, const PlannedBatch& planned_batch) {
  const auto& [batch, plan] = planned_batch;
  if (!options.until.empty()) {
    require_planned_number(batch, "--until");
    return StoppingRule{parse_rate_claim(options.until), options.confidence};
  }
  if (options.until_width) {
    require_planned_number(batch, "--until-width");
    return StoppingRule{width_claim(*options.until_width, options.of), options.confidence};
  }
  if (!plan || !plan->config.rule) return {};
  require_planned_number(batch, *plan);
  return StoppingRule{parse_rate_claim(plan->config.rule->until), plan->config.rule->confidence};
}

}  // namespace

std::filesystem::path own_program() {
  std::array<char, 4096> path{};
  const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size());
  if (length <= 0 || static_cast<size_t>(length) == path.size()) throw std::runtime_error("cannot find this program");
  return std::string(path.data(), static_cast<size_t>(length));
}

namespace {

int plan_and_fly_batch(const BatchOptions& options) {
  const std::filesystem::path out = folder_of(options);
  PlannedBatch planned = read_orders(options, out);
  BatchRun run{
      .rule = rule_of(options, planned), .junit = options.junit, .json = options.json, .page = !options.no_report};
  run.conduct = conduct_of(planned.batch, planned.plan, run.rule, options.limit_s);
  run.batch = std::move(planned.batch);
  run.again = options.inputs.empty() && options.plan.empty();
  run.reuse = options.resume ? Reuse::all : options.failed_only ? Reuse::passed : Reuse::none;
  run.fly = {.program = options.program.empty() ? own_program() : options.program,
             .out = out,
             .other_builds = options.reuse_other_builds,
             .workers = options.jobs,
             .limit_s = options.limit_s};
  if (!options.keep.empty()) run.fly.keep = kept_artifacts(options.keep).value();
  return fly_batch(std::move(run));
}

}  // namespace

int batch(const BatchOptions& options) {
  return reporting_bad_input(options.junit, [&] { return plan_and_fly_batch(options); });
}

}  // namespace hedgehop::sim::cli
