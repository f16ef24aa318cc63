#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/falsify/competition_suite.h"
#include "sim/falsify/shrink.h"

namespace hedgehop::sim {

/// Outcome of a flight that repeats another one.
enum class Repeat { equal, differs, not_flown };

/// A failure of a search after it was flown again, shrunk and stored.
struct Counterexample {
  size_t trial = 0;                    ///< of the search
  Repeat repeats = Repeat::not_flown;  ///< whether a second flight in a new process was equal, bit for bit
  Shrunk shrunk;
  WeakestCheck weakest;                  ///< of the shrunk flight
  std::filesystem::path file;            ///< its scenario, with `origin`
  std::string folder;                    ///< of its flight, with video and report, relative to the search's
  Repeat confirmed = Repeat::not_flown;  ///< whether the file's flight in a new process equals the shrunk one
};

/// Functions that fly counterexamples. The ids of their orders are folders relative to the search's folder.
struct CounterexampleFlights {
  FlyOne plain;
  FlyOne with_report;  ///< also writes video and report
};

/// Flies a failure again, shrinks it and writes counterexamples/<name>.yaml. Returns nullopt if interrupted.
/// @param search_file  path as the user gave it, for the origin. @param out  the search's folder. @param number from 1.
std::optional<Counterexample> keep_counterexample(const FalsifySearch& search, const std::string& search_file,
                                                  const FalsifyResult& result, size_t number,
                                                  const std::filesystem::path& out, const CounterexampleFlights& fly);

/// Returns the text of falsify.json: the search, its flights, failures and counterexamples, whose repeats are true,
/// false or, if not flown, null.
/// @param suite  of a search by the competition's score; else null.
std::string falsify_json(const FalsifySearch& search, const FalsifyResult& result,
                         const std::vector<Counterexample>& counterexamples, const CompetitionSuite* suite = nullptr);

}  // namespace hedgehop::sim
