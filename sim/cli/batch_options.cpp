#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "sim/batch/fly_orders.h"
#include "sim/batch/usable_cores.h"
#include "sim/cli/campaign_options.h"
#include "sim/cli/commands.h"
#include "sim/scenario/drawing.h"

namespace hedgehop::sim::cli {
namespace {

/// Returns the error of a value of --keep; "" if it is valid.
std::string keep_fault(const std::string& text) {
  constexpr const char* kValid = "expected failed=report,film,replay,csv, or some of these";
  const std::string_view prefix = "failed=";
  if (!text.starts_with(prefix)) return kValid;
  return kept_artifacts(text) ? "" : kValid;
}

void add_renderer(CLI::App& command, std::string& renderer) {
  command
      .add_option("--renderer", renderer,
                  "renderer of the camera images: osmesa, egl or tiles; overrides the scenarios'")
      ->check(CLI::IsMember(std::vector<std::string>(kRendererNames.begin(), kRendererNames.end())));
}

}  // namespace

void declare_batch(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("batch", "fly many scenarios, each flight in its own process");
  const auto options = std::make_shared<BatchOptions>();
  options->jobs = usable_cores();
  auto* const files = command->add_option(
      "FILES", options->inputs, "scenarios, campaigns (files with the key `flights` or `leaderboard`) or folders");
  command->add_flag("--recursive", options->recursive, "also read the subfolders of folders")->needs(files);
  command->add_option("--seeds", options->seeds, "seeds of each scenario, such as 1:10 or 1:3,7");
  add_overrides(*command, options->overrides, "override a value of every scenario; may be repeated");
  add_renderer(*command, options->renderer);
  add_flying(*command, *options);
  command
      ->add_option("--out", options->out,
                   "output folder; default out/NAME, after the file, or out/batch for several files")
      ->type_name("DIR");
  command->add_option("--junit", options->junit, "write a JUnit file for CI")->type_name("FILE");
  command
      ->add_option("--keep", options->keep,
                   "artifacts of failed flights: failed=report,film,replay,csv, or some of these; the JUnit file lists "
                   "them as [[ATTACHMENT|path]]")
      ->check([](const std::string& text) { return keep_fault(text); })
      ->type_name("failed=LIST");
  command->add_flag("--no-report", options->no_report,
                    "do not write report.html; `hedgehop report DIR` writes it later");
  command->add_option("--plan", options->plan, "fly a registered plan; deviations are listed")
      ->excludes(files)
      ->type_name("FILE");
  auto* const failed_only = command->add_flag(
      "--failed-only", options->failed_only,
      "fly only the flights of --out that did not pass; without FILES, the flights of its batch.json");
  command->add_flag("--resume", options->resume, "reuse results in --out with the same scenario, build and input files")
      ->excludes(failed_only);
  auto* const min_success =
      command
          ->add_option("--min-success", options->min_success,
                       "required success rate over the seeds; the lower bound of its interval must reach it")
          ->transform(number())
          ->check(CLI::Range(0.0, 1.0))
          ->type_name("RATE");
  auto* const no_worse =
      command
          ->add_option("--no-worse-than", options->no_worse_than,
                       "require a success rate over the seeds that is no worse than in this earlier batch")
          ->check([](const std::string& path) {
            std::error_code error;
            return std::filesystem::exists(path, error)
                       ? ""
                       : path + ": there is no such folder; valid: the --out of an earlier batch";
          })
          ->type_name("DIR");
  command
      ->add_option("--margin", options->margin,
                   "with --no-worse-than: loss of the success rate that must be excluded, 0 to 1")
      ->needs(no_worse)
      ->transform(number())
      ->check(CLI::Range(0.0, 1.0));
  auto* const until =
      command
          ->add_option("--until", options->until,
                       "fly seed by seed until the claim is shown or refuted: 'collision < 0.01', 'success > 0.95', "
                       "'rate(min_clearance_m < 0.5) < 0.05'; exit status 4 if it is undecided after the last seed")
          ->type_name("CLAIM");
  auto* const width = command
                          ->add_option("--until-width", options->until_width,
                                       "fly seed by seed until the interval of the rate of --of is at most this wide")
                          ->transform(number())
                          ->excludes(until);
  auto* const of =
      command->add_option("--of", options->of, "event for --until-width: collision, success, timeout")->needs(width);
  width->needs(of);
  auto* const confidence = command
                               ->add_option("--confidence", options->confidence,
                                            "confidence level of --min-success, --no-worse-than, --until and "
                                            "--until-width; default 0.95")
                               ->transform(number())
                               ->check(CLI::Range(0.5, 0.99999));
  command->add_flag("--json", options->json, "print batch.json instead of a table");
  command->add_option("--program", options->program)->group("");  // hidden: for tests
  command->callback([&chosen, options, uses = std::vector{min_success, no_worse, until, width}, confidence] {
    if (*confidence && std::ranges::none_of(uses, [](const CLI::Option* use) { return bool(*use); }))
      throw CLI::RequiresError("--confidence", "--min-success, --no-worse-than, --until or --until-width");
    chosen = [options] { return batch(*options); };
  });
}

}  // namespace hedgehop::sim::cli
