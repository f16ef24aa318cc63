#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <utility>

#include "sim/cli/manual.h"

namespace hedgehop::sim::cli {
namespace {

// --- bash ---

std::string bash(const CLI::App& app) {
  std::vector<std::string> names;
  std::string values, options;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    const std::string name = command->get_name();
    names.push_back(name);
    std::vector<std::string> dashed, bare;
    for (const ManualEntry& entry : manual_entries(*command)) {
      dashed.insert(dashed.end(), entry.names.begin(), entry.names.end());
      if (entry.names.empty()) bare.insert(bare.end(), entry.choices.begin(), entry.choices.end());
      if (entry.names.empty() || entry.value.empty()) continue;
      const std::string words = entry.choices.empty() ? fmt::format("-{}", entry.is_folder ? "d" : "f")
                                                      : fmt::format("-W '{}'", fmt::join(entry.choices, " "));
      for (const std::string& each : entry.names) {
        values += fmt::format("    '{} {}') COMPREPLY=($(compgen {} -- \"$current\")); return ;;\n", name, each, words);
      }
    }
    options += fmt::format("    {}) options='{}' words='{}' ;;\n", name, fmt::join(dashed, " "), fmt::join(bare, " "));
  }
  return fmt::format(
      R"(# bash completion of hedgehop; made by `hedgehop manual bash`
_hedgehop() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command= options= words= word
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    if [[ $word != -* ]]; then command=$word; break; fi
  done
  case "$command $before" in
{}  esac
  case $command in
    '') options='--help --version' words='{}' ;;
{}  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [[ -n $words ]]; then
    COMPREPLY=($(compgen -W "$words" -- "$current"))
  elif [[ -n $command ]]; then
    COMPREPLY=($(compgen -f -- "$current"))
  fi
}}
complete -o filenames -F _hedgehop hedgehop
)",
      values, fmt::join(names, " "), options);
}

// --- zsh ---

std::string zsh(const CLI::App& app) {
  const auto quoted = [](std::string text) {
    for (const auto& [pattern, replacement] :
         {std::pair{"'", "'\\''"}, {"[", "\\["}, {"]", "\\]"}, {":", "\\:"}, {"\n", " "}}) {
      text = replaced(text, pattern, replacement);
    }
    return text;
  };
  std::string names, cases;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description()));
    std::string specs;
    for (const ManualEntry& entry : manual_entries(*command)) {
      const std::string action = !entry.choices.empty() ? fmt::format("({})", fmt::join(entry.choices, " "))
                                 : entry.is_folder      ? "_files -/"
                                                        : "_files";
      if (entry.names.empty()) {
        specs += fmt::format(" \\\n        '*:{}:{}'", quoted(entry.name), action);
        continue;
      }
      const std::string follows = entry.value.empty() ? "" : fmt::format(":{}:{}", quoted(entry.value), action);
      for (const std::string& each : entry.names) {
        specs += fmt::format(" \\\n        '{}[{}]{}'", each, quoted(entry.meaning), follows);
      }
    }
    cases += fmt::format("      {})\n        _arguments{}\n        ;;\n", command->get_name(), specs);
  }
  return fmt::format(R"(#compdef hedgehop
# zsh completion of hedgehop; made by `hedgehop manual zsh`
_hedgehop() {{
  local state
  local -a commands
  commands=(
{}  )
  _arguments '--help[print help]' '--version[print the version]' '1:command:->command' '*::argument:->argument'
  case $state in
    command) _describe command commands ;;
    argument)
      case $words[1] in
{}      esac
      ;;
  esac
}}
_hedgehop "$@"
)",
                     names, cases);
}

// --- fish ---

std::string fish(const CLI::App& app) {
  const auto quoted = [](const std::string& text) {
    return "'" + replaced(replaced(replaced(text, "\\", "\\\\"), "'", "\\'"), "\n", " ") + "'";
  };
  std::string text = "# fish completion of hedgehop; made by `hedgehop manual fish`\n";
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    const std::string& name = command->get_name();
    text += fmt::format("complete -c hedgehop -f -n __fish_use_subcommand -a {} -d {}\n", name,
                        quoted(command->get_description()));
    for (const ManualEntry& entry : manual_entries(*command)) {
      text += fmt::format("complete -c hedgehop -n '__fish_seen_subcommand_from {}'", name);
      for (const std::string& each : entry.names) {
        text += each.starts_with("--") ? " -l " + each.substr(2) : " -s " + each.substr(1);
      }
      if (!entry.choices.empty()) text += fmt::format(" -x -a '{}'", fmt::join(entry.choices, " "));
      if (entry.choices.empty() && !entry.value.empty()) text += entry.names.empty() ? " -F" : " -r -F";
      text += " -d " + quoted(entry.meaning) + "\n";
    }
  }
  return text;
}

}  // namespace

std::string completions(const CLI::App& app, std::string_view shell) {
  if (shell == "bash") return bash(app);
  if (shell == "zsh") return zsh(app);
  if (shell == "fish") return fish(app);
  throw std::invalid_argument("unknown shell");
}

}  // namespace hedgehop::sim::cli
