#include "sim/cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "sim/flight/build.h"

namespace hedgehop::sim::cli {
namespace {

/// An option or positional as the shells need it.
struct Entry {
  std::string name;                  ///< "--seed", "-j"; of a positional its placeholder
  std::vector<std::string> names;    ///< all of them, short ones first; none of a positional
  std::string value;                 ///< placeholder of what follows; empty of a flag
  std::vector<std::string> choices;  ///< where only these may follow
  std::string meaning;
  bool is_folder = false;
};

std::vector<std::string> choices_in(const std::string& type) {
  std::vector<std::string> choices;
  const size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return choices;
  for (size_t begin = open + 1; begin < close;) {
    const size_t end = std::min(type.find(',', begin), close);
    choices.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return choices;
}

std::vector<Entry> entries(const CLI::App& command) {
  std::vector<Entry> all;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;
    Entry entry;
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    entry.name = entry.names.empty() ? option->get_name() : entry.names.back();
    const std::string type = option->get_type_name();
    if (option->get_items_expected_max() > 0) entry.value = type.substr(0, type.find_first_of(": "));
    entry.choices = choices_in(type);
    entry.is_folder = entry.value == "DIR" || type.find("DIR") != std::string::npos;
    entry.meaning = option->get_description();
    all.push_back(entry);
  }
  return all;
}

std::vector<const CLI::App*> commands(const CLI::App& app) { return app.get_subcommands(nullptr); }

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

// --- man ---

/// Text in roff: its escapes, and no line that begins with a request.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(replaced(text, "\\", "\\e"), "-", "\\-"), "\n", " ");
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
  return escaped;
}

std::string roff_of(const std::vector<Entry>& all) {
  std::string text;
  for (const Entry& entry : all) {
    std::string head;
    for (const std::string& name : entry.names) head += (head.empty() ? "\\fB" : ", \\fB") + roff(name) + "\\fR";
    if (entry.names.empty()) head = "\\fI" + roff(entry.name) + "\\fR";
    if (!entry.names.empty() && !entry.choices.empty()) {
      head += " " + roff(fmt::format("{}", fmt::join(entry.choices, "|")));
    } else if (!entry.names.empty() && !entry.value.empty()) {
      head += " \\fI" + roff(entry.value) + "\\fR";
    }
    text += ".TP\n" + head + "\n" + roff(entry.meaning) + "\n";
  }
  return text;
}

constexpr const char* kManEnd = R"(.SH FILES
Of a package, below /usr:
.TP
.I share/hedgehop/configs
Scenarios, vehicles, camera rigs, campaigns. Copy the folder to where you work, and every command of the documentation
runs there as written: cp \-r /usr/share/hedgehop/configs .
.TP
.I share/doc/hedgehop
README.md, docs/ and their examples.
.SH EXAMPLES
.nf
hedgehop run configs/quickstart.yaml
hedgehop batch configs/quickstart.yaml \-\-seeds 1:4 \-\-junit checks.xml
hedgehop reproduce zingg2010 \-\-quick
.fi
.SH SEE ALSO
hedgehop list scenario, for every key of a scenario; hedgehop schema, for editors
)";

std::string man(const CLI::App& app) {
  std::string text = fmt::format(".TH HEDGEHOP 1 \"\" \"Hedgehop {}\"\n.SH NAME\nhedgehop \\- {}\n", version(),
                                 "closed\\-loop simulator of vision\\-based obstacle avoidance");
  text += ".SH SYNOPSIS\n.B hedgehop\n.I COMMAND\n[\\fIOPTION\\fR]...\n.SH DESCRIPTION\n" +
          roff(app.get_description()) + "\n.SH COMMANDS\n";
  for (const CLI::App* command : commands(app)) {
    text += fmt::format(".SS hedgehop {}\n{}\n{}", roff(command->get_name()), roff(command->get_description()),
                        roff_of(entries(*command)));
  }
  return text + ".SH EXIT STATUS\n" + roff(app.get_footer()) + "\n" + kManEnd;
}

// --- bash ---

std::string bash(const CLI::App& app) {
  std::vector<std::string> names;
  std::string values, options;
  for (const CLI::App* command : commands(app)) {
    const std::string name = command->get_name();
    names.push_back(name);
    std::vector<std::string> dashed, bare;
    for (const Entry& entry : entries(*command)) {
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
    for (const auto& [what, by] : {std::pair{"'", "'\\''"}, {"[", "\\["}, {"]", "\\]"}, {":", "\\:"}, {"\n", " "}}) {
      text = replaced(text, what, by);
    }
    return text;
  };
  std::string names, cases;
  for (const CLI::App* command : commands(app)) {
    names += fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description()));
    std::string specs;
    for (const Entry& entry : entries(*command)) {
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
  for (const CLI::App* command : commands(app)) {
    const std::string& name = command->get_name();
    text += fmt::format("complete -c hedgehop -f -n __fish_use_subcommand -a {} -d {}\n", name,
                        quoted(command->get_description()));
    for (const Entry& entry : entries(*command)) {
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

std::string manual(const CLI::App& app, std::string_view format) {
  if (format == "man") return man(app);
  if (format == "bash") return bash(app);
  if (format == "zsh") return zsh(app);
  if (format == "fish") return fish(app);
  throw std::invalid_argument("no manual of this format");
}

}  // namespace hedgehop::sim::cli
