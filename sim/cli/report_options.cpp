#include <memory>

#include "sim/cli/campaign_options.h"
#include "sim/cli/commands.h"

namespace hedgehop::sim::cli {
namespace {

void declare_report(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command = app.add_subcommand("report", "write report.html of a run, a batch or a sweep");
  const auto report = std::make_shared<ReportOptions>();
  command->add_option("DIR", report->folder, "output folder of the run, batch or sweep")
      ->required()
      ->check(existing_folder());
  command->add_option("--against", report->against, "compare with another run, or with an earlier batch or sweep")
      ->check(existing_folder())
      ->type_name("DIR");
  command->add_flag("--figures", report->figures,
                    "for a sweep: also write tables (LaTeX, CSV) and figures (SVG, PDF) for a paper to DIR/figures");
  command->add_option("--column", report->column, "column of the figures; default: that of the page")
      ->type_name("NAME");
  command->add_flag("--replay", report->replay, "for a run: also write replay.html, the flight in 3-D");
  command
      ->add_option("--film-strips", report->film_strips,
                   "for a batch or sweep: number of worst flights to re-simulate up to their closest approach, for "
                   "their camera images")
      ->transform(whole_number())
      ->check(CLI::Range(0, 50))
      ->type_name("N");
  command->callback([&chosen, report] { chosen = [report] { return cli::report(*report); }; });
}

void declare_runs(CLI::App& app, std::function<int()>& chosen) {
  CLI::App* const command =
      app.add_subcommand("runs", "write index.html: a sortable table of all results in a folder tree");
  const auto folder = std::make_shared<std::filesystem::path>();
  command->add_option("DIR", *folder, "folder with results at any depth")->required()->check(existing_folder());
  command->callback([&chosen, folder] { chosen = [folder] { return cli::runs(*folder); }; });
}

}  // namespace

void declare_reports(CLI::App& app, std::function<int()>& chosen) {
  declare_report(app, chosen);
  declare_runs(app, chosen);
}

}  // namespace hedgehop::sim::cli
