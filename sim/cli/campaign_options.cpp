#include "sim/cli/campaign_options.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <thread>

#include "sim/cli/commands.h"
#include "sim/cli/number_options.h"
#include "sim/cli/override_option.h"

namespace hedgehop::sim::cli {
namespace {

size_t cores() { return std::max(1u, std::thread::hardware_concurrency()); }

template <class Options>
void add_flying(CLI::App& command, Options& options) {
  command.add_option("-j,--jobs", options.jobs, "flights at a time; all cores when not given")
      ->transform(whole_number())
      ->check(CLI::Range(1, 4096));
  command.add_option("--limit", options.limit_s, "longest wall time of a flight; it is killed then, and fails")
      ->transform(number())
      ->check(positive())
      ->type_name("S");
  command.add_flag("--reuse-other-builds", options.reuse_other_builds,
                   "let results that other builds of Hedgehop left stand, too; every row names its build");
}

void declare_batch(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("batch", "fly many scenarios, each flight in a process of its own");
  const auto options = std::make_shared<BatchOptions>();
  options->jobs = cores();
  auto* const files =
      command->add_option("FILES", options->inputs, "scenarios, campaigns (files with the key `flights`), or folders");
  command->add_option("--seeds", options->seeds, "seeds to fly of each scenario, such as 1:10 or 1:3,7");
  add_overrides(*command, options->overrides, "override a value of every scenario");
  add_flying(*command, *options);
  command->add_option("--out", options->out, "folder of the results")->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->add_option("--plan", options->plan, "fly a registered plan, and nothing else; what deviates is listed")
      ->excludes(files)
      ->type_name("FILE");
  auto* const failed_only =
      command->add_flag("--failed-only", options->failed_only,
                        "keep the flights of --out that passed; without FILES, those of its batch.json");
  command
      ->add_flag("--resume", options->resume,
                 "keep every flight of --out that left a result of the very same scenario and build")
      ->excludes(failed_only);
  command
      ->add_option("--min-success", options->least_success,
                   "over the seeds, the lower end of the success rate's interval must not be below this")
      ->transform(number())
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("RATE");
  command
      ->add_option("--no-worse-than", options->no_worse_than,
                   "over the seeds, the success rate must be no worse than in this earlier batch")
      ->type_name("DIR");
  command
      ->add_option("--margin", options->margin,
                   "with --no-worse-than: a loss of the success rate that must be ruled out, 0 to 1")
      ->transform(number())
      ->check(CLI::Range(0.0, 1.0));
  auto* const until = command
                          ->add_option("--until", options->until,
                                       "fly seed by seed until the flights show or refute this, whatever was looked at "
                                       "before: 'collision < 0.01', 'success > 0.95', 'rate(min_clearance_m < 0.5) < "
                                       "0.05'; exit status 4 where the last seed leaves it undecided")
                          ->type_name("CLAIM");
  auto* const width = command
                          ->add_option("--until-width", options->until_width,
                                       "fly seed by seed until the interval of the rate of --of is this narrow")
                          ->transform(number())
                          ->excludes(until);
  auto* const of =
      command->add_option("--of", options->of, "event of --until-width: collision, success, timeout")->needs(width);
  width->needs(of);
  command->add_option("--confidence", options->confidence, "of all of them; default 0.95")
      ->transform(number())
      ->check(CLI::Range(0.5, 0.99999));
  command->add_flag("--json", options->json, "print batch.json instead of a table for people");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return batch(*options); }; });
}

void declare_compare(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "compare", "fly two scenarios on the same seeds until a claim about the second is shown or refuted");
  const auto options = std::make_shared<CompareOptions>();
  options->jobs = cores();
  command->add_option("BASE", options->base, "scenario to compare with")->required();
  command->add_option("CANDIDATE", options->candidate, "scenario that the claim is about")->required();
  command
      ->add_option("--until", options->until,
                   "the claim: 'collision: better', 'collision: no worse by 0.02', 'min_clearance_m: better'; exit "
                   "status 4 where the last seed leaves it undecided")
      ->required()
      ->type_name("CLAIM");
  command->add_option("--range", options->range_m, "of a claim about clearances: the clearance that is enough")
      ->transform(number())
      ->type_name("M");
  command->add_option("--seeds", options->seeds, "seeds of the pairs, such as 1:100")->required();
  add_overrides(*command, options->overrides, "override a value of both scenarios");
  command->add_option("--confidence", options->confidence, "of the claim; default 0.95")
      ->transform(number())
      ->check(CLI::Range(0.5, 0.99999));
  add_flying(*command, *options);
  command->add_option("--out", options->out, "folder of the results; out/compare when not given")->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->add_flag("--resume", options->resume,
                    "keep every flight of --out that left a result of the very same scenario and build");
  command->add_flag("--json", options->json, "print batch.json instead of a table for people");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

