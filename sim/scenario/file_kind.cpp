#include "sim/scenario/file_kind.h"

#include <string_view>

#include "sim/config/config_tree.h"

namespace hedgehop::sim {

std::string file_kind(const Node& root) {
  struct FileKind {
    std::string_view key, description;  ///< a key of every file of the kind, and of no kind below
  };
  constexpr std::string_view kScenario = "a scenario, for `hedgehop run`";
  static constexpr FileKind kKinds[] = {
      {"scene", kScenario},
      {"vehicle", kScenario},
      {"start", kScenario},
      {"avoidance", kScenario},
      {"question", "a plan, for `hedgehop batch --plan`"},
      {"rows", "a paper, for `hedgehop reproduce`"},
      {"flights", "a campaign, for `hedgehop batch`"},
      {"leaderboard", "a campaign, for `hedgehop batch`"},
      {"parameters", "a sweep or a search, for `hedgehop sweep` or `hedgehop falsify`"},
      {"mass", "a vehicle; a scenario names it: vehicle: {use: FILE}"},
      {"cameras", "a rig; a scenario names it: rig: {use: FILE}"},
      {"stereo", "a rig; a scenario names it: rig: {use: FILE}"},
      {"module", "a module's parameters; a scenario names them: avoidance: {use: FILE}"}};
  for (const auto& [key, description] : kKinds) {
    if (root.find(key)) return std::string(description);
  }
  return "";
}

}  // namespace hedgehop::sim
