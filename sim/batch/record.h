#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/flight/result_io.h"
#include "sim/scenario/scenario.h"

/// Many flights: batches and sweeps, each flight in a process of its own.
namespace hedgehop::sim {

/// One flight to be flown, as `hedgehop run` would fly it.
struct Order {
  std::string id;                  ///< unique in its campaign; the flight's folder, relative to the campaign's
  std::string group;               ///< name of the flights that differ by the seed alone
  std::filesystem::path scenario;  ///< file, as the user named it
  uint64_t seed = 0;
  std::vector<std::string> overrides;         ///< "a.b=value", in order
  std::string scenario_yaml;                  ///< the resolved scenario
  std::map<std::string, std::string> inputs;  ///< files that the flight depends on, with their SHA-256
  std::string fault;                          ///< why it cannot be flown at all, one line; else empty
};

/// The flight's scenario in full, as a worker writes it: with the seed, without film. Throws InputError.
std::string resolved_yaml(Scenario scenario, uint64_t seed);

/// Arguments of `hedgehop` that re-simulate an order: "run", the file, the seed, each override.
std::vector<std::string> run_arguments(const Order& order);

/// "hedgehop run FILE --seed 3 --set 'a.b=1'", ready for a POSIX shell.
std::string rerun_command(const Order& order);

/// A word quoted for a POSIX shell where it must be.
std::string shell_quoted(const std::string& word);

/// What became of an order.
struct FlightRecord {
  enum class Status {
    flown,   ///< it left a result
    failed,  ///< it left none: refused, crashed, over its limit, killed; cause says which
    missing  ///< not flown yet
  };
  Order order;
  Status status = Status::missing;
  std::string cause;                ///< of a failure, one line
  std::optional<RunResult> result;  ///< of a flight that was flown
};
std::string_view to_string(FlightRecord::Status status);

/// The verdict on its result; Verdict::not_flown without one.
Verdict verdict_of(const FlightRecord& record);
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
std::optional<RunResult> result_left_by(const Order& order, const std::filesystem::path& folder, bool other_builds);

}  // namespace hedgehop::sim
