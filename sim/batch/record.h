#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/batch/order.h"

namespace hedgehop::sim {

/// What became of an order.
struct FlightRecord {
  enum class Status {
    flown,   ///< it left a result
    failed,  ///< it left none: refused, crashed, over its limit, killed; cause says which
    missing  ///< not flown yet
  };
  Order order;
  Status status = Status::missing;
  std::string cause;              ///< of a failure, one line
  nlohmann::ordered_json result;  ///< result.json of a flight that was flown, else null
};
std::string_view to_string(FlightRecord::Status status);

/// Whether it was flown, without a fault, has checks, and all hold.
bool passed(const FlightRecord& record);

/// Whether it was flown, without a fault, and nothing was asked of it: it neither passed nor failed.
bool unchecked(const FlightRecord& record);
inline constexpr std::string_view kNoChecks = "no checks";

/// "reached", "collided", "timeout", "fault" of a flight that was flown; "failed" or "missing" of any other.
std::string outcome_words(const FlightRecord& record);

/// The identity of the build that flew it, as its result names it; "" when it has none.
std::string build_of(const FlightRecord& record);

/// What its module got of the truth, as its result lists it; empty for real sensors alone.
std::vector<std::string> truth_used(const FlightRecord& record);

/// Returns a line that says how many flights used the truth, and which, else "".
std::string truth_words(const std::vector<FlightRecord>& records);

/// The builds that flew them.
std::set<std::string> builds_of(const std::vector<FlightRecord>& records);

/// Returns a line that names the builds when flights of several stand beside each other, else "".
std::string several_builds_words(const std::vector<FlightRecord>& records);

/// The result that a flight of this very order left in its folder: same resolved scenario, seed, input files and build,
/// and whole. None for anything else, so that it is flown (again).
/// @param folder  of the flight. @param other_builds  whether a result of another build will do.
std::optional<nlohmann::ordered_json> result_left_by(const Order& order, const std::filesystem::path& folder,
                                                     bool other_builds);

}  // namespace hedgehop::sim