void declare_sweep(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("sweep", "vary parameters of a scenario; resumes where it stopped");
  const auto options = std::make_shared<SweepOptions>();
  options->jobs = cores();
  command->add_option("SWEEP", options->file, "sweep file (YAML)")->required();
  add_flying(*command, *options);
  command->add_option("--out", options->out, "folder of the results")->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->add_option("--shard", options->shard, "fly one part only, such as 2/8")->type_name("I/N");
  command->add_flag("--merge", options->merge, "fly nothing; write the tables of all results that are there");
  command->add_option("--from", options->merge_from, "with --merge: further folders to search for results")
      ->type_name("DIR");
  command->add_flag("--missing", options->missing, "only print how many flights have no result yet");
  command->add_option("--on", options->on, "local (default) or slurm")->check(CLI::IsMember({"local", "slurm"}));
  command->add_option("--tasks", options->tasks, "shards of a Slurm job array; default 8")
      ->transform(whole_number())
      ->check(CLI::Range(1, 1000));
  command->add_option("--slurm-option", options->slurm_options, "for every sbatch, such as --partition=night")
      ->check([](const std::string& option) {
        const bool one_line = std::ranges::none_of(option, [](unsigned char c) { return std::iscntrl(c) != 0; });
        return option.starts_with('-') && one_line ? "" : "expected one line that begins with '-'";
      });
  command->add_flag("--dry-run", options->dry_run, "with --on slurm: only print the batch scripts");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return sweep(*options); }; });
}

void declare_falsify(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "falsify",
      "search for flights that fail, and keep each as the least scenario that still does; resumes where it "
      "stopped. Exit status: 0 none was found; 1 some were; 3 one did not repeat");
  const auto options = std::make_shared<FalsifyOptions>();
  options->jobs = cores();
  command->add_option("FILE", options->file, "search file (YAML, see docs/falsify.md)")->required();
  add_overrides(*command, options->overrides, "override a value of the search file, e.g. --set design.method=random");
  add_flying(*command, *options);
  command->add_option("--out", options->out, "folder of the results")->type_name("DIR");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return falsify(*options); }; });
}

void declare_branch(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command =
      app.add_subcommand("branch", "fly on from a moment with other settings, beside the flight that keeps them");
  const auto options = std::make_shared<BranchOptions>();
  command->add_option("RUN", options->source, "folder of a run, or a scenario")->required();
  command->add_option("--at", options->at_s, "when the settings change, from the flight's start")
      ->transform(number())
      ->check(not_negative())
      ->required()
      ->type_name("S");
  add_overrides(*command, options->overrides,
                "a setting from then on: of avoidance, failures that begin later, duration, checks");
  command->add_option("--out", options->out, "folder of the flights; branches of one run stand beside each other in it")
      ->type_name("DIR");
  command->callback([&chosen, options] { chosen = [options] { return branch(*options); }; });
}

void declare_reproduce(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "reproduce", "fly papers' experiments and print their figures beside ours; resumes where it stopped");
  const auto options = std::make_shared<ReproduceOptions>();
  options->jobs = cores();
  command->add_option("PAPER", options->papers, "papers, such as garratt2009, or files of them; all when not given");
  command->add_flag("--quick", options->quick, "fly few seeds: minutes instead of hours");
  add_flying(*command, *options);
  command->add_option("--out", options->out, "folder of the results; out/reproduce when not given")->type_name("DIR");
  command
      ->add_option("--write", options->write,
                   "write the tables as a page, too, such as docs/results.md; its other papers stay if of this build")
      ->type_name("FILE");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return reproduce(*options); }; });
}

void declare_bless(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("bless", "make a run's path the reference of its scenario");
  const auto options = std::make_shared<BlessOptions>();
  command->add_option("RUN", options->folder, "folder of the run")->required()->check(CLI::ExistingDirectory);
  command->add_option("--reason", options->reason, "why this path is the reference, one line")->required();
  command->add_flag("--force", options->force, "also bless a flight that failed, and replace another reference");
  command->add_flag("--dry-run", options->dry_run, "say what would be written, and write nothing");
  command->callback([&chosen, options] { chosen = [options] { return bless(*options); }; });
}

}  // namespace

void declare_campaigns(CLI::App& app, std::function<int()>& chosen) {
  declare_batch(app, chosen);
  declare_compare(app, chosen);
  declare_sweep(app, chosen);
  declare_falsify(app, chosen);
  declare_branch(app, chosen);
  declare_reproduce(app, chosen);
  declare_bless(app, chosen);
}

}  // namespace hedgehop::sim::cli
