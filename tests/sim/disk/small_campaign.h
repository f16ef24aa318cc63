#pragma once

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tests/sim/batch/campaign_folder.h"

namespace hedgehop::sim {

/// Campaigns of four flights of 0.1 s each, on a disk with injected faults.
class SmallCampaign : public CampaignFolder {
 public:
  SmallCampaign() {
    write("gains.yaml", "scenario: tiny.yaml\nseeds: 1:2\nparameters: [{path: avoidance.speed, values: [1, 2]}]\n");
    write("paper.yaml",
          "title: small\nsource: nobody\ntuned_on: none\n"
          "flights: [{scenario: tiny.yaml, seeds: 1:3}, {name: fast, scenario: tiny.yaml, seeds: 1, set: "
          "[avoidance.speed=2]}]\n"
          "rows: [{claim: length, unit: m, flights: [tiny, fast], column: path_length_m, statistic: max}]\n");
    write("far.yaml",
          "use: tiny.yaml\nname: far\nchecks: [{check: formula, name: far, formula: always (north <= -1)}]\n");
    write("search.yaml",
          "scenario: far.yaml\nparameters: [{path: avoidance.speed, from: 1, to: 3, neutral: 1}]\n"
          "design: {method: random, budget: 4, failures: 1, shrinking: 2, seed: 1}\n");
  }

  static constexpr std::string_view kCommands[] = {"batch", "sweep", "reproduce"};
  /// A batch that stops at a claim, and a search that finds and reduces a failure.
  static constexpr std::string_view kSequences[] = {"until", "falsify"};

  /// Returns the exit status of a command that is not disturbed.
  static int status(std::string_view command) { return command == "falsify" ? 1 : 0; }

  /// Returns the arguments of a command. Repeating the command resumes an interrupted one.
  static std::string arguments(std::string_view command, std::string_view out, int workers) {
    const std::string options = fmt::format(" -j {} --out {}", workers, out);
    if (command == "batch") return "batch tiny.yaml --seeds 1:4 --resume" + options;
    if (command == "until") return "batch tiny.yaml --seeds 1:9 --until 'collision < 0.6' --resume" + options;
    if (command == "falsify") return "falsify search.yaml" + options;
    return std::string(command) + (command == "sweep" ? " gains.yaml" : " paper.yaml") + options;
  }

  /// Runs a command without faults into the folder `out`, returns the contents of the folder and removes it.
  std::map<std::string, std::string> fly_undisturbed(std::string_view command) const {
    const int workers = command == "until" ? 1 : 2;  // one worker flies no flight past the stop of a batch
    const CommandEnd end =
        shell(on_failing_disk("out", "none", 0) + HEDGEHOP_PROGRAM " " + arguments(command, "out", workers));
    if (end.status != status(command)) throw std::runtime_error(end.err);
    auto files = lasting_files("out");
    std::filesystem::remove_all(path() / "out");
    return files;
  }

  /// Returns the environment of a command that injects a fault into the `at`-th call below `out` (failing_disk.cpp).
  std::string on_failing_disk(std::string_view out, std::string_view fault, uint64_t at) const {
    write("counter", std::string(2 * sizeof(uint64_t), '\0'));
    // AddressSanitizer requires that it is the first library.
    return fmt::format(
        "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD={} FAILING_DISK_FOLDER={} FAILING_DISK_COUNTER={} "
        "FAILING_DISK_FAULT={} FAILING_DISK_AT={} ",
        FAILING_DISK, (path() / out).string(), (path() / "counter").string(), fault, at);
  }
  /// Returns the number of calls of the last command below its folder.
  uint64_t calls() const {
    uint64_t count = 0;
    std::memcpy(&count, read("counter").data(), sizeof count);
    return count;
  }

  /// Returns the text of every file below a folder by relative path, without the parts that differ from run to run. For
  /// a page and a database it records only that they exist.
  std::map<std::string, std::string> lasting_files(std::string_view out) const {
    std::map<std::string, std::string> files;
    const std::filesystem::path folder = path() / out;
    if (!std::filesystem::exists(folder)) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string ending = entry.path().extension(), text = read_file_whole(entry.path());
      std::string& lasting = files[entry.path().lexically_relative(folder)];
      if (ending == ".json") lasting = lasting_fields(nlohmann::ordered_json::parse(text)).dump(1);
      if (ending == ".csv") lasting = text.find(",time.") == std::string::npos ? text : lasting_columns(text);
      if (ending == ".yaml" || ending == ".md") lasting = text;
    }
    return files;
  }
};

/// Returns the names of files whose text differs or that exist on one side only.
inline std::vector<std::string> differences(const std::map<std::string, std::string>& a,
                                            const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, text] : a) {
    if (const auto found = b.find(name); found == b.end() || found->second != text) names.push_back(name);
  }
  for (const auto& [name, text] : b) {
    if (!a.contains(name)) names.push_back(name);
  }
  return names;
}

/// Returns the number of trials: from an environment variable (scripts/soak), otherwise `usual`.
inline int count_asked(const char* variable, int usual) {
  const char* const text = std::getenv(variable);
  return text ? std::atoi(text) : usual;
}

}  // namespace hedgehop::sim
