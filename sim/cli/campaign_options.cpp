#include "sim/cli/campaign_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <vector>

#include "sim/batch/usable_cores.h"
#include "sim/cli/commands.h"
#include "sim/config/input_error.h"

namespace hedgehop::sim::cli {
namespace {

void declare_validate(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("validate",
                                               "check scenarios, campaigns, sweeps, searches, papers and plans without "
                                               "flying; exit status 2 if a file is invalid");
  const auto options = std::make_shared<ValidateOptions>();
  command->add_option("FILES", options->inputs, "scenarios, campaigns, sweeps, searches, papers, plans or folders")
      ->required();
  command->add_flag("--recursive", options->recursive, "also read the subfolders of folders");
  add_overrides(*command, options->overrides, "override a value of every scenario; may be repeated");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->callback([&chosen, options] { chosen = [options] { return validate(*options); }; });
}

void declare_compare(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "compare", "fly two scenarios on equal seeds until a claim about the second is shown or refuted");
  const auto options = std::make_shared<CompareOptions>();
  options->jobs = usable_cores();
  command->add_option("BASE", options->base, "baseline scenario")->required();
  command->add_option("CANDIDATE", options->candidate, "scenario of the claim")->required();
  command
      ->add_option("--until", options->until,
                   "claim: 'collision: better', 'collision: no worse by 0.02', 'min_clearance_m: better'; exit status "
                   "4 if it is undecided after the last seed")
      ->required()
      ->type_name("CLAIM");
  command
      ->add_option("--range", options->range_m,
                   "for a claim about clearance: the clearance beyond which more does not count, m")
      ->transform(number())
      ->type_name("M");
  command->add_option("--seeds", options->seeds, "seeds of the pairs of flights, such as 1:100")->required();
  add_overrides(*command, options->overrides, "override a value of both scenarios; may be repeated");
  command->add_option("--confidence", options->confidence, "confidence level of the claim; default 0.95")
      ->transform(number())
      ->check(CLI::Range(0.5, 0.99999));
  add_flying(*command, *options);
  command->add_option("--out", options->out, "output folder; default out/compare")->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->add_flag("--resume", options->resume,
                    "reuse results in --out with the same scenario, build and input files");
  command->add_flag("--json", options->json, "print batch.json instead of a table");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return compare(*options); }; });
}

/// Refuses options of a sweep that would have no effect with the others.
void require_effect(const CLI::App& sweep, const SweepOptions& options) {
  for (const char* option : {"--tasks", "--slurm-option"}) {
    if (options.on != "slurm" && sweep.get_option(option)->count() > 0)
      throw InputError(fmt::format("{} is for --on slurm", option));
  }
  const bool gathers = options.merge || options.missing;
  if (!options.merge_from.empty() && !gathers) throw InputError("--from is for --merge or --missing");
  if (options.missing && !options.junit.empty()) throw InputError("--missing writes no files: no --junit");
  if (options.dry_run && gathers && options.on != "slurm")
    throw InputError("--dry-run prints the flights to be flown: no --merge or --missing");
}

void declare_sweep(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("sweep", "vary parameters of a scenario; resumes after an interruption");
  const auto options = std::make_shared<SweepOptions>();
  options->jobs = usable_cores();
  command->add_option("SWEEP", options->file, "sweep file (YAML)")->required();
  add_overrides(*command, options->overrides, "override a value of the scenario at every point; may be repeated");
  add_flying(*command, *options);
  command->add_option("--out", options->out, "output folder; default out/NAME, after the file")->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command->add_option("--shard", options->shard, "fly one part of the sweep, such as 2/8")->type_name("I/N");
  auto* const merge =
      command->add_flag("--merge", options->merge, "write the tables of all existing results, without flying");
  command
      ->add_option("--from", options->merge_from,
                   "with --merge or --missing: additional folder with results; may be repeated")
      ->check(existing_folder())
      ->type_name("DIR");
  command->add_flag("--missing", options->missing, "print the number of flights without a result, and exit")
      ->excludes(merge);
  command->add_option("--on", options->on, "local (default) or slurm")->check(CLI::IsMember({"local", "slurm"}));
  command->add_option("--tasks", options->tasks, "number of shards of a Slurm job array; default 8")
      ->transform(whole_number())
      ->check(CLI::Range(1, 1000));
  command
      ->add_option("--slurm-option", options->slurm_options,
                   "option of every sbatch call, such as --partition=night; may be repeated")
      ->check([](const std::string& option) {
        const bool one_line = std::ranges::none_of(option, [](unsigned char c) { return std::iscntrl(c) != 0; });
        return option.starts_with('-') && one_line ? "" : "expected one line that begins with '-'";
      });
  command->add_flag("--dry-run", options->dry_run,
                    "print the number of flights, with --on slurm the batch scripts, without flying or submitting");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options, command] {
    require_effect(*command, *options);
    if (command->get_option("--jobs")->count() > 0) options->task_cores = options->jobs;
    chosen = [options] { return sweep(*options); };
  });
}

