#include "sim/scenario/list_topics.h"

#include <fmt/format.h>

#include "sim/config/outline_texts.h"
#include "sim/scenario/scenario.h"

namespace hedgehop::sim {

const std::vector<std::string>& document_topics() {
  static const std::vector<std::string> topics = {"modules", "vehicles", "scenes", "cameras", "checks", "scenario"};
  return topics;
}

std::string document(const std::string& topic) {
  if (topic == "modules") return document_choices(outline(AvoidanceConfig(), {}).all);
  if (topic == "vehicles") return describe_choices<dynamics::VehicleConfig>();
  if (topic == "scenes") return describe_choices<scenes::SceneConfig>();
  if (topic == "cameras") return document_fields(outline_fields(RigConfig{}), 0);
  if (topic == "checks") return describe_choices<CheckConfig>();
  if (topic == "scenario") return document_fields(outline_fields(Scenario{}), 0);
  const std::vector<std::string>& topics = document_topics();
  throw InputError(fmt::format("unknown topic '{}'{}", topic, suggestion(topic, {topics.begin(), topics.end()})));
}

}  // namespace hedgehop::sim
