#include "sim/cli/commands.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

#include "sim/config/config_tree.h"

namespace hedgehop::sim::cli {

std::string unknown_command(const CLI::App& app, std::string_view word) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end()) return {};
  if (word == "estimate") return "the command 'estimate' was removed; to bound a rate, use `hedgehop batch --until`";
  return fmt::format("unknown command '{}'{} (see --help)", word, suggestion(word, {names.begin(), names.end()}));
}

std::string unknown_option(const CLI::App& app) {
  std::vector<std::string> names;
  std::vector<const CLI::App*> parsed;
  for (const CLI::App* command : app.get_subcommands()) parsed.push_back(command);
  if (parsed.empty()) parsed = {&app};
  for (const CLI::App* command : parsed) {
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_group().empty()) continue;  // hidden
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
  }
  for (const std::string& word : app.remaining(/*recurse=*/true)) {
    if (word.starts_with("--renderer") && std::ranges::find(names, "--set") != names.end()) {
      const bool sets_search = app.get_subcommands().front()->get_name() == "falsify";
      const std::string_view where =
          sets_search ? "write set: [drawing.renderer=tiles] in the file" : "use --set drawing.renderer=tiles";
      return fmt::format("unknown option '{}'; {} (see --help)", word, where);
    }
    if (word.starts_with("-") && word.size() > 1) {
      return fmt::format("unknown option '{}'{} (see --help)", word, suggestion(word, {names.begin(), names.end()}));
    }
  }
  return {};
}

}  // namespace hedgehop::sim::cli
