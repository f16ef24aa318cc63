#include "sim/batch/leaderboard.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>

#include "sim/config/input_error.h"
#include "sim/record/whole_file.h"

namespace hedgehop::sim {
namespace {

using Json = nlohmann::ordered_json;

template <class Named>
std::set<std::string> names_of(const std::vector<Named>& all, std::vector<std::string>& faults) {
  std::set<std::string> names;
  for (const Named& one : all) {
    if (!names.insert(one.name).second) faults.push_back(fmt::format("leaderboard: '{}' stands twice", one.name));
  }
  return names;
}

}  // namespace

Leaderboard leaderboard_of(const LeaderboardConfig& config) {
  std::vector<std::string> faults;
  const std::set<std::string> worlds = names_of(config.worlds, faults), modules = names_of(config.modules, faults);
  Leaderboard board{.worlds = config.worlds, .modules = config.modules, .cells = {}};
  for (const LeaderboardWorld& world : config.worlds) {
    for (const LeaderboardModule& module : config.modules) board.cells.push_back({world.name, module.name, "", ""});
  }
  for (const LeaderboardGap& gap : config.not_flown) {
    if (!modules.contains(gap.module)) faults.push_back(fmt::format("leaderboard: no module '{}'", gap.module));
    if (gap.reason.empty())
      faults.push_back(fmt::format("leaderboard: '{}' is not flown without a reason", gap.module));
    for (const std::string& world : gap.worlds) {
      if (!worlds.contains(world)) faults.push_back(fmt::format("leaderboard: no world '{}'", world));
      for (LeaderboardCell& cell : board.cells) {
        if (cell.world == world && cell.module == gap.module) cell.reason = gap.reason;
      }
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return board;
}

void write_leaderboard(const std::filesystem::path& folder, const Leaderboard& board) {
  Json json{{"worlds", Json::array()}, {"modules", Json::array()}, {"cells", Json::array()}};
  for (const LeaderboardWorld& world : board.worlds) json["worlds"].push_back({{"name", world.name}});
  for (const LeaderboardModule& module : board.modules) {
    json["modules"].push_back({{"name", module.name}, {"control", module.control}});
  }
  for (const LeaderboardCell& cell : board.cells) {
    json["cells"].push_back(
        {{"world", cell.world}, {"module", cell.module}, {"group", cell.group}, {"reason", cell.reason}});
  }
  std::filesystem::create_directories(folder);
  write_file_whole(folder / kLeaderboardFile, json.dump(1) + "\n");
}

void forget_leaderboard(const std::filesystem::path& folder) {
  std::filesystem::remove(folder / kLeaderboardFile);
  std::filesystem::remove(folder / "leaderboard.md");
}

}  // namespace hedgehop::sim
