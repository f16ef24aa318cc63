#include "sim/cli/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "sim/flight/build.h"

namespace hedgehop::sim::cli {
namespace {

struct Example {
  const char* command;
  const char* line;
  const char* purpose;  ///< empty if the line is clear without it
};

/// Lines that run from a folder with configs/, in this order. tests/docs/commands_test.py runs each.
constexpr Example kExamples[] = {
    {"run", "hedgehop run configs/quickstart.yaml --out out/quickstart", ""},
    {"run", "hedgehop run configs/local_map_city.yaml --renderer tiles", ""},
    {"run", "hedgehop run configs/garratt2009_city_0.yaml --seed 7 --set avoidance.flow_gain=3 --no-video --json", ""},
    {"run", "hedgehop run configs/links/hover_quad.yaml --out out/hover", "ArduPilot flies"},
    {"run", "hedgehop run configs/links/hover_quad.yaml --replay-link out/hover/link.bin", "the same flight again"},
    {"render", "hedgehop render configs/garratt2009_city_0.yaml --camera front --time 12 -o front.png", ""},
    {"render", "hedgehop render configs/garratt2009_city_0.yaml --camera front --what flow -o flow.png", ""},
    {"render", "hedgehop render --info", "the renderers of this machine"},
    {"calibration", "hedgehop calibration configs/garratt2009_city_0.yaml --format kalibr -o chain.yaml", ""},
    {"import", "hedgehop import aerialist configs/fields/two_boxes.yaml -o two_boxes.yaml", ""},
    {"batch", "hedgehop batch configs/campaigns/garratt2009_room.yaml -j 2", "a campaign file"},
    {"batch", "hedgehop batch configs/quickstart.yaml --seeds 1:4 --out out/ci --junit checks.xml", "checks in CI"},
    {"batch", "hedgehop batch configs/garratt2009_room_0_light.yaml --seeds 1:20 --min-success 0.7", "a success rate"},
    {"batch", "hedgehop batch configs/garratt2009_room_0_light.yaml --seeds 1101:1600 --until \"collision < 0.05\"",
     "a sequential test"},
    {"batch", "hedgehop batch configs/campaigns/leaderboard.yaml --resume", "every module in every world"},
    {"compare",
     "hedgehop compare configs/garratt2009_city_0_control.yaml configs/garratt2009_city_0_light.yaml --seeds 1101:1200 "
     "--until \"collision: better\"",
     ""},
    {"sweep", "hedgehop sweep configs/sweeps/garratt2009_room_gains.yaml", ""},
    {"sweep", "hedgehop sweep configs/sweeps/garratt2009_room_gains.yaml --on slurm --dry-run", "the batch scripts"},
    {"falsify", "hedgehop falsify configs/falsify/gps_offset.yaml", ""},
    {"branch", "hedgehop branch out/quickstart --at 10 --set avoidance.flow_gain=3 --out out/branches", ""},
    {"reproduce", "hedgehop reproduce zingg2010 --quick", ""},
    {"bless", "hedgehop bless out/quickstart --reason \"inspected in report.html\"", ""},
    {"export", "hedgehop export out/quickstart --format euroc --truth", ""},
    {"export", "hedgehop export out/quickstart --format mcap", "for Foxglove and PlotJuggler"},
    {"export", "hedgehop export out/quickstart --format rosbag2", "for `ros2 bag play`"},
    {"dataset", "hedgehop dataset configs/worlds/park.yaml --seeds 1:3 --images 6 --renderer tiles --out out/images",
     "random poses"},
    {"report", "hedgehop report out/quickstart --replay", "report.html, and replay.html in 3-D"},
    {"report", "hedgehop report out/garratt2009_room --against out/before", "with the changes since out/before"},
    {"report", "hedgehop report out/garratt2009_room --film-strips 10", "with images of the worst flights"},
    {"runs", "hedgehop runs out", "out/index.html"},
    {"validate", "hedgehop validate configs/worlds", "without flying"},
    {"list", "hedgehop list modules", ""},
    {"list", "hedgehop list scenario", ""},
    {"trim", "hedgehop trim configs/vehicles/xcell_60.yaml --speed -4:20:4 --plot trim.html", ""},
    {"linearize", "hedgehop linearize configs/vehicles/s900.yaml --speed 5", ""},
    {"step", "hedgehop step configs/vehicles/xcell_60.yaml --input longitudinal --size 1deg --plot step.html", ""},
    {"step", "hedgehop step configs/vehicles/s900.yaml --input roll --size 0.5Nm --shape doublet --width 0.3", ""},
    {"identify", "hedgehop identify configs/vehicles/xcell_60.yaml --input lateral --plot lateral.html", ""},
    {"identify",
     "hedgehop identify configs/vehicles/hummingbird.yaml --log configs/logs/hummingbird_example.csv "
     "--fit rotor.drag=0:1e-3",
     "a fit to a recorded flight"},
    {"compare-log", "hedgehop compare-log configs/vehicles/hummingbird.yaml configs/logs/hummingbird_example.csv", ""},
    {"schema", "hedgehop schema > scenario.schema.json", ""},
    {"manual", "hedgehop manual man | man -l -", ""},
};

struct ExitStatus {
  int status;
  const char* meaning;
};

constexpr ExitStatus kExitStatuses[] = {
    {0, "all checks hold, or the best point of an optimizing sweep costs less than its failure_cost"},
    {1, "a check fails, a claim is refuted, or a flight cannot be flown to its end"},
    {2,
     "the input is bad, or the output folder cannot be created: one line per fault on standard error. Only the valid "
     "scenarios of a batch are flown"},
    {3, "internal error, or results that cannot be written later"},
    {4,
     "undecided: after the last seed, the claim of --until is neither shown nor refuted (add seeds and --resume); "
     "or a search for failures confirmed none, although flights were not flown or failures depend on the seed"},
    {130, "interrupted (Ctrl-C, SIGINT)"},
    {143, "terminated (SIGTERM)"},
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

std::vector<const Example*> examples_of(std::string_view command) {
  std::vector<const Example*> found;
  for (const Example& example : kExamples) {
    if (command == example.command) found.push_back(&example);
  }
  return found;
}

/// "--format euroc|tum|kitti", "-j, --jobs UINT" or "SCENARIO", with each part passed through `name` or `value`.
template <class Name, class Value>
std::string usage_of(const ManualEntry& entry, Name name, Value value) {
  if (entry.names.empty()) return value(entry.name);
  std::string usage;
  for (const std::string& each : entry.names) usage += (usage.empty() ? "" : ", ") + name(each);
  if (!entry.choices.empty()) return usage + " " + name(fmt::format("{}", fmt::join(entry.choices, "|")));
  return entry.value.empty() ? usage : usage + " " + value(entry.value);
}

// --- man ---

/// Text with the escapes of roff; no line begins with a request.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(replaced(text, "\\", "\\e"), "-", "\\-"), "\n", " ");
  if (escaped.starts_with('.') || escaped.starts_with('\'')) escaped.insert(0, "\\&");
  return escaped;
}

std::string roff_of(const std::vector<ManualEntry>& all) {
  const auto bold = [](const std::string& text) { return "\\fB" + roff(text) + "\\fR"; };
  const auto italic = [](const std::string& text) { return "\\fI" + roff(text) + "\\fR"; };
  std::string text;
  for (const ManualEntry& entry : all) {
    text += ".TP\n" + usage_of(entry, bold, italic) + "\n" + roff(entry.meaning) + "\n";
  }
  return text;
}

constexpr const char* kManEnd = R"(.SH FILES
Of a package, below /usr:
.TP
.I share/hedgehop/configs
Scenarios, vehicles, camera rigs, campaigns. Copy this folder to your working folder to run the commands of the
documentation: cp \-r /usr/share/hedgehop/configs .
.TP
.I share/doc/hedgehop
README.md, docs/ and the examples.
.SH SEE ALSO
hedgehop list scenario, for every key of a scenario; hedgehop schema, for editors
)";

std::string man(const CLI::App& app) {
  std::string text = fmt::format(".TH HEDGEHOP 1 \"\" \"Hedgehop {}\"\n.SH NAME\nhedgehop \\- {}\n", version(),
                                 "closed\\-loop simulator of vision\\-based obstacle avoidance");
  text += ".SH SYNOPSIS\n.B hedgehop\n.I COMMAND\n[\\fIOPTION\\fR]...\n.SH DESCRIPTION\n" +
          roff(app.get_description()) + "\n.SH COMMANDS\n";
  std::string examples = ".SH EXAMPLES\n.nf\n";
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    text += fmt::format(".SS hedgehop {}\n{}\n{}", roff(command->get_name()), roff(command->get_description()),
                        roff_of(manual_entries(*command)));
    for (const Example* example : examples_of(command->get_name())) examples += roff(example->line) + "\n";
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitStatus& row : kExitStatuses) text += fmt::format(".TP\n.B {}\n{}\n", row.status, roff(row.meaning));
  return text + examples + ".fi\n" + kManEnd;
}

