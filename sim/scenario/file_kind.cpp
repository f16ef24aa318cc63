#include "sim/scenario/file_kind.h"

#include <algorithm>
#include <string_view>

#include "sim/config/config_tree.h"

namespace hedgehop::sim {
namespace {

struct FileKind {
  std::string_view key, description;  ///< a key of every file of the kind, and of no kind below
};

constexpr std::string_view kScenario = "a scenario, for `hedgehop run`";
constexpr FileKind kCommandKinds[] = {
    {"scene", kScenario},
    {"vehicle", kScenario},
    {"start", kScenario},
    {"avoidance", kScenario},
    {"question", "a plan, for `hedgehop batch --plan`"},
    {"rows", "a paper, for `hedgehop reproduce`"},
    {"flights", "a campaign, for `hedgehop batch`"},
    {"leaderboard", "a campaign, for `hedgehop batch`"},
    {"parameters", "a sweep or a search, for `hedgehop sweep` or `hedgehop falsify`"}};
constexpr FileKind kPartKinds[] = {{"mass", "a vehicle; a scenario names it: vehicle: {use: FILE}"},
                                   {"cameras", "a rig; a scenario names it: rig: {use: FILE}"},
                                   {"stereo", "a rig; a scenario names it: rig: {use: FILE}"},
                                   {"module", "a module's parameters; a scenario names them: avoidance: {use: FILE}"}};

}  // namespace

std::string file_kind(const Node& root) {
  for (const FileKind& kind : kCommandKinds) {
    if (root.find(kind.key)) return std::string(kind.description);
  }
  for (const FileKind& kind : kPartKinds) {
    if (root.find(kind.key)) return std::string(kind.description);
  }
  return "";
}

bool is_command_file(const Node& root) {
  return std::ranges::any_of(kCommandKinds, [&](const FileKind& kind) { return root.find(kind.key) != nullptr; });
}

}  // namespace hedgehop::sim
