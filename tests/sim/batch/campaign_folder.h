#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sim/config/whole_file.h"
#include "tests/sim/record/temporary_folder.h"

namespace hedgehop::sim {

/// The output and exit status of a command.
struct CommandEnd {
  int status = 0;  ///< exit status; 128 and the signal's number when a signal ended it
  std::string out, err;
};

/// Returns a table without its last columns, which differ from run to run.
inline std::string lasting_columns(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, kept;
  size_t columns = 0;
  while (std::getline(lines, line)) {
    if (columns == 0) {
      const size_t end = line.find(",time.");
      columns = 1 + static_cast<size_t>(std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end), ','));
    }
    size_t end = 0;
    for (size_t i = 0; i < columns; ++i) end = line.find(',', end + (i > 0 ? 1 : 0));
    kept += line.substr(0, end) + "\n";
  }
  return kept;
}

/// Returns JSON without the fields that differ from run to run.
inline nlohmann::ordered_json lasting_fields(nlohmann::ordered_json json) {
  for (auto field = json.begin(); json.is_object() && field != json.end();) {
    const std::string& key = field.key();
    const bool differs = key.ends_with("_ms") || key == "realtime_factor" || key == "wall_s";
    field = differs ? json.erase(field) : std::next(field);
  }
  for (auto& part : json) {
    if (part.is_structured()) part = lasting_fields(std::move(part));
  }
  return json;
}

/// A folder with a scenario of 0.1 s, and the built program that flies it.
class CampaignFolder : public TemporaryFolder {
 public:
  CampaignFolder() {
    write("tiny.yaml", std::string("use: ") + HEDGEHOP_SOURCE_DIR +
                           "/configs/garratt2009_room_0_light.yaml\n"
                           "name: tiny\nduration: 0.1\nscene: {texture_size: 64}\nvelocimeter: {enabled: false}\n"
                           "rig: {cameras: [{role: front, width: 16, height: 16, fov: 90, rate: 25, channel: grey}]}\n"
                           "avoidance: {module: go_to_goal}\ngoal: {north: 5, east: 0, altitude: 1, radius: 1}\n"
                           "checks: [{check: no_collision}]\n"
                           "drawing: {renderer: tiles}\n");
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    write_file_whole(path() / name, text);
    return path() / name;
  }
  /// Returns a worker program. @param body  shell script, in which $seed is the flight's seed and `fly` flies it.
  std::string worker(const std::string& body) const {
    const std::filesystem::path file =
        write("worker.sh", "#!/bin/sh\nseed=$(echo \"$*\" | sed 's/.*--seed \\([0-9]*\\).*/\\1/')\nfly() { exec " +
                               std::string(HEDGEHOP_PROGRAM) + " \"$@\"; }\n" + body + "\n");
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file.string();
  }
  /// Runs `hedgehop ARGUMENTS` with a shell in this folder.
  CommandEnd hedgehop(const std::string& arguments) const { return shell(HEDGEHOP_PROGRAM " " + arguments); }
  CommandEnd shell(const std::string& command) const {
    const std::string line = "cd '" + path().string() + "' && { " + command + "; } >stdout.txt 2>stderr.txt";
    const int status = std::system(line.c_str());
    CommandEnd end{.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
    end.out = read("stdout.txt");
    end.err = read("stderr.txt");
    return end;
  }
  std::string read(const std::string& name) const { return read_file_whole(path() / name); }
  nlohmann::ordered_json json(const std::string& name) const { return nlohmann::ordered_json::parse(read(name)); }
};

/// Returns a JUnit file as read by an independent XML parser: one line "suite/case result message" per case.
inline std::string junit_cases(const CampaignFolder& folder, const std::string& file) {
  folder.write(
      "read_junit.py",
      "import sys, xml.etree.ElementTree as tree\n"
      "for suite in tree.parse(sys.argv[1]).getroot():\n"
      "    for case in suite.findall('testcase'):\n"
      "        wrong = [w for w in case if w.tag != 'system-out']\n"
      "        print(suite.get('name') + '/' + case.get('name'), *[w.tag + ' ' + w.get('message') for w in wrong])\n"
      "        print('  ' + case.find('system-out').text.replace('\\n', ' '))\n");
  const CommandEnd read = folder.shell("python3 read_junit.py " + file);
  return read.status == 0 ? read.out : "no JUnit file: " + read.err;
}

}  // namespace hedgehop::sim
