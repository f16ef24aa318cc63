#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hedgehop::sim {

/// A world of a leaderboard: all of a scenario but what flies.
struct LeaderboardWorld {
  std::string name, scenario;
};
template <class Visitor>
void describe(Visitor& v, LeaderboardWorld& c) {
  v("name", c.name, {.required = true, .meaning = "in the matrix"});
  v("scenario", c.scenario, {.required = true, .meaning = "scenario file without what flies, relative to this file"});
}

/// A module with the aircraft and cameras that it needs.
struct LeaderboardModule {
  std::string name;
  bool control = false;
  std::vector<std::string> set;
};
template <class Visitor>
void describe(Visitor& v, LeaderboardModule& c) {
  v("name", c.name, {.required = true, .meaning = "in the matrix"});
  v("control", c.control, {.meaning = "flies without looking: it does not count for the difficulty of worlds"});
  v("set", c.set,
    {.required = true, .meaning = "overrides of each world: vehicle, rig, avoidance; files relative to the world's"});
}

/// Why a module flies in some worlds not at all.
struct LeaderboardGap {
  std::string module, reason;
  std::vector<std::string> worlds;
};
template <class Visitor>
void describe(Visitor& v, LeaderboardGap& c) {
  v("module", c.module, {.required = true, .meaning = "name of a module"});
  v("worlds", c.worlds, {.required = true, .meaning = "names of worlds"});
  v("reason", c.reason, {.required = true, .meaning = "why it cannot fly there"});
}

/// Every module in every world.
struct LeaderboardConfig {
  std::string seeds;
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardGap> not_flown;
};
template <class Visitor>
void describe(Visitor& v, LeaderboardConfig& c) {
  v("seeds", c.seeds, {.required = true, .meaning = "the same for all, such as 1:10"});
  v("worlds", c.worlds, {.required = true, .meaning = "what is flown in"});
  v("modules", c.modules, {.required = true, .meaning = "what flies"});
  v("not_flown", c.not_flown, {.meaning = "what cannot be flown, and why"});
}

/// A module in a world: the group of flights that differ by the seed alone, or why there are none.
struct LeaderboardCell {
  std::string world, module, group, reason;
};

/// What the matrix is made of.
struct Leaderboard {
  std::vector<LeaderboardWorld> worlds;
  std::vector<LeaderboardModule> modules;
  std::vector<LeaderboardCell> cells;  ///< one for each world and module, world by world
};

/// Its cells, with groups that are not flown yet. Throws InputError for names that are listed twice or unknown, and for
/// a gap without a reason.
Leaderboard leaderboard_of(const LeaderboardConfig& config);

/// The file in the batch's folder.
inline constexpr const char* kLeaderboardFile = "leaderboard.json";

/// Writes it beside the flights, so that a report needs the folder alone. @param folder  of the batch.
void write_leaderboard(const std::filesystem::path& folder, const Leaderboard& board);

/// Removes what an earlier batch wrote into the folder.
void forget_leaderboard(const std::filesystem::path& folder);

}  // namespace hedgehop::sim
