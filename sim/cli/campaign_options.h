#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace hedgehop::sim::cli {

/// Adds --set KEY.PATH=VALUE. Each --set takes exactly one value, so a scenario file may follow it.
inline void add_overrides(CLI::App& command, std::vector<std::string>& overrides, const std::string& meaning) {
  command.add_option("--set", overrides, meaning)->type_name("KEY.PATH=VALUE")->take_all()->allow_extra_args(false);
}

/// Accepts the path of a folder.
CLI::Validator existing_folder();

// Numbers of options, read like those of a scenario: decimal, finite, without integer wrap-around. Attach these
// validators with transform() before any range check.

/// Accepts whole numbers from 0 to 2^64 - 1; "010" is ten.
CLI::Validator whole_number();

/// Accepts any finite number.
CLI::Validator number();

/// Require a number >= 0 (not_negative) or > 0 (positive).
CLI::Validator not_negative();
CLI::Validator positive();

/// Adds the options of flights in worker processes: --jobs, --limit and --reuse-other-builds.
template <class Options>
void add_flying(CLI::App& command, Options& options,
                const std::string& over_limit = "then the flight is killed and fails") {
  command
      .add_option("-j,--jobs", options.jobs,
                  "number of flights in parallel; default the cores that this process may use (affinity, CPU quota)")
      ->transform(whole_number())
      ->check(CLI::Range(1, 4096));
  command.add_option("--limit", options.limit_s, "maximum wall time of a flight, s; " + over_limit)
      ->transform(number())
      ->check(positive())
      ->type_name("S");
  command.add_flag("--reuse-other-builds", options.reuse_other_builds,
                   "also reuse results of other builds of Hedgehop; every row names its build");
}

/// Declares the commands that fly many scenarios. Parsing stores the call of the selected command in `chosen`.
void declare_campaigns(CLI::App& app, std::function<int()>& chosen);
void declare_batch(CLI::App& app, std::function<int()>& chosen);

}  // namespace hedgehop::sim::cli
