#include "sim/campaign/record.h"

#include <stdexcept>

#include "sim/record/whole_file.h"

namespace hedgehop::sim {

std::string_view to_string(FlightRecord::Status status) {
  switch (status) {
    case FlightRecord::Status::flown:
      return "flown";
    case FlightRecord::Status::failed:
      return "failed";
    case FlightRecord::Status::missing:
      return "missing";
  }
  return "";
}

bool passed(const FlightRecord& record) {
  if (record.status != FlightRecord::Status::flown || record.result.at("outcome") == "fault") return false;
  for (const auto& check : record.result.at("checks")) {
    if (!check.at("passed").get<bool>()) return false;
  }
  return true;
}

std::string outcome_words(const FlightRecord& record) {
  if (record.status == FlightRecord::Status::flown) return record.result.at("outcome").get<std::string>();
  return std::string(to_string(record.status));
}

std::optional<nlohmann::ordered_json> result_left_by(const Order& order, const std::filesystem::path& folder,
                                                     std::string_view version) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "result.json", ignored)) return {};
  try {
    if (read_file_whole(folder / "scenario.yaml") != order.scenario_yaml) return {};
    nlohmann::ordered_json result = nlohmann::ordered_json::parse(read_file_whole(folder / "result.json"));
    for (const char* key : {"outcome", "checks", "metrics", "trajectory_hash"}) {
      if (!result.contains(key)) return {};
    }
    if (result.value("version", "") != version || result.value("seed", uint64_t{0}) != order.seed) return {};
    return result;
  } catch (const nlohmann::json::exception&) {
  } catch (const std::runtime_error&) {
  }
  return {};
}

}  // namespace hedgehop::sim
