#include "sim/record/labels_file.h"

#include "sim/config/utf8.h"

#include <nlohmann/json.hpp>
#include <string_view>

namespace hedgehop::sim {

std::string labels_json(const scenes::Scene& scene) {
  using Json = nlohmann::ordered_json;
  Json classes, instances = Json::array();
  classes["sky"] = 0;
  for (size_t i = 0; i < scenes::kSemanticClassNames.size(); ++i) {
    classes[std::string(scenes::kSemanticClassNames[i])] = scenes::class_id(static_cast<scenes::SemanticClass>(i));
  }
  for (const scenes::Instance& instance : scenes::instances(scene)) {
    const std::string_view kind = scenes::kSemanticClassNames[static_cast<size_t>(instance.kind)];
    instances.push_back({{"id", instances.size() + 1}, {"name", instance.name}, {"class", std::string(kind)}});
  }
  return json_text(Json{{"classes", classes}, {"instances", instances}}, 2) + "\n";
}

}  // namespace hedgehop::sim