// --- Markdown ---

/// Text for a table cell.
std::string cell(std::string text) {
  for (const auto& [pattern, replacement] : {std::pair{"|", "\\|"}, {"<", "\\<"}, {"\n", " "}}) {
    text = replaced(text, pattern, replacement);
  }
  return text;
}

std::string table_of(const std::vector<ManualEntry>& all) {
  const auto plain = [](const std::string& text) { return text; };
  std::string text;
  for (const ManualEntry& entry : all) {
    if (entry.name == "--help") continue;
    if (text.empty()) text = "\n| option | meaning |\n|---|---|\n";
    text += fmt::format("| `{}` | {}{} |\n", replaced(usage_of(entry, plain, plain), "|", "\\|"),
                        entry.is_required ? "required; " : "", cell(entry.meaning));
  }
  return text;
}

std::string markdown(const CLI::App& app) {
  std::string text =
      "# Commands\n\nGenerated by `hedgehop manual markdown` from the options' definitions: do not edit. The examples "
      "run in a folder with\n`configs/`; `hedgehop COMMAND --help` prints the same options.\n\n| command | purpose "
      "|\n|---|---|\n";
  std::string sections;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    const std::string& name = command->get_name();
    std::string purpose = cell(command->get_description());
    text += fmt::format("| [{0}](#{0}) | {1} |\n", name, purpose);
    purpose.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(purpose.front())));
    sections += fmt::format("\n## {}\n\n{}.\n{}", name, purpose, table_of(manual_entries(*command)));
    if (const auto examples = examples_of(name); !examples.empty()) {
      sections += "\n```sh\n";
      for (const Example* example : examples) {
        sections += fmt::format("{}{}{}\n", example->line, *example->purpose ? "    # " : "", example->purpose);
      }
      sections += "```\n";
    }
  }
  text += "\n## Exit status\n\n| status | meaning |\n|---|---|\n";
  for (const ExitStatus& row : kExitStatuses) text += fmt::format("| {} | {} |\n", row.status, cell(row.meaning));
  return text + sections;
}

}  // namespace

std::vector<ManualEntry> manual_entries(const CLI::App& command) {
  std::vector<ManualEntry> all;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty()) continue;  // hidden
    ManualEntry entry;
    for (const std::string& name : option->get_snames()) entry.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) entry.names.push_back("--" + name);
    entry.name = entry.names.empty() ? option->get_name() : entry.names.back();
    const std::string type = option->get_type_name();
    if (option->get_items_expected_max() > 0) entry.value = type.substr(0, type.find_first_of(": "));
    entry.choices = choices_in(type);
    entry.is_folder = entry.value == "DIR" || type.find("DIR") != std::string::npos;
    entry.is_required = option->get_required();
    entry.meaning = option->get_description();
    all.push_back(entry);
  }
  return all;
}

std::string replaced(std::string text, std::string_view pattern, std::string_view replacement) {
  for (size_t at = 0; (at = text.find(pattern, at)) != std::string::npos; at += replacement.size()) {
    text.replace(at, pattern.size(), replacement);
  }
  return text;
}

std::string manual(const CLI::App& app, std::string_view format) {
  if (format == "man") return man(app);
  if (format == "markdown") return markdown(app);
  throw std::invalid_argument("unknown format of the manual");
}

}  // namespace hedgehop::sim::cli