void declare_falsify(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command =
      app.add_subcommand("falsify",
                         "search for failing flights and store each as a minimal scenario; resumes after an "
                         "interruption. Exit status: 0 no failure in any flight; 1 confirmed failures; 3 a repeated "
                         "failure differs; 4 undecided, because flights were not flown or failures depend on the seed");
  const auto options = std::make_shared<FalsifyOptions>();
  options->jobs = usable_cores();
  command->add_option("FILE", options->file, "search file (YAML, see docs/falsify.md)")->required();
  add_overrides(*command, options->overrides,
                "override a value of the search file, e.g. --set design.method=random; may be repeated");
  add_flying(*command, *options, "then the flight is killed and counts as not flown");
  command->add_option("--out", options->out, "output folder; default out/NAME, after the file")->type_name("DIR");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return falsify(*options); }; });
}

void declare_branch(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "branch", "fly a run with other settings from a given time on, and the unchanged run for comparison");
  const auto options = std::make_shared<BranchOptions>();
  command->add_option("RUN", options->source, "folder of a run, or a scenario")->required();
  command->add_option("--at", options->at_s, "time of the change from the start of the flight, s")
      ->transform(number())
      ->check(not_negative())
      ->required()
      ->type_name("S");
  add_overrides(*command, options->overrides,
                "a setting after the change: avoidance, failures that begin later, duration, checks, may_collide");
  command->add_option("--out", options->out, "output folder, one subfolder per flight; branches of one run share it")
      ->type_name("DIR");
  command->callback([&chosen, options] { chosen = [options] { return branch(*options); }; });
}

void declare_reproduce(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand(
      "reproduce", "fly the papers' experiments and compare the figures; resumes after an interruption");
  const auto options = std::make_shared<ReproduceOptions>();
  options->jobs = usable_cores();
  command->add_option("PAPER", options->papers, "papers, such as garratt2009, or paper files; default all");
  command->add_flag("--quick", options->quick, "fly few seeds, in minutes instead of hours");
  add_flying(*command, *options);
  command->add_option("--out", options->out, "output folder; default out/reproduce")->type_name("DIR");
  command
      ->add_option("--write", options->write,
                   "also write the tables to a page, such as docs/results.md; rows of other papers remain if this "
                   "build wrote them")
      ->type_name("FILE");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options] { chosen = [options] { return reproduce(*options); }; });
}

void declare_bless(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("bless", "store a run's trajectory as the reference of its scenario");
  const auto options = std::make_shared<BlessOptions>();
  command->add_option("RUN", options->folder, "output folder of the run")->required()->check(existing_folder());
  command->add_option("--reason", options->reason, "reason for this reference, one line")->required();
  command->add_flag("--force", options->force, "also accept a failed flight, and replace an existing reference");
  command->add_flag("--dry-run", options->dry_run, "print the files that would be written, without writing them");
  command->callback([&chosen, options] { chosen = [options] { return bless(*options); }; });
}

}  // namespace

void declare_campaigns(CLI::App& app, std::function<int()>& chosen) {
  declare_batch(app, chosen);
  declare_validate(app, chosen);
  declare_compare(app, chosen);
  declare_sweep(app, chosen);
  declare_falsify(app, chosen);
  declare_branch(app, chosen);
  declare_reproduce(app, chosen);
  declare_bless(app, chosen);
}

}  // namespace hedgehop::sim::cli
