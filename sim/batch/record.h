#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
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
  std::string scenario_sha256;                ///< of the scenario without its seed: see scenario_sha256()
  std::map<std::string, std::string> inputs;  ///< files that the flight depends on, with their SHA-256
  std::string fault;                          ///< why it cannot be flown at all, one line; else empty
  std::vector<std::string> more_faults;       ///< of the same file, one line each
};

/// The flight's scenario in full, as a worker writes it: with the seed, without film. Throws InputError.
std::string resolved_yaml(Scenario scenario, uint64_t seed);

/// Arguments of `hedgehop` that re-simulate an order: "run", the file, the seed, each override.
std::vector<std::string> run_arguments(const Order& order);

/// "hedgehop run FILE --seed 3 --set 'a.b=1'", ready for a POSIX shell.
std::string rerun_command(const Order& order);

/// Parses the batch.json of an earlier batch. Throws InputError if the file cannot be read, is not JSON, or has a key
/// of an earlier version.
nlohmann::ordered_json read_batch_json(const std::filesystem::path& file);
inline constexpr std::string_view kRecordOfBatch = "the record of a batch";  ///< kind of batch.json, in messages

/// The end of an order.
struct FlightRecord {
  enum class Status {
    flown,   ///< a result exists
    failed,  ///< no result: refused, crashed, over its time limit or killed; `cause` has the reason
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

/// Returns the outcome for pages and the terminal: "completed" for a timeout without a goal, which is a normal end.
std::string shown_outcome(Outcome outcome, bool has_goal);
/// As above, of a record: "failed" or "missing" without a result. The record has its whole result.
std::string shown_outcome(const FlightRecord& record);

/// The identity of the build that flew it, as its result names it; "" when it has none.
std::string build_of(const FlightRecord& record);

/// Returns the truth that its module received, as listed in its result; empty if it received only real sensors.
std::vector<std::string> truth_used(const FlightRecord& record);

/// Returns a line with the number of flights that used the truth, and the kinds of truth, else "".
std::string truth_words(const std::vector<FlightRecord>& records);

/// The builds that flew them.
std::set<std::string> builds_of(const std::vector<FlightRecord>& records);

/// Returns a line each for builds, renderers and versions of libraries of which the flights have several; "" if all
/// flights were flown alike.
std::string mixture_words(const std::vector<FlightRecord>& records);

/// Returns the complete result of an earlier flight of the same order: equal resolved scenario, seed, input files and
/// build. Returns none otherwise, so that the order is flown.
/// @param folder  of the flight. @param other_builds  whether results of other builds are accepted.
std::optional<RunResult> result_left_by(const Order& order, const std::filesystem::path& folder, bool other_builds);

}  // namespace hedgehop::sim
