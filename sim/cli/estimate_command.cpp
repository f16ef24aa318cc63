#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/campaign/batch_record.h"
#include "sim/campaign/rare_estimate.h"
#include "sim/cli/commands.h"
#include "sim/cli/exit_status.h"
#include "sim/cli/progress.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim::cli {
namespace {

constexpr size_t kSampleStep = 50;  // a tenth of the samples, in five blocks

void require(const EstimateOptions& options) {
  if (options.samples == 0 || options.samples % kSampleStep != 0) {
    throw InputError(fmt::format("--samples {}: must be a multiple of {}", options.samples, kSampleStep));
  }
}

}  // namespace

int estimate(const EstimateOptions& options) {
  require(options);
  const FlightEvent event = parse_graded_event(options.event);
  const EstimatedScenario scenario{options.scenario, options.overrides};
  order_of(scenario, {.chance = Chance::of_seed(options.seed)});  // a bad file is told before anything is written
  const std::filesystem::path out = options.out.empty() ? "out" / options.scenario.stem() : options.out;
  require_writable(out);

  Interruption interruption;
  const FlyOptions fly_options{.program = options.program.empty() ? own_program() : options.program,
                               .out = out,
                               .other_builds = options.reuse_other_builds,
                               .workers = options.jobs,
                               .limit_s = options.limit_s};
  EstimateRecords flown;
  const StatusLine status;
  std::optional<std::pair<size_t, size_t>> told;  // run and level
  const FlyMargins fly = [&](const std::vector<SubsetSample>& samples) -> std::optional<std::vector<double>> {
    std::vector<Order> orders;
    for (const SubsetSample& sample : samples) orders.push_back(order_of(scenario, sample));
    const auto records = fly_orders(orders, fly_options, Reuse::all, interruption, [](const FlightRecord&, bool) {});
    if (interruption.signal() != 0) return {};
    std::vector<double> margins;
    for (size_t i = 0; i < samples.size(); ++i) {
      margins.push_back(margin_of(event, records[i]));
      flown[flight_id(samples[i])] = records[i];
    }
    const auto level = std::pair(samples[0].run, samples[0].level);
    if (status.terminal() || level != told) {
      status.show(fmt::format("run {}, level {}: {} flights", level.first, level.second, flown.size()));
    }
    told = level;
    return margins;
  };
  const SubsetOptions subset{.samples = options.samples, .seed = options.seed};
  std::vector<SubsetRun> runs;
  for (size_t run = 0; run < options.runs; ++run) {
    auto result = simulate_subsets(subset, run, fly);
    if (!result) return kSignalled + interruption.signal();
    runs.push_back(std::move(*result));
  }
  status.close();
  const nlohmann::ordered_json json = estimate_json(event, subset, runs, flown);
  write_file_whole(out / "estimate.json", json.dump(1) + "\n");
  write_file_whole(out / "estimate.csv", csv_text(estimate_table(runs, flown)));
  fmt::print("{}", options.json ? json.dump(1) + "\n" : estimate_text(json));
  if (!options.json) fmt::print("written: {}\n", (out / "estimate.json").string());
  return json.at("probability").is_null() ? kUndecided : 0;
}

}  // namespace hedgehop::sim::cli
