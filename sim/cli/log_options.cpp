#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "sim/cli/campaign_options.h"
#include "sim/cli/log_commands.h"
#include "sim/cli/plot_file.h"

namespace hedgehop::sim::cli {
namespace {

void add_split(CLI::App& command, double& split) {
  command.add_option("--split", split, "share of the time of each log that is its first part; default 0.5")
      ->transform(number())
      ->check(CLI::Range(0.05, 0.95))
      ->type_name("SHARE");
}

void add_every(CLI::App& command, double& every_s, const std::string& meaning) {
  command.add_option("--every", every_s, meaning)->transform(number())->check(positive())->type_name("S");
}

void add_columns(CLI::App& command, std::filesystem::path& columns) {
  command.add_option("--columns", columns, "columns of the log with other names, units or signs (YAML)")
      ->type_name("MAP.yaml");
}

}  // namespace

void declare_compare_log(CLI::App& app, std::function<int()>& chosen, CompareLogOptions& options) {
  CLI::App* const command = app.add_subcommand(
      "compare-log",
      "replay the inputs of recorded flights from measured states, and print the errors of each state against the "
      "prediction horizon, next to those of simple predictions");
  command->add_option("VEHICLE", options.vehicle, "vehicle file (YAML)")->required();
  command->add_option("LOG", options.logs, "recorded flights (CSV)")->required();
  add_columns(*command, options.columns);
  command->add_option("--part", options.part, "part of each log: all (the default), first or second")
      ->check(CLI::IsMember({"all", "first", "second"}));
  command
      ->add_option("--horizon", options.horizons_s,
                   "duration of windows, s; may be repeated; default 0.1, 0.5, 1 and 2")
      ->transform(number())
      ->check(CLI::Range(0.001, 60.0))
      ->take_all()
      ->allow_extra_args(false)
      ->type_name("S");
  add_split(*command, options.split);
  add_every(*command, options.every_s, "time between the starts of windows, s; default 0.1");
  CLI::Option* const as_json = command->add_flag("--json", options.json, "print JSON instead of a table");
  command->add_flag("--csv", options.csv, "print comma-separated values")->excludes(as_json);
  command->add_option("--plot", options.plot, "also write a figure of the errors against the horizon")
      ->check(written_as(".svg"))
      ->type_name("FILE.svg");
  command->callback([&] { chosen = [&options] { return compare_log(options); }; });
}

void add_log_fit(CLI::App& command, IdentifyLogOptions& options) {
  const std::string group = "Fit to recorded flights";
  CLI::Option* const log = command.add_option("--log", options.logs, "recorded flight (CSV); may be repeated")
                               ->take_all()
                               ->allow_extra_args(false);
  log->type_name("LOG.csv")->group(group);
  command
      .add_option("--fit", options.fit,
                  "number of the vehicle or, with the prefix columns., of the column map, and its bounds as "
                  "NAME=LOW:HIGH; may be "
                  "repeated")
      ->take_all()
      ->allow_extra_args(false)
      ->needs(log)
      ->type_name("NAME=BOUNDS")
      ->group(group);
  add_columns(command, options.columns);
  command.get_option("--columns")->needs(log)->group(group);
  command
      .add_option("--horizon", options.horizon_s,
                  "duration of the fitted windows, s; default 0.5; 0 fits the specific force at the measured states")
      ->transform(number())
      ->check(CLI::Range(0.0, 10.0))
      ->needs(log)
      ->type_name("S")
      ->group(group);
  add_every(command, options.every_s, "time between the starts of windows, s; default 0.5");
  command.get_option("--every")->needs(log)->group(group);
  add_split(command, options.split);
  command.get_option("--split")->needs(log)->group(group);
  command.add_option("--out", options.out, "also write the fitted vehicle")
      ->needs(log)
      ->type_name("FILE.yaml")
      ->group(group);
  command.add_option("--out-columns", options.out_columns, "also write the fitted column map")
      ->needs(log)
      ->type_name("FILE.yaml")
      ->group(group);
}

}  // namespace hedgehop::sim::cli
